// Surface gradients of hemispherical harmonics as sums of harmonics.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline hsh {

/// The x and y components of the surface gradient G_i of HSH i (as HarmonicBasis gives them) are
///   G_i = p(z) sum of A_ij H_j + q(z) sum of B_ij H_j
/// with numbers A (of the same band) and B (of the bands beside it), by the ladder operators of SH and the
/// map of the hemisphere to the sphere, of which HSH are the SH. So sums of light x G need no gradient: sums
/// of light x p x H and of light x q x H give them.
class HshSlopes {
 public:
  /// Of all harmonics of `order` bands; the sums with q are of order + 1.
  explicit HshSlopes(int order);

  /// p = 3 / (4 r), q = (3 + 2 z) / (4 r), r = sqrt(z (1 + z)): they diverge at the horizon, where A H + B H
  /// goes to 0 as z. Below 2^-20 z is taken as that, which changes G by less than 1e-3 of its greatest.
  static float p(float z);
  static float q(float z);

  /// Subtracts from x and y [order^2][3] the sums of light x G_x and light x G_y, made of the sums with p and
  /// q: `with_p` [order^2] and `with_q` [(order + 1)^2], each colour c of harmonic i at i * stride + c.
  void subtract(std::span<const double> with_p, std::span<const double> with_q, std::size_t stride,
                std::span<double> x, std::span<double> y) const;

 private:
  struct Term {
    std::size_t of, from;  // harmonics
    bool q, y;
    double factor;
  };
  std::vector<Term> terms_;
};

}  // namespace phos::inline hsh
