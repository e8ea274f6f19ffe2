// Points and weights that integrate products of harmonics over the sphere and the hemisphere.
#pragma once

#include <vector>

namespace phos::inline hsh {

struct Quadrature {
  std::vector<double> x, y, z;  ///< unit directions, local, z up
  std::vector<double> weight;   ///< sr; they add up to 2 pi (hemisphere) or 4 pi (sphere)
  std::size_t size() const { return weight.size(); }
};

/// Gauss-Legendre of `n` points on [-1, 1], to double precision. n >= 1.
void gauss_legendre(int n, std::vector<double>& points, std::vector<double>& weights);

/// Hemisphere: Gauss-Legendre in sqrt(z) (`rings` points) times `sectors` uniform azimuths: spectral
/// convergence also for the sqrt(z) of odd m.
Quadrature hemisphere_quadrature(int rings, int sectors);
/// Sphere: Gauss-Legendre in z.
Quadrature sphere_quadrature(int rings, int sectors);

}  // namespace phos::inline hsh
