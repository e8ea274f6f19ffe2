// The pieces of the hemisphere that the pixels of a plane stand for, where the direction of light counts.
#pragma once

#include <cstdint>
#include <vector>

#include "estimate/radiance_record.h"
#include "splat/raster/raster_plane.h"

namespace phos::inline splat {

/// Pieces as columns. A pixel is cut into squares, so that harmonics of `order` bands change little within
/// each; with RasterBorder::stretch, pieces below the edge of the plane, down to the horizon, belong to the
/// border pixel of their azimuth.
struct PlanePieces {
  std::vector<std::uint32_t> pixel;  ///< that each belongs to
  std::vector<Vec3> direction;       ///< unit; z is up
  std::vector<float> solid_sr;       ///< exact; all add up to 2 pi, or to less without border
  /// Turns the pixel's direction into the piece's, about the horizontal across them: of what a piece below
  /// the edge shows. Of pieces on the plane: the identity.
  std::vector<Mat3> turn;
  std::vector<RayBorder> borders;  ///< between pieces of neighbouring pixels
  double covered = 0;              ///< share of the hemisphere's solid angle within the plane

  std::size_t size() const { return direction.size(); }
  /// The hemisphere of the pieces, of which the pixels' hemisphere `seen` holds the light. Light, distance
  /// and normal are those of the pixel, the normal turned with the direction.
  void spread(const Hemisphere& seen, Hemisphere& whole) const;
};

/// 59 % of the hemisphere's solid angle lies on the plane (covered). The rest is left out (none), shared
/// among all pixels in proportion (coverage), or lit by the border pixels (stretch: docs/methods.md#r2). side
/// > 0, order > 0.
PlanePieces plane_pieces(int side, RasterBorder border, int order);

}  // namespace phos::inline splat
