// Light from the photons nearest to a point: the classical disc.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "photon/photon_map.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"

namespace phos::inline reference {

/// Luminance of a surface, cd/m2, and its standard error.
struct DiscRadiance {
  Rgb direct{0};  ///< of photons straight from a lamp, or over flat mirrors in which it has images
  Rgb indirect{0}, glossy{0};  ///< of all others, by the Lambert part and by the rest of the BSDF
  Rgb noise{0};                ///< standard error of the sum that the number of photons leaves
  Rgb total() const { return direct + indirect + glossy; }
};

struct DiscIrradiance {
  Rgb irradiance_lx{0};
  Rgb noise_lx{0};  ///< standard error that the number of photons leaves
};

/// Estimates of the k photons nearest to a point (Jensen 1996, 2001): the sphere that the k-th bounds is
/// taken for a disc of the surface, whatever the surface is within it: each of the k - 1 nearer photons
/// brings its flux / (pi r2) (docs/methods.md#c8). Photons of other surfaces within the sphere count too.
/// Where the map has fewer than k photons the farthest of them bounds it; fewer than two photons give 0. r is
/// at least the rounding error of the point. The standard error is that of Poisson photons, about 1/sqrt(k)
/// where they are alike, and not the bias of the disc. Const and usable from any thread; holds a reference.
class PhotonDiscs {
 public:
  /// `k`: 2 or more.
  PhotonDiscs(const PhotonMap& photons, std::int64_t k)
      : photons_(&photons), k_(static_cast<std::size_t>(k)) {}

  /// Light that the surface sends back towards `wo`.
  DiscRadiance reflected(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo) const;
  /// On the side of the geometric normal.
  DiscIrradiance irradiance(const SurfacePoint& point) const;
  /// Distance of the k-th photon, m; infinity where the map has none.
  float radius_m(const Vec3& p) const;

 private:
  struct Disc {
    std::vector<std::uint32_t> row;  ///< photons that count
    float per_m2 = 0;                ///< 1 / area
  };
  Disc about(const SurfacePoint& point) const;

  const PhotonMap* photons_;
  std::size_t k_;
};

}  // namespace phos::inline reference
