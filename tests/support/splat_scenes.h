// A scene whose light is known, from the estimates of its records to splats over the view of its camera.
#pragma once

#include <algorithm>
#include <vector>

#include "splat/cpu/splatter.h"
#include "support/records.h"

namespace phos::test {

/// A cache without records.
inline IrradianceCache empty_cache(Quantity paths, double accuracy) {
  IrradianceCache cache;
  cache.accuracy = accuracy;
  cache.quantity = paths;
  return cache;
}

/// Records where `gbuffer` sees a surface, as a loop over misses places them.
inline IrradianceCache records_in_view(const Lit& lit, const GBuffer& gbuffer, Quantity paths,
                                       double accuracy) {
  RecordOptions options = all_light(*lit.scene);
  options.paths = paths;
  options.accuracy = accuracy;
  IrradianceCache cache = empty_cache(paths, accuracy);
  std::vector<SurfaceSample> visible;
  for (std::size_t i = 0; i < gbuffer.hit.size(); ++i)
    if (gbuffer.covered(i)) visible.push_back({Vec3(gbuffer.position[i]), Vec3(gbuffer.normal[i])});
  Counters counters;
  place_at_points(cache, lit.photons, *lit.rays, options, {}, 1, visible, counters);
  return cache;
}

/// How the pixels of a picture of irradiance stand to the closed form.
struct Agreement {
  double pixels = 0;          ///< compared: lit, on surfaces that reflect
  double missing = 0;         ///< share without a value
  double within = 0;          ///< share within 3 standard errors + allowance x truth
  double within_two = 0;      ///< share within 2 standard errors + allowance x truth
  double relative_bias = 0;   ///< of the mean
  double relative_error = 0;  ///< mean standard error / mean
};

/// value and error per pixel, lx; a negative value is a pixel without one.
inline Agreement compare(const AnalyticScene& s, const GBuffer& gbuffer, const std::vector<double>& value,
                         const std::vector<double>& error, double allowance) {
  Agreement a;
  double sum = 0, truths = 0, errors = 0, compared = 0;
  for (std::size_t i = 0; i < gbuffer.hit.size(); ++i) {
    if (!gbuffer.covered(i)) continue;
    const Vec3 p(gbuffer.position[i]), n(gbuffer.normal[i]);
    if (!(max_component(s.scene.material_of(gbuffer.hit[i].triangle).kd) > 0)) continue;
    const double truth = s.irradiance_lx ? s.irradiance_lx(p, n) : s.mean_irradiance_lx;
    if (!(truth > 0)) continue;
    ++a.pixels;
    if (value[i] < 0) {
      ++a.missing;
      continue;
    }
    ++compared;
    const double off = std::fabs(value[i] - truth) - allowance * truth;
    a.within += off <= 3 * error[i], a.within_two += off <= 2 * error[i];
    sum += value[i], truths += truth, errors += error[i];
  }
  a.missing /= a.pixels, a.within /= compared, a.within_two /= compared;
  a.relative_bias = sum / truths - 1, a.relative_error = errors / truths;
  return a;
}

/// Normalised splats, channel G.
inline Agreement compare(const AnalyticScene& s, const GBuffer& gbuffer, const SplatBuffer& splats,
                         double allowance) {
  std::vector<double> value(splats.light.size(), -1), error(splats.light.size(), 0);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Interpolated found = splats.at(i);
    if (!(found.weight > 0)) continue;
    value[i] = static_cast<double>(found.irradiance.y);
    error[i] = static_cast<double>(found.stderr_lx.y);
  }
  return compare(s, gbuffer, value, error, allowance);
}

}  // namespace phos::test
