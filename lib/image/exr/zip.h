// OpenEXR's ZIP compression by libdeflate, in less than half the time of OpenEXR 3.1's own.
#pragma once

#include <ImfHeader.h>

#include <string>

#include "image/image.h"

namespace phos::inline image {

/// The bytes of a file of scanlines: `header`, which has the channels of the image, all floats, and the
/// compression ZIP, and the image in blocks of 16 lines ("OpenEXR File Layout": of each block the even
/// bytes, then the odd ones, as differences, deflated; as they are where that is not less). Same bytes for
/// any number of threads. Throws std::bad_alloc.
std::string encode_zip_exr(const Imf::Header& header, const Image& image);

}  // namespace phos::inline image
