// Chi-squared tests that samples follow their density.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "core/vector.h"

namespace phos::test {

/// Upper tail of the chi-squared distribution, Q(k/2, x/2).
inline double chi2_tail(double statistic, int degrees) {
  return statistic > 0 ? boost::math::gamma_q(0.5 * degrees, 0.5 * statistic) : 1;
}

struct Chi2 {
  double statistic = 0, p = 0;
  int degrees = 0;
};

/// Cells that expect fewer than 5 are pooled.
inline Chi2 chi2_test(const std::vector<double>& observed, const std::vector<double>& expected) {
  Chi2 result;
  int cells = 0;
  double pooled_observed = 0, pooled_expected = 0;
  const auto add = [&](double o, double e) {
    result.statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5) {
      add(observed[i], expected[i]);
    } else {
      pooled_observed += observed[i], pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= 5) {
    add(pooled_observed, pooled_expected);
  } else if (pooled_observed > pooled_expected + 5 * std::sqrt(pooled_expected + 1) + 5) {
    return {1e300, 0, cells};  // samples where there is no density
  }
  result.degrees = cells - 1;
  result.p = cells < 2 ? 1 : chi2_tail(result.statistic, result.degrees);
  return result;
}

/// Sidak: the least p that one of `tests` independent tests may show for a chance of `significance` to fail
/// any.
inline double least_p(double significance, int tests) { return 1 - std::pow(1 - significance, 1.0 / tests); }

/// A grid of equal solid angles over the sphere about z.
struct SphereGrid {
  int cosines = 24, azimuths = 48, fine = 20;  ///< fine: even
  std::size_t size() const { return static_cast<std::size_t>(cosines * azimuths); }
  std::size_t cell(const Vec3& d) const {
    const double phi = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x));
    const double turn = phi < 0 ? phi / (2 * M_PI) + 1 : phi / (2 * M_PI);
    const int i = std::clamp(static_cast<int>((static_cast<double>(d.z) + 1) / 2 * cosines), 0, cosines - 1);
    const int j = std::clamp(static_cast<int>(turn * azimuths), 0, azimuths - 1);
    return static_cast<std::size_t>(i * azimuths + j);
  }
  /// Integral of f(direction) over each cell with fine x fine points: midpoints of azimuths, Gauss's pairs of
  /// cosines, which resolve a sharp lobe about the pole.
  template <class F>
  std::vector<double> integrate(const F& f) const {
    std::vector<double> sums(size(), 0.0);
    const int rows = cosines * fine, columns = azimuths * fine;
    const double solid_angle = 4 * M_PI / rows / columns;
    for (int r = 0; r < rows; ++r) {
      const double middle = r / 2 * 2 + 1, z = -1 + 2 * (middle + (r % 2 ? 1 : -1) / std::sqrt(3.0)) / rows;
      const double s = std::sqrt(1 - z * z);
      for (int c = 0; c < columns; ++c) {
        const double phi = 2 * M_PI * (c + 0.5) / columns;
        const Vec3 d(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                     static_cast<float>(z));
        sums[static_cast<std::size_t>(r / fine * azimuths + c / fine)] += f(d) * solid_angle;
      }
    }
    return sums;
  }
};

/// Draws `count` directions with sample(random, direction) -> bool (false: none) and compares with
/// density(direction) per sr, whose shortfall from 1 is the share of "none".
template <class Sample, class Density>
Chi2 chi2_directions(const SphereGrid& grid, std::uint64_t seed, int count, const Sample& sample,
                     const Density& density) {
  std::vector<double> observed(grid.size() + 1, 0.0), expected = grid.integrate(density);
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, Stage::test, static_cast<std::uint64_t>(k));
    Vec3 d;
    observed[sample(random, d) ? grid.cell(d) : grid.size()] += 1;
  }
  expected.push_back(std::max(0.0, 1 - std::accumulate(expected.begin(), expected.end(), 0.0)));
  for (double& e : expected) e *= count;
  return chi2_test(observed, expected);
}

}  // namespace phos::test
