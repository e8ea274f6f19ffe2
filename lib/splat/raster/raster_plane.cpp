#include "splat/raster/raster_plane.h"

#include <cmath>

#include "core/error.h"

namespace phos::inline splat {
namespace {

/// Projected solid angle of the rectangle [0,x] x [0,y] at height 1: pi times the form factor from an element
/// to a parallel rectangle with one corner above it. Odd in x and in y.
double corner_sr(double x, double y) {
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return 0.5 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy));
}

/// Projected solid angle below the segment from (h, 0) to (h, y), down to the horizon, h = kPlaneHalfSide.
/// At azimuth phi the segment is h / cos(phi) away, and 1/2 cos^2(phi) / (cos^2(phi) + h^2) dphi lies below.
double below_edge_sr(double y) {
  constexpr double h = kPlaneHalfSide;
  const double r = std::sqrt(1 + h * h);
  return 0.5 * (std::atan(y / h) - h / r * std::atan(y / r));
}

}  // namespace

RasterPlane raster_plane(int side, RasterBorder border) {
  PHOS_CHECK(side > 0, "side ", side);
  RasterPlane plane;
  plane.side = side;
  plane.covered = 4 * corner_sr(kPlaneHalfSide, kPlaneHalfSide) / std::numbers::pi;
  const double share = border == RasterBorder::coverage ? plane.covered : 1;
  for (int row = 0; row < side; ++row) {
    const double y0 = plane_border(row, side), y1 = plane_border(row + 1, side);
    const bool side_y = row == 0 || row == side - 1;
    for (int column = 0; column < side; ++column) {
      const double x0 = plane_border(column, side), x1 = plane_border(column + 1, side);
      const bool side_x = column == 0 || column == side - 1;
      double sr = (corner_sr(x1, y1) - corner_sr(x0, y1) - corner_sr(x1, y0) + corner_sr(x0, y0)) / share;
      if (border == RasterBorder::stretch) {
        // A plane of one pixel has all four edges.
        const int edges = side == 1 ? 2 : 1;
        if (side_x) sr += edges * (below_edge_sr(y1) - below_edge_sr(y0));
        if (side_y) sr += edges * (below_edge_sr(x1) - below_edge_sr(x0));
      }
      plane.direction.push_back(Vec3(glm::normalize(DVec3(0.5 * (x0 + x1), 0.5 * (y0 + y1), 1))));
      plane.projected_sr.push_back(static_cast<float>(sr));
    }
  }
  return plane;
}

}  // namespace phos::inline splat
