// Compression that a browser undoes.
#pragma once

#include <string>
#include <string_view>

namespace phos::inline view {

/// Raw deflate (RFC 1951), which DecompressionStream calls "deflate-raw". Same bytes for the same input and
/// the same version of libdeflate.
std::string deflated(std::string_view bytes);

}  // namespace phos::inline view
