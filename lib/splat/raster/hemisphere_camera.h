// The scene as it is seen from a record, pixel by pixel.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "estimate/hit_light.h"
#include "splat/raster/raster_plane.h"

namespace phos::inline splat {

/// Draws the scene by OpenGL from a record's place onto one plane above it (raster_plane.h). The near plane
/// lies at the rounding of positions, so that walls which touch the record are drawn as far as they are told
/// apart from it. One context, used from the thread that made it.
class HemisphereCamera {
 public:
  /// Draws a plane of raster_side pixels each way, with raster_border, and with raster_light shadow maps of
  /// all lamps. Throws Error(bad_input) if no OpenGL context can be had, Error(usage) if the plane has more
  /// pixels than it can draw, or lamps have too many maps.
  HemisphereCamera(const RayScene& rays, const RecordOptions& resolved);
  ~HemisphereCamera();
  HemisphereCamera(const HemisphereCamera&) = delete;
  HemisphereCamera& operator=(const HemisphereCamera&) = delete;

  /// Light of the lamps at the places that pixels show (HitLight::lamps_from). Null: shadow rays bring it,
  /// also in scenes with panes, which maps do not look through.
  const LampLight* lamps() const;

  /// Memory of sample().
  struct Pixels {
    std::vector<std::uint32_t> triangle;
    std::vector<Hit> hits;
  };
  /// Sets h to the plane's pixels, drawn from the site and lit by `light`.
  void sample(const RecordSite& site, const HitLight& light, Hemisphere& h, Pixels& pixels,
              HitLight::Worker& worker) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline splat
