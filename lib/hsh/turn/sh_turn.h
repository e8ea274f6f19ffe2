// Matrices of the rotation about y of spherical harmonics, Ry(beta): +z goes to (sin beta, 0, cos beta),
// which mixes cosines (m >= 0) among themselves and sines (m < 0) among themselves.
#pragma once

#include <cstddef>
#include <vector>

namespace phos::inline hsh {

/// SH: coefficients of a turned function, exact, nonzero between equal bands alone. Row after row, the rows
/// and columns of a band's cosines are m = 0 .. l, of its sines m = 1 .. l. Time grows as order^3.
class ShTurn {
 public:
  /// Throws Error(usage) for an order outside 1 .. HarmonicBasis::kMaxOrder.
  ShTurn(int order, double beta);
  const double* cosine(int l) const { return values_.data() + start(l); }
  const double* sine(int l) const { return cosine(l) + (l + 1) * (l + 1); }

 private:
  /// Numbers in the bands below l: the sum of (k + 1)^2 + k^2.
  static std::size_t start(int l) { return static_cast<std::size_t>(l * (2 * l * l + 1) / 3); }
  std::vector<double> values_;
};

}  // namespace phos::inline hsh
