// Real spherical harmonics (SH, orthonormal on the sphere) and hemispherical harmonics (HSH, orthonormal on
// the upper hemisphere; Gautron et al. 2004).
#pragma once

#include <cstddef>

namespace phos::inline hsh {

/// Order n = number of bands l = 0 .. n-1; a function has n^2 coefficients, index l*l + l + m, -l <= m <= l.
/// m > 0: cos(m phi), m < 0: sin(|m| phi), with the Condon-Shortley phase (-1)^m (Y_1^1 = -0.4886 x).
constexpr int harmonic_count(int order) { return order * order; }
constexpr int harmonic_index(int l, int m) { return l * l + l + m; }

enum class BasisKind : unsigned char { sh, hsh };

/// Both bases up to one order; directions are Cartesian, local, z up, unit. Values and gradients are finite
/// at the pole and the horizon: no trigonometry, no factorial, no division by sin(theta). Below the horizon
/// HSH are taken at the horizon (z = max(z, 0)). A direction that is not unit gives a defined, finite value
/// for any finite input, but no harmonic; NaN gives NaN. Const, usable from any thread. Real: float or
/// double.
template <class Real>
class HarmonicBasis {
 public:
  static constexpr int kMaxOrder = 100;  ///< no float overflows below it
  /// Throws Error(usage) unless 1 <= order <= kMaxOrder.
  explicit HarmonicBasis(int order);
  int order() const { return order_; }
  int count() const { return harmonic_count(order_); }

  /// out[count()].
  void evaluate(BasisKind kind, Real x, Real y, Real z, Real* out) const;
  /// Surface gradient of every function too: the derivative for a motion of the direction on the sphere,
  /// Cartesian, tangent to it, per radian. gz of HSH with |m| = 1 grows as z^(-1/2) towards the horizon and
  /// is 0 by convention at z = 0; gx and gy are finite everywhere. out, gx, gy [count()]; gz too, or null.
  void evaluate(BasisKind kind, Real x, Real y, Real z, Real* out, Real* gx, Real* gy, Real* gz) const;
  /// `n` directions at once, structure of arrays: out[i * n + k] is function i at direction k. Vectorised.
  void evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y, const Real* z,
                      Real* out) const;
  /// And their surface gradients: gx, gy and gz (or null) [count() * n] as `out`.
  void evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y, const Real* z, Real* out,
                      Real* gx, Real* gy, Real* gz) const;

 private:
  int order_;
};

}  // namespace phos::inline hsh
