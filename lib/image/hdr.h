// Radiance pictures (RGBE and XYZE) as bytes, for the readers in image.h and for tests.
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace phos::inline image {

/// Radiance RGBE or XYZE: flat, old or new run lengths, any of the eight orientations.
/// Throws Error(bad_input) with `where` for bytes that are truncated or damaged, and allocates no more than
/// the bytes can hold at the best compression of the format.
Image decode_hdr(std::string_view bytes, const std::string& where);
/// Negative and non-finite values become 0, as the format has neither.
std::string encode_hdr(const Image& image);

}  // namespace phos::inline image
