// The legend of records drawn over a picture.
#pragma once

#include "image/image.h"
#include "splat/picture/overlay.h"

namespace phos::inline splat {

/// Draws the colours of draw_records() with their values into the lower left corner of the beauty, as bright
/// as the marks. Nothing where no record is drawn or the picture is too small for it.
void draw_legend(Image& image, const DrawnRecords& drawn, OverlayColour colour);

}  // namespace phos::inline splat
