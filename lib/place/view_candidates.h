// Places that a picture shows.
#pragma once

#include <cstdint>

#include "core/vector.h"
#include "place/candidates.h"
#include "scene/camera.h"

namespace phos::inline place {

/// A picture whose visible points need records.
struct View {
  Camera camera;
  std::int64_t width = 0, height = 0;  ///< pixels, both positive
  /// Bounds of a record's radius in sides of a pixel's footprint on the surface (docs/methods.md#a7,
  /// "screen"); 0: no bound.
  double least_radius_pixels = 0, most_radius_pixels = 0;
};

inline constexpr int kViewSamples = 4;  ///< of a pixel: as many as phos-splat has by default

/// What each pixel shows: its visible point and all that mirrors, smooth glass and a few glossy rays show
/// from there, where they have a diffuse part (or are `wanted`, if that is given). Coarse to fine over the
/// whole picture, for each sample of a pixel in turn. Holds a reference to rays.
Candidates view_candidates(const RayScene& rays, const View& view, const MaterialFilter& wanted = {});

/// Side of the patch of surface that one pixel covers: the root of its area, m. `st` is the middle of the
/// pixel in [0,1]^2, `travelled_m` the length of the ray's way (by mirrors too), `cosine` the cosine
/// between ray and surface normal. A grazing pixel's patch counts as one seen at a cosine of 0.05.
float pixel_side_m(const View& view, const Vec2& st, float travelled_m, float cosine);

/// The same for many pixels: `eye` sees the view.
float pixel_side_m(const View& view, const CameraRays& eye, const Vec2& st, float travelled_m, float cosine);

}  // namespace phos::inline place
