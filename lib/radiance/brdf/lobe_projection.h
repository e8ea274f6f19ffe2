// One lobe of reflection as coefficients.
#pragma once

#include "hsh/basis.h"
#include "radiance/brdf/lobe_points.h"

namespace phos::inline radiance {

struct LobeProjection {
  std::vector<float> coefficients;  ///< [order^2][3] of f cos, 1/sqrt(sr)
  double magnitude = 0;             ///< integral of |f| cos over the hemisphere, summed over RGB
  double energy = 0;                ///< integral of (f cos)^2, summed over RGB
  Rgb albedo{0};                    ///< integral of f cos
  bool resolved = true;             ///< false: no figure here can be relied on
  std::size_t rejected = 0;         ///< values of f that were not finite
  std::size_t evaluated = 0;        ///< values of f in all

  /// The lowest order whose bands leave out at most the share `tolerance` of the energy, or 0; `error`
  /// receives that share, or the share that all bands leave out.
  int lowest_order(double tolerance, float& error) const;
};

/// c_i = integral of f cos H_i over the hemisphere, or of f cos Y_i (`kind`), all orders of the basis; `f`
/// and `scouts` as for lobe_points.
LobeProjection project_lobe(const std::function<Rgb(const Vec3& wi)>& f, std::span<const Vec3> scouts,
                            const HarmonicBasis<float>& basis, BasisKind kind = BasisKind::hsh);

}  // namespace phos::inline radiance
