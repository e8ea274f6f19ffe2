// Reflection lobes that bases of the hemisphere are compared by: cos^5 and Ward's anisotropic 0.2 / 0.5, for
// one outgoing direction or the mean over a grid of them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "hsh/comparison_bases.h"

namespace phos::test {

/// max(0, cos)^exponent about an axis tilted by `theta` towards +x; times z with `cosine`.
inline DirectionalFunction phong_lobe(double exponent, double theta, bool cosine = false) {
  return [=](double x, double, double z) {
    const double c = std::sin(theta) * x + std::cos(theta) * z;
    return std::pow(c > 0 ? c : 0, exponent) * (cosine ? z : 1);
  };
}

/// Ward (1992), from the outgoing direction (theta, phi); times z with `cosine`.
inline DirectionalFunction ward_lobe(double ax, double ay, double theta, double phi, bool cosine = false) {
  const double ox = std::sin(theta) * std::cos(phi), oy = std::sin(theta) * std::sin(phi),
               oz = std::cos(theta);
  return [=](double x, double y, double z) {
    const double hx = x + ox, hy = y + oy, hz = z + oz;
    const double e = (hx / ax * (hx / ax) + hy / ay * (hy / ay)) / (hz * hz);
    return std::exp(-e) / (4 * std::numbers::pi * ax * ay * std::sqrt(z * oz)) * (cosine ? z : 1);
  };
}

struct WeightedLobe {
  DirectionalFunction f;
  double weight = 1;
};

/// theta and phi of the 16 x 16 grid on the parabolic map, as far as they are inside its disc.
inline std::vector<std::pair<double, double>> parabolic_directions() {
  std::vector<std::pair<double, double>> directions;
  for (int v = 0; v < 16; ++v) {
    for (int u = 0; u < 16; ++u) {
      const double a = (2 * u + 1) / 16. - 1, b = (2 * v + 1) / 16. - 1, r2 = a * a + b * b;
      if (r2 < 1) directions.emplace_back(std::acos((1 - r2) / (1 + r2)), std::atan2(b, a));
    }
  }
  return directions;
}

/// cos^5 lobes: their azimuth does not matter, so each angle occurs once, weighted.
inline std::vector<WeightedLobe> phong_means(bool cosine) {
  std::vector<std::pair<double, double>> angles;  // theta, how often
  for (const auto& [theta, phi] : parabolic_directions()) {
    bool found = false;
    for (auto& [known, often] : angles) {
      if (std::fabs(known - theta) < 1e-9) often += 1, found = true;
    }
    if (!found) angles.emplace_back(theta, 1);
  }
  std::vector<WeightedLobe> lobes;
  for (const auto& [theta, often] : angles) lobes.push_back({phong_lobe(5, theta, cosine), often});
  return lobes;
}

/// Ward's lobes: one quarter stands for all by symmetry; without grazing ones (from 80 degrees).
inline std::vector<WeightedLobe> ward_means(bool cosine) {
  const double pi = std::numbers::pi;
  std::vector<WeightedLobe> lobes;
  for (const auto& [theta, phi] : parabolic_directions()) {
    if (phi < 0 || phi > pi / 2 || theta >= 80 * pi / 180) continue;
    lobes.push_back({ward_lobe(.2, .5, theta, phi, cosine), 1});
  }
  return lobes;
}

inline double mean_accuracy(const std::vector<WeightedLobe>& lobes, ComparisonBasis basis, int order) {
  const Quadrature q = hemisphere_quadrature(48, 96);
  double sum = 0, weight = 0;
  for (const WeightedLobe& lobe : lobes) {
    sum += lobe.weight * accuracy_by_order(lobe.f, basis, order, q).back();
    weight += lobe.weight;
  }
  return sum / weight;
}

}  // namespace phos::test
