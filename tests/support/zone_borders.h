// What estimators of irradiance make of a zone that a straight edge cuts: the surface's own border, or the
// edge of a shadow. The zone has radius 1; irradiance is 1 where there is light; photons are a Poisson
// process.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "photon/density.h"

namespace phos::test {

enum class ZoneEdge {
  border,  ///< the surface ends there
  shadow,  ///< the surface goes on in the dark
};

/// How an estimate errs over many zones, in parts of the irradiance on the lit side.
struct EdgeErrors {
  double bias = 0, bias_error = 0, rmse = 0;  ///< bias_error: one standard error of `bias`
};

inline int poisson(RandomStream& random, double mean) {
  // Sum of waiting times: exact, and quick enough here.
  int n = -1;
  for (double t = 0; t < mean; ++n) t -= std::log(1 - random.uniform_double());
  return n;
}

/// Errors at a point `distance` zone radii from the edge, on the lit side (negative: in the shadow), of a
/// whole zone of `photons` on average. `estimate` takes offsets, fluxes and OnSurface.
template <class Estimate>
EdgeErrors edge_errors(ZoneEdge edge, double distance, double photons, int zones, std::uint64_t item,
                       const Estimate& estimate) {
  RandomStream random(13, Stage::test, item);
  const auto lit = [&](const Vec2& p) { return static_cast<double>(p.x) > -distance; };
  const OnSurface surface = [&](const Vec2& p) { return edge == ZoneEdge::shadow || lit(p); };
  const double truth = distance >= 0 ? 1 : 0;
  double sum = 0, squares = 0;
  std::vector<Vec2> points;
  std::vector<Rgb> flux;
  for (int r = 0; r < zones; ++r) {
    random.start_bounce(static_cast<std::uint32_t>(r));
    points.clear();
    for (int i = poisson(random, photons); i > 0; --i) {
      const Vec2 p = sample_disc(random.uniform2());
      if (lit(p)) points.push_back(p);
    }
    flux.assign(points.size(), Rgb(kPi / static_cast<float>(photons)));
    const double error = static_cast<double>(estimate(points, flux, surface)) - truth;
    sum += error, squares += error * error;
  }
  const double mean = sum / zones, variance = std::max(0.0, squares / zones - mean * mean);
  return {mean, std::sqrt(variance / zones), std::sqrt(squares / zones)};
}

/// With the options of records.
inline EdgeErrors hull_errors(ZoneEdge edge, double distance, double photons, int zones, std::uint64_t item) {
  DensityScratch scratch;
  return edge_errors(
      edge, distance, photons, zones, item, [&](const auto& points, const auto& flux, const OnSurface& on) {
        return zone_irradiance(points, flux, 1, on, {.probes = 128, .dark_photons = 6.9}, scratch)
            .irradiance.x;
      });
}

inline EdgeErrors kernel_errors(Kernel kernel, ZoneEdge edge, double distance, double photons, int zones,
                                std::uint64_t item) {
  DensityScratch scratch;
  return edge_errors(edge, distance, photons, zones, item,
                     [&](const auto& points, const auto& flux, const OnSurface&) {
                       return kernel_irradiance(points, flux, 1, kernel, scratch).irradiance.x;
                     });
}

/// Part of a kernel's integral on the lit side of an edge, which is the share of the light that it finds: for
/// a chord at -d, the integral over x > -d of the kernel's profile 2 int_0^sqrt(1-x2) k(x2 + y2) dy, by the
/// midpoint rule.
inline double kernel_share(Kernel kernel, double distance) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -distance + (1 + distance) * (i + 0.5) / kSteps, half = std::sqrt(1 - x * x);
    for (int j = 0; j < kSteps; ++j) {
      const double y = half * (j + 0.5) / kSteps, r = std::sqrt(x * x + y * y);
      const double k = kernel == Kernel::disc           ? 1 / std::numbers::pi
                       : kernel == Kernel::epanechnikov ? 2 / std::numbers::pi * (1 - r * r)
                                                        : 3 / std::numbers::pi * (1 - r);
      sum += 2 * k * half;
    }
  }
  return sum * (1 + distance) / (double{kSteps} * kSteps);
}

}  // namespace phos::test
