// Quadrature points on the hemisphere, placed where a lobe of reflection is.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline radiance {

/// Directions wi, and (f cos)(wi) times the solid angle that each stands for.
struct LobePoints {
  std::vector<float> x, y, z;
  std::array<std::vector<float>, 3> value;  ///< RGB
  Rgb albedo{0};                            ///< integral of f cos
  double magnitude = 0;                     ///< integral of |f| cos, summed over RGB
  double energy = 0;                        ///< integral of (f cos)^2, summed over RGB
  bool resolved = true;                     ///< false: the lobe had to be left with too few points
  std::size_t rejected = 0;                 ///< values of f that were not finite, taken as 0
  std::size_t evaluated = 0;                ///< values of f in all, also in cells that were halved
  std::size_t size() const { return x.size(); }
};

/// Points such that sums of value * (harmonic below `order`) are integrals of f cos times it, to about 1e-4
/// of the lobe's norm. `f` is in 1/sr, local, without the cosine. `scouts` (unit, z > 0, one at least) are
/// directions where f is large, such as samples of f: they find a narrow lobe.
///
/// Cells of the (b, phi) plane, cos(theta) = cos^2(b), with Gauss-Legendre points: in these coordinates the
/// harmonics, with their sqrt(cos theta), are analytic in every closed cell. A cell is halved while the
/// highest Legendre coefficients of f cos within it say that its points are too few, or while its points see
/// nothing of what a scout sees there.
LobePoints lobe_points(const std::function<Rgb(const Vec3& wi)>& f, std::span<const Vec3> scouts, int order);

}  // namespace phos::inline radiance
