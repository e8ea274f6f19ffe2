// Matrices of the rotation about y of hemispherical harmonics, Ry(beta): +z goes to (sin beta, 0, cos beta),
// which mixes cosines (m >= 0) among themselves and sines (m < 0) among themselves.
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

}  // namespace phos::inline hsh
