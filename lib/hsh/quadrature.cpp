#include "hsh/quadrature.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline hsh {

namespace {

/// Every ring (its z and its weight for all azimuths) at `sectors` uniform azimuths.
Quadrature sweep(const std::vector<double>& ring_z, const std::vector<double>& ring_weight, int sectors) {
  PHOS_CHECK(sectors >= 1, "sectors = ", sectors);
  Quadrature q;
  for (std::size_t r = 0; r < ring_z.size(); ++r) {
    const double z = ring_z[r], radius = std::sqrt((1 - z) * (1 + z));
    for (int k = 0; k < sectors; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.5) / sectors;
      q.x.push_back(radius * std::cos(phi));
      q.y.push_back(radius * std::sin(phi));
      q.z.push_back(z);
      q.weight.push_back(ring_weight[r] * 2 * std::numbers::pi / sectors);
    }
  }
  return q;
}

}  // namespace

void gauss_legendre(int n, std::vector<double>& points, std::vector<double>& weights) {
  PHOS_CHECK(n >= 1, "n = ", n);
  points.assign(static_cast<std::size_t>(n), 0);
  weights.assign(static_cast<std::size_t>(n), 0);
  // Newton from Tricomi's estimate of each root of P_n; symmetric, so half of them.
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2. * k - 1) * x * p - (k - 1.) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (before - x * p) / ((1 - x) * (1 + x));
      const double change = p / slope;
      x -= change;
      if (std::fabs(change) <= 1e-15) break;
    }
    if (2 * i + 1 == n) x = 0;
    const std::size_t low = static_cast<std::size_t>(i), high = static_cast<std::size_t>(n - 1 - i);
    points[low] = -x;
    points[high] = x;
    weights[low] = weights[high] = 2 / ((1 - x) * (1 + x) * slope * slope);
  }
}

Quadrature hemisphere_quadrature(int rings, int sectors) {
  std::vector<double> z, weight;
  gauss_legendre(rings, z, weight);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double t = 0.5 * (1 + z[i]);  // z = t^2, dz = 2 t dt
    z[i] = t * t;
    weight[i] *= t;
  }
  return sweep(z, weight, sectors);
}

Quadrature sphere_quadrature(int rings, int sectors) {
  std::vector<double> z, weight;
  gauss_legendre(rings, z, weight);
  return sweep(z, weight, sectors);
}

}  // namespace phos::inline hsh
