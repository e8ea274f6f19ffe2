// Where records lie, drawn over a picture.
#pragma once

#include <cstddef>
#include <span>

#include "image/image.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"

namespace phos::inline splat {

enum class Overlay { none, records };
/// What the colour of a record tells, on a logarithmic scale from blue (least) to red.
enum class OverlayColour {
  radius,   ///< m
  stderr_,  ///< luminance of the standard error over the luminance of the irradiance
};

/// The records drawn, and the meaning of their colours.
struct DrawnRecords {
  std::size_t count = 0;
  double least = 0, most = 0;  ///< value of the first and last colour; one mark in a hundred lies beyond each
};

/// Dims the beauty (R, G, B) of an image of `camera`, and draws over it each record that can be seen from
/// there: a dot at its place, and the outline of its zone of influence (where record_error is `accuracy`) on
/// the surfaces it lights. Colours are as bright as phos-picture's own tone mapping shows them well in this
/// image.
DrawnRecords draw_records(Image& image, std::span<const IrradianceRecord> records, double accuracy,
                          const RayScene& rays, const Camera& camera, OverlayColour colour);

}  // namespace phos::inline splat
