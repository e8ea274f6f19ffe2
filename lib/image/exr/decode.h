// Pictures from the bytes of OpenEXR files, for the readers in image.h and for tests.
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace phos::inline image {

/// Throws Error(bad_input) with `where` for bytes that are truncated or damaged, and allocates no more than
/// the bytes can hold at the best compression of the format.
///
/// OpenEXR: scanline or tiled, half, float or unsigned channels. The image is the display window: pixels
/// outside the data window are zero. A part after the first that can be read adds its channels as layers of
/// its name; parts of deep pixels or with subsampled channels are left out, and an error that names the kind
/// where no part is left. Colour of other chromaticities becomes Rec.709 and is multiplied by whiteLuminance
/// (OpenEXR technical introduction: cd/m2 of RGB 1,1,1).
Image decode_exr(std::string_view bytes, const std::string& where);

}  // namespace phos::inline image
