// Matrices of the rotation about y, Ry(beta): +z goes to (sin beta, 0, cos beta), which mixes cosines (m >=
// 0) among themselves and sines (m < 0) among themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "hsh/rotation.h"

namespace phos {

/// Coefficients of a turned function = matrix times the coefficients, for the cosines and for the sines of
/// all bands, row after row.
struct Turn {
  explicit Turn(int of_order)
      : order(of_order), cosine(cosines() * cosines(), 0.), sine(sines() * sines(), 0.) {}
  int order;
  std::vector<double> cosine, sine;

  std::size_t cosines() const { return cosine_index(order, 0); }
  std::size_t sines() const { return sine_index(order, 1); }
  /// Place among the cosines, m >= 0, and among the sines sin(m phi), m > 0.
  static std::size_t cosine_index(int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); }
  static std::size_t sine_index(int l, int m) { return static_cast<std::size_t>(l * (l - 1) / 2 + m - 1); }
};

/// SH, exact: nonzero between equal bands alone. The band's two blocks: rows and columns m = 0 .. l, and
/// m = 1 .. l.
struct BandTurn {
  std::vector<double> cosine, sine;
};
std::vector<BandTurn> sh_turn(int order, double beta);

/// HSH, by each method, least squares over the hemisphere: beta in [0, pi], radians. Quadrature, to about
/// 1e-12; time grows as order^6.
Turn hsh_turn(int order, HshRotation method, double beta);

}  // namespace phos
