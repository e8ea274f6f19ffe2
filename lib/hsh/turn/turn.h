// Matrices of the rotation about y, Ry(beta): +z goes to (sin beta, 0, cos beta), which mixes cosines (m >=
// 0) among themselves and sines (m < 0) among themselves.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "hsh/rotation.h"

namespace phos::inline hsh {

/// HSH: coefficients of a turned function = matrix times the coefficients, for the cosines and for the sines
/// of all bands, row after row.
struct Turn {
  explicit Turn(int of_order)
      : order(of_order), cosine(cosines() * cosines(), 0.), sine(sines() * sines(), 0.) {}
  int order;
  std::vector<double> cosine, sine;

  void transpose() {
    for (const auto& [block, n] : {std::pair(&cosine, cosines()), std::pair(&sine, sines())})
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) std::swap((*block)[i * n + j], (*block)[j * n + i]);
  }
  std::size_t cosines() const { return cosine_index(order, 0); }
  std::size_t sines() const { return sine_index(order, 1); }
  /// Place among the cosines, m >= 0, and among the sines sin(m phi), m > 0.
  static std::size_t cosine_index(int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); }
  static std::size_t sine_index(int l, int m) { return static_cast<std::size_t>(l * (l - 1) / 2 + m - 1); }
};

/// By each method, least squares over the hemisphere: beta in [0, pi], radians. Quadrature, to about 1e-11;
/// time grows as order^6.
Turn hsh_turn(int order, HshRotation method, double beta);

/// SH: the same, exact, nonzero between equal bands alone. Row after row, the rows and columns of a band's
/// cosines are m = 0 .. l, of its sines m = 1 .. l. Time grows as order^3.
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
