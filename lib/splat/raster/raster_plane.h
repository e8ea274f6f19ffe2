// The pixels of a plane above a place, as directions with the projected solid angle that each stands for.
#pragma once

#include <vector>

#include "core/vector.h"
#include "estimate/record_options.h"

namespace phos::inline splat {

/// Half of the plane's side over its height: the view opens by 2 atan(2) = 126.9 degrees each way, and sees
/// 83 % of a hemisphere's projected solid angle.
inline constexpr double kPlaneHalfSide = 2;

/// Pixel i = row * side + column lies at x = kPlaneHalfSide (2 (column + 1/2) / side - 1), y alike by row, at
/// height 1.
struct RasterPlane {
  int side = 0;
  std::vector<Vec3> direction;      ///< unit, through the pixel's centre; z is up
  std::vector<float> projected_sr;  ///< cosine included. All add up to pi, or to pi x covered without border
  double covered = 0;               ///< share of the hemisphere's projected solid angle within the plane
};

/// Projected solid angles are exact (form factors of the pixels). What lies beyond the plane is left out
/// (none), shared among all pixels in proportion (coverage: Larsen and Christensen 2004), or added to the
/// border pixel of the same azimuth, which so reaches down to the horizon (stretch: docs/methods.md#r1).
/// side > 0.
RasterPlane raster_plane(int side, RasterBorder border);

/// Where pixel border k of 0..side lies.
inline double plane_border(double k, int side) { return kPlaneHalfSide * (2 * k / side - 1); }

}  // namespace phos::inline splat
