// PNG files as bytes, for the readers in image.h and for tests.
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace phos::inline image {

/// Throws Error(bad_input) with `where` for bytes that are truncated or damaged, and allocates no more than
/// the bytes can hold at the best compression of the format.
Picture decode_png(std::string_view bytes, const std::string& where);
std::string encode_png(const Picture& picture);

}  // namespace phos::inline image
