// The headers of an OpenEXR file, walked before the library reads them.
#pragma once

#include <string>
#include <string_view>

namespace phos::inline image {

/// Passes if every attribute of every header lies within the file, and its value fills it: the library takes
/// the memory that an attribute asks for before it looks how much there is. Throws std::runtime_error; and
/// Error(bad_input) with `where` for a compression that later versions of OpenEXR have. What else is wrong
/// with a header, the library finds.
void check_exr_header(std::string_view file, const std::string& where);

}  // namespace phos::inline image
