// From cosine-weighted moments of light to the light itself.
#pragma once

#include <vector>

namespace phos::inline estimate {

/// Light L of which only the moments b_i = integral of L cos(theta) H_i dw are known, as the photons that
/// land on a surface tell them: its coefficients c solve G c = b, G_ij = integral of H_i H_j cos(theta) dw.
/// That is the fit of least squares weighted by the cosine: exact for light of no more bands, and its
/// irradiance is the irradiance of the moments. No photon is divided by its own cosine, whose inverse has no
/// variance at the horizon.
///
/// cos(theta) = (Z + 1) / 2 on the sphere of which HSH are harmonics, so that G is tridiagonal in l for each
/// m: 1/2 on the diagonal, sqrt((l^2 - m^2) / (4 l^2 - 1)) / 2 beside it. It is positive definite, its least
/// eigenvalue (1 + least node of Gauss-Legendre quadrature) / 2: 0.013 for order 10.
class CosineFit {
 public:
  explicit CosineFit(int order);
  /// [order^2][3], in place.
  void solve(std::vector<double>& moments) const;

 private:
  int order_;
  std::vector<double> before_, pivot_;  // G = U^T D U: U beside the diagonal, 1 / D
};

}  // namespace phos::inline estimate
