#include "estimate/record_of.h"

#include <algorithm>

#include "core/error.h"
#include "core/origin.h"
#include "estimate/hemisphere/ray_gradients.h"

namespace phos::inline estimate {
namespace {

/// Channels dimmer than this part of the brightest have no say in the radius.
constexpr float kChannelCounts = 0.01f;
/// Samples of lamps hold the cosines that divide them here: only rounding is kept out.
constexpr float kLeastCosine = 1e-6f;

void add(Gradients& sum, const Gradients& g, float weight) {
  for (int c = 0; c < 3; ++c) {
    sum.rotation[c] += weight * g.rotation[c], sum.translation[c] += weight * g.translation[c];
  }
}

/// Of the variance of the luminance (were its channels one).
float shared_part(const PlaceLight& light) {
  const double all = static_cast<double>(luminance(light.stderr_lx)),
               shared = static_cast<double>(luminance(Rgb(glm::sqrt(light.shared_lx2))));
  return all > 0 ? static_cast<float>(std::min(1.0, shared * shared / (all * all))) : 0;
}

}  // namespace

PlaceLight light_of(std::span<const Hemisphere> passes, const RecordOptions& resolved) {
  double rays = 0;
  bool stratified = true;
  for (const Hemisphere& h : passes) {
    rays += static_cast<double>(h.size());
    stratified = stratified && h.stratified();
  }
  // The radius asks for them even where the record is to have none.
  GradientMode mode = resolved.gradients;
  if (mode == GradientMode::none) mode = stratified ? GradientMode::hybrid : GradientMode::analytic;
  PlaceLight light;
  DVec3 sum(0), variance(0), source(0);
  double nearness = 0, light_nearness = 0;
  float least_m = kInfinity;
  for (const Hemisphere& h : passes) {
    const double weight = static_cast<double>(h.size()) / rays;
    const DVec3 error = weight * DVec3(standard_error_of(h));
    sum += weight * DVec3(irradiance_of(h));
    variance += error * error;
    source += weight * h.source.total();  // the same for all passes
    const auto distance_m = static_cast<double>(harmonic_distance_m(h));
    nearness += distance_m > 0 ? weight / distance_m : HUGE_VAL;
    least_m = std::min(least_m, least_distance_m(h));
    light_nearness +=
        weight * static_cast<double>(luminance(irradiance_of(h))) / static_cast<double>(light_distance_m(h));
    add(light.gradients, ray_gradients(h, mode, static_cast<float>(*resolved.min_radius_m)),
        static_cast<float>(weight));
  }
  light.irradiance = Rgb(sum);
  light.stderr_lx = Rgb(glm::sqrt(variance + source));
  light.shared_lx2 = source;
  const float mean_m = nearness > 0 ? static_cast<float>(1 / nearness) : kInfinity;
  light.distance_m = resolved.radius == RadiusRule::least ? least_m : mean_m;
  if (resolved.radius == RadiusRule::light && light_nearness > 0)
    light.light_m = static_cast<float>(static_cast<double>(luminance(light.irradiance)) / light_nearness);
  return light;
}

void add_lamps(std::span<const LampSample> lamps, int samples, const Luminaires& lights, const Vec3& n,
               const RecordOptions& resolved, PlaceLight& light) {
  const auto least_m = static_cast<float>(*resolved.min_radius_m);
  Gradients gradients;
  double brightness_per_m = 0;
  float nearest_m = kInfinity;
  for (const LampSample& lamp : lamps) {
    brightness_per_m +=
        static_cast<double>(luminance(lamp.irradiance)) / static_cast<double>(lamp.distance_m);
    nearest_m = std::min(nearest_m, lamp.distance_m);
    const Vec3& w = lamp.direction;
    Vec3 change = 3.f * w;
    if (lights[lamp.light].kind == Light::Kind::area)
      change = lamp.normal / std::max(kLeastCosine, -glm::dot(lamp.normal, w)) + 4.f * w;
    const Vec3 translation = (change - glm::dot(change, n) * n) / std::max(lamp.distance_m, least_m);
    const Vec3 rotation = glm::cross(n, w) / std::max(kLeastCosine, glm::dot(n, w));
    for (int c = 0; c < 3; ++c) {
      gradients.rotation[c] += lamp.irradiance[c] * rotation;
      gradients.translation[c] += lamp.irradiance[c] * translation;
    }
  }
  const LampSum sum = sum_of(lamps, samples, lights);
  const double around = static_cast<double>(luminance(light.irradiance));
  const double straight = static_cast<double>(luminance(Rgb(sum.irradiance)));
  const auto with_lamps = [&](float& distance_m) {
    const double per_m = around / static_cast<double>(distance_m) + brightness_per_m;
    distance_m = per_m > 0 ? static_cast<float>((around + straight) / per_m) : kInfinity;
  };
  if (resolved.radius == RadiusRule::least) {
    light.distance_m = std::min(light.distance_m, nearest_m);
  } else if (straight > 0 && light.distance_m > 0) {
    with_lamps(light.distance_m);
    if (resolved.radius == RadiusRule::light) with_lamps(light.light_m);
  }
  light.irradiance += Rgb(sum.irradiance);
  light.stderr_lx = Rgb(glm::sqrt(DVec3(light.stderr_lx) * DVec3(light.stderr_lx) + sum.variance));
  add(light.gradients, gradients, 1);
}

float within_gradient_m(const Rgb& irradiance, const Vec3 (&translation_gradient)[3], float radius_m) {
  const float brightest = max_component(irradiance);
  for (int c = 0; c < 3; ++c) {
    // In double: the square of a steep or a faint slope is beyond floats.
    const double slope = glm::length(DVec3(translation_gradient[c])),
                 light = static_cast<double>(irradiance[c]);
    if (irradiance[c] > kChannelCounts * brightest && slope > 0 && radius_m > 0 &&
        slope * static_cast<double>(radius_m) > light)
      radius_m = static_cast<float>(light / slope);
  }
  return radius_m;
}

void require_finite(const DVec3& origin_m, const Vec3& p, const Rgb& irradiance, const Rgb& stderr_lx,
                    const Vec3 (&rotation_gradient)[3], const Vec3 (&translation_gradient)[3]) {
  bool finite = is_finite(irradiance) && is_finite(stderr_lx);
  for (int c = 0; c < 3; ++c)
    finite = finite && is_finite(rotation_gradient[c]) && is_finite(translation_gradient[c]);
  if (!finite) throw_beyond_range(origin_m, p);
}

void throw_beyond_range(const DVec3& origin_m, const Vec3& p) {
  throw Error(ExitCode::numerical, "",
              "irradiance at " + place_text(origin_m, p) +
                  " exceeds the range of numbers; give the lights or the scene other units");
}

Made record_of(const RecordSite& site, const PlaceLight& light, const RecordOptions& resolved,
               const DVec3& origin_m) {
  const Vec3& p = site.position;
  require_finite(origin_m, p, light.irradiance, light.stderr_lx, light.gradients.rotation,
                 light.gradients.translation);
  IrradianceRecord record;
  record.position = p, record.normal = site.normal;
  record.irradiance = light.irradiance, record.stderr_lx = light.stderr_lx;
  record.shared = shared_part(light);
  record.distance_m = light.distance_m;
  const float most_m =
      std::min({light.distance_m, light.light_m, static_cast<float>(*resolved.max_radius_m)});
  const float radius_m = within_gradient_m(light.irradiance, light.gradients.translation, most_m);
  for (int c = 0; c < 3 && resolved.gradients != GradientMode::none; ++c) {
    record.rotation_gradient[c] = light.gradients.rotation[c];
    record.translation_gradient[c] = light.gradients.translation[c];
  }
  record.radius_m = std::max(radius_m, std::numeric_limits<float>::min());
  Made made{record, 0, site.least_radius_m, site.most_radius_m};
  made.light_m = light.light_m;
  return made;
}

Made record_of(const RecordSite& site, std::span<const Hemisphere> passes, const RecordOptions& resolved) {
  return record_of(site, light_of(passes, resolved), resolved);
}

}  // namespace phos::inline estimate
