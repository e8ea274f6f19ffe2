// Other bases of functions on the hemisphere, to compare hemispherical harmonics with. Not made for speed.
#pragma once

#include <string>
#include <vector>

#include "hsh/projection.h"

namespace phos::inline hsh {

/// All but `sh` (orthonormal on the sphere; a function is taken to be 0 below the horizon) are orthonormal on
/// the hemisphere. Makhotkin's own definition (1996) is known here only from those who cite it: both
/// readings are given.
enum class ComparisonBasis : unsigned char {
  hsh,
  sh,
  even_sh,            ///< sqrt(2) Y_l^m with l + m even: functions mirrored at the horizon
  zernike,            ///< Koenderink's: (1-z)^(m/2) P_k^(m,0)(2z-1), degree N = 2k + m
  makhotkin_m0,       ///< (1-z)^(m/2) P_(l-m)^(m,0)(2z-1)
  makhotkin_adjoint,  ///< sqrt(z) (z (1-z))^(m/2) P_(l-m)^(m,m+1)(2z-1): all vanish at the horizon
};
inline constexpr ComparisonBasis kComparisonBases[] = {
    ComparisonBasis::hsh,     ComparisonBasis::sh,           ComparisonBasis::even_sh,
    ComparisonBasis::zernike, ComparisonBasis::makhotkin_m0, ComparisonBasis::makhotkin_adjoint};
std::string name(ComparisonBasis basis);

/// How many functions there are of the degrees 0 .. order - 1: order^2, or order (order + 1) / 2 where those
/// with odd l + m do not exist (even_sh, zernike).
int comparison_count(ComparisonBasis basis, int order);

/// out[comparison_count(basis, order)], by degree, in each by m. Directions as HarmonicBasis has them, finite
/// at the pole and the horizon. Throws Error(usage) for an order outside 1 .. HarmonicBasis::kMaxOrder.
void evaluate_comparison(ComparisonBasis basis, int order, double x, double y, double z, double* out);

/// Entry n-1: the share of the integral of f^2 over the hemisphere that the functions of the first n degrees
/// hold, by a quadrature of the hemisphere. 1 where f is 0.
std::vector<double> accuracy_by_order(const DirectionalFunction& f, ComparisonBasis basis, int order,
                                      const Quadrature& hemisphere);

}  // namespace phos::inline hsh
