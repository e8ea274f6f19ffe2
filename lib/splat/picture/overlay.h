// Where records lie, drawn over a picture.
#pragma once

#include <cstddef>
#include <span>

#include "image/colour8.h"
#include "image/image.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"
#include "splat/caches.h"

namespace phos::inline splat {

enum class Overlay { none, records };
/// What the colour of a record tells, on a logarithmic scale.
enum class OverlayColour {
  radius,   ///< m
  stderr_,  ///< luminance of the standard error over the luminance of the irradiance
  life,     ///< frames between the birth of a record of a film and its end
};

/// Colours at t in 0 .. 1, from the least to the greatest value.
Colour8 blue_to_red(double t);
Colour8 red_to_green(double t);

struct OverlayColourRow {
  OverlayColour colour;
  const char *name, *title, *unit;  ///< the option's value; words of legend and report
  double per_unit;                  ///< units that the value 1 is
  Colour8 (*at)(double t);
  const char *least, *most;  ///< names of the first and the last colour
};
inline constexpr OverlayColourRow kOverlayColours[] = {
    {OverlayColour::radius, "radius", "radius", "m", 1, blue_to_red, "blue", "red"},
    {OverlayColour::stderr_, "stderr", "standard error", "%", 100, blue_to_red, "blue", "red"},
    {OverlayColour::life, "life", "life", "frames", 1, red_to_green, "red", "green"},
};
const OverlayColourRow& row_of(OverlayColour colour);

/// The records drawn, and the meaning of their colours.
struct DrawnRecords {
  std::size_t count = 0;
  /// Value of the first and last colour. One mark in a hundred lies beyond each; lives have those of 1 frame
  /// and of the longest life, so that all frames of a film have the same colours.
  double least = 0, most = 0;
  double key_cd_m2 = 1;  ///< the luminance that a picture shows as middle grey, before the marks
};

/// Dims the beauty (R, G, B) of an image of `camera`, and draws over it each record that can be seen from
/// there: a dot at its place, and the outline of its zone of influence (where record_error is `accuracy`) on
/// the surfaces it lights. Colours are as bright as phos-picture's own tone mapping shows them well in this
/// image. `lives`, of these records, is read for OverlayColour::life alone; records without a life are white.
DrawnRecords draw_records(Image& image, std::span<const IrradianceRecord> records, double accuracy,
                          const RayScene& rays, const Camera& camera, OverlayColour colour,
                          const RecordLives& lives = {});

/// The screen's colour as the light that tone mapping shows so, where `key_cd_m2` becomes middle grey.
Rgb scene_colour(const Colour8& screen, double key_cd_m2);

}  // namespace phos::inline splat
