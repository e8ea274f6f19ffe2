// A picture whose standard errors would leave something out.
#pragma once

#include "image/image.h"

namespace phos::inline image {

/// The same without the layers of standard errors: stderr, and all whose names end with _stderr.
Image without_errors(const Image& image);

}  // namespace phos::inline image
