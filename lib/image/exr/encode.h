// OpenEXR files from pictures, as bytes.
#pragma once

#include <string>

#include "image/image.h"

namespace phos::inline image {

std::string encode_exr(const Image& image, ExrCompression compression = ExrCompression::zip);

}  // namespace phos::inline image
