#include "reference/light_starts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sampling.h"
#include "scene/material/sharp_materials.h"
#include "scene/sky/environment.h"

namespace phos::inline reference {
namespace {

/// No light falls below this part of an equal share.
constexpr double kMinimumShare = 0.1;
/// Part of the rays that are aimed, where there is something to aim at.
constexpr double kAimed = 0.5;
/// Targets are smaller than this part of the scene's radius: larger ones are hit anyway.
constexpr double kLargestTarget = 0.25;
/// More are taken as one.
constexpr std::size_t kMostTargets = 32;
/// A target seen under less than this, as the sine of half its angle, is not aimed at: directions in single
/// precision would not tell it from its surroundings.
constexpr double kLeastSine = 1e-4;
/// Rays from infinity start this far before the sphere about the scene, in its radii, so that surfaces that
/// touch the sphere are not behind the start.
constexpr double kBeforeScene = 1.001;

double ratio(const Rgb& part, const Rgb& whole) {
  const double all = luminance(whole);
  return all > 0 ? luminance(part) / all : 0;
}

/// Sine of half the angle under which a sphere is seen, and the direction to its middle. False from within.
bool see(const DVec3& centre, double radius_m, const Vec3& place, DVec3& towards, double& sine) {
  const DVec3 way = centre - DVec3(place);
  const double distance = glm::length(way);
  if (!(distance > radius_m)) return false;
  towards = way / distance, sine = radius_m / distance;
  return sine >= kLeastSine;
}

double cone_sr(double sine) {
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  return 2 * std::numbers::pi * sine * sine / (1 + cosine);
}

}  // namespace

LightStarts::LightStarts(const Scene& scene, const Luminaires& luminaires)
    : scene_(&scene), luminaires_(&luminaires), radius_m_(static_cast<double>(bounding_radius_m(scene))) {
  if (luminaires.size() > 0) share_ = luminaires.power_shares(kMinimumShare);
  double sum = 0;
  for (const double share : share_) cdf_.push_back(sum += share);
  find_targets();
}

void LightStarts::find_targets() {
  Bounds all;
  for (const Instance& instance : scene_->instance) {
    if (!reflects_sharply(scene_->material[instance.material])) continue;
    Bounds box;
    for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
      for (const std::uint32_t v : scene_->triangle[instance.first_triangle + t].v)
        box.include(scene_->position[v]);
    const DVec3 centre(box.centre());
    double radius_m = 0;
    for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
      for (const std::uint32_t v : scene_->triangle[instance.first_triangle + t].v)
        radius_m = std::max(radius_m, glm::length(DVec3(scene_->position[v]) - centre));
    if (box.empty() || !(radius_m > 0) || radius_m > kLargestTarget * radius_m_) continue;
    target_.push_back({centre, radius_m});
    all.include(box.lo), all.include(box.hi);
  }
  if (target_.size() > kMostTargets)
    target_ = {{DVec3(all.centre()), 0.5 * static_cast<double>(all.diagonal_m())}};
}

std::size_t LightStarts::choose_light(double u) const {
  const auto i = std::upper_bound(cdf_.begin(), cdf_.end() - 1, u * cdf_.back()) - cdf_.begin();
  return static_cast<std::size_t>(i);
}

/// Towards a target, uniform over the solid angle under which its sphere is seen. False: not to be aimed,
/// this time.
bool LightStarts::aim(const Vec3& place, RandomStream& random, Vec3& direction) const {
  if (target_.empty() || !(random.uniform_double() < kAimed)) return false;
  const auto n = static_cast<double>(target_.size());
  const auto k = std::min(static_cast<std::size_t>(random.uniform_double() * n), target_.size() - 1);
  DVec3 towards;
  double sine;
  if (!see(target_[k].centre, target_[k].radius_m, place, towards, sine)) return false;
  const double one_less_cosine =
      random.uniform_double() * sine * sine / (1 + std::sqrt(std::max(0.0, 1 - sine * sine)));
  const double side = std::sqrt(one_less_cosine * (2 - one_less_cosine));
  const Frame frame = make_frame(Vec3(towards));
  const Vec2 turn = cos_sin(random.uniform());
  const DVec3 across =
      static_cast<double>(turn.x) * DVec3(frame.x) + static_cast<double>(turn.y) * DVec3(frame.y);
  direction = Vec3(glm::normalize((1 - one_less_cosine) * towards + side * across));
  return true;
}

/// Of the directions that are not aimed, per sr.
double LightStarts::lobe_density(std::size_t i, const Vec3& normal, const Vec3& direction) const {
  const Light& light = (*luminaires_)[i];
  switch (light.kind) {
    case Light::Kind::area: {
      const bool both = scene_->material[scene_->instance[light.instance].material].double_sided;
      const double cosine = static_cast<double>(glm::dot(normal, direction));
      return std::max(cosine, 0.0) / std::numbers::pi * (both ? 0.5 : 1);
    }
    case Light::Kind::spot:
      return spot_falloff(light, DVec3(direction)) > 0 ? 1 / (2 * std::numbers::pi * (1 - light.cos_outer))
                                                       : 0;
    case Light::Kind::measured: {
      const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
      return ratio(fitting.intensity_cd(direction), fitting.flux_lm());
    }
    default:
      return 1 / (4 * std::numbers::pi);
  }
}

Vec3 LightStarts::sample_lobe(const Light& light, const Vec3& normal, RandomStream& random) const {
  const Vec2 u = random.uniform2();
  switch (light.kind) {
    case Light::Kind::area:
      return make_frame(normal).to_world(sample_cosine_hemisphere(u));
    case Light::Kind::spot: {
      const double rise = static_cast<double>(u.x) * (1 - light.cos_outer);
      const auto sine = static_cast<float>(std::sqrt(rise * (2 - rise)));
      return make_frame(light.direction).to_world(Vec3(sine * cos_sin(u.y), static_cast<float>(1 - rise)));
    }
    case Light::Kind::measured:
      return scene_->fitting[static_cast<std::size_t>(light.fitting)].sample_direction(u);
    default:
      return sample_uniform_sphere(u);
  }
}

/// Of lines along a direction, per m2 across it: discs about the scene and about each target.
double LightStarts::across_density(const Vec3& place, const Vec3& direction) const {
  const DVec3 p(place), d(direction);
  const auto in_disc = [&](const DVec3& centre, double radius_m) {
    const DVec3 aside = glm::cross(p - centre, d);
    return glm::dot(aside, aside) <= radius_m * radius_m ? 1 / (std::numbers::pi * radius_m * radius_m) : 0;
  };
  const double whole = in_disc(DVec3(scene_->bounds.centre()), radius_m_);
  if (target_.empty()) return whole;
  double aimed = 0;
  for (const Target& t : target_) aimed += in_disc(t.centre, t.radius_m);
  return (1 - kAimed) * whole + kAimed * aimed / static_cast<double>(target_.size());
}

Vec3 LightStarts::sample_across(const Vec3& direction, RandomStream& random) const {
  Target disc{DVec3(scene_->bounds.centre()), radius_m_};
  if (!target_.empty() && random.uniform_double() < kAimed) {
    const auto n = static_cast<double>(target_.size());
    disc = target_[std::min(static_cast<std::size_t>(random.uniform_double() * n), target_.size() - 1)];
  }
  const Frame frame = make_frame(direction);
  const Vec2 u = sample_disc(random.uniform2());
  const DVec3 d(direction),
      middle = disc.centre + disc.radius_m * (static_cast<double>(u.x) * DVec3(frame.x) +
                                              static_cast<double>(u.y) * DVec3(frame.y));
  const double back = glm::dot(middle - DVec3(scene_->bounds.centre()), d) + kBeforeScene * radius_m_;
  return Vec3(middle - back * d);
}

double LightStarts::density(std::size_t i, const Vec3& place, std::uint32_t triangle, const Vec3& normal,
                            const Vec3& direction) const {
  const Light& light = (*luminaires_)[i];
  if (light.kind == Light::Kind::environment)
    return share_[i] * scene_->environment->flux_density(-direction) * across_density(place, direction);
  if (light.kind == Light::Kind::directional) return share_[i] * across_density(place, direction);
  if (light.kind == Light::Kind::area && light.fitting >= 0) {
    const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
    const double seen_m2 = static_cast<double>(fitting.projected_area_m2(direction));
    const double cosine = static_cast<double>(glm::dot(normal, direction));
    if (!(seen_m2 > 0) || !(cosine > 0)) return 0;
    return share_[i] * ratio(fitting.intensity_cd(direction), fitting.flux_lm()) * cosine / seen_m2;
  }
  const double where = light.kind == Light::Kind::area ? luminaires_->area_density(i, triangle) : 1;
  double own = 1, aimed = 0;
  if (!target_.empty()) {
    const double each = kAimed / static_cast<double>(target_.size());
    for (const Target& t : target_) {
      DVec3 towards;
      double sine;
      if (!see(t.centre, t.radius_m, place, towards, sine)) continue;
      own -= each;
      const DVec3 aside = glm::cross(towards, DVec3(direction));
      if (glm::dot(aside, aside) <= sine * sine && glm::dot(towards, DVec3(direction)) > 0)
        aimed += each / cone_sr(sine);
    }
  }
  return share_[i] * where * (own * lobe_density(i, normal, direction) + aimed);
}

bool LightStarts::start_at_infinity(const Light& light, RandomStream& random, Start& result) const {
  Rgb value = light.intensity;
  result.infinite = true;
  if (light.kind == Light::Kind::environment) {
    const Environment::Sample sample = scene_->environment->sample_flux(random.uniform2());
    if (!(sample.density > 0)) return false;
    result.extended = true;
    result.ray.direction = -sample.direction;
    value = background_luminance(*scene_, sample.direction);
  } else {
    result.ray.direction = light.direction;
  }
  result.ray.origin = sample_across(result.ray.direction, random);
  result.density = density(result.light, result.ray.origin, 0, result.ray.direction, result.ray.direction);
  if (!(result.density > 0)) return false;
  result.flux_lm = Rgb(DVec3(value) / result.density);
  return true;
}

/// First the direction, by the intensities; then a place on the part of the opening that is seen from there.
bool LightStarts::start_at_opening(const Light& light, RandomStream& random, Start& result) const {
  const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
  const Vec3 direction = fitting.sample_direction(random.uniform2());
  const float u_triangle = random.uniform();
  const EmissionPoint point =
      luminaires_->sample_seen_from(result.light, direction, u_triangle, random.uniform2());
  if (!(point.density > 0)) return false;
  result.extended = true;
  result.triangle = point.triangle;
  result.cos_lamp = glm::dot(point.normal, direction);
  result.ray = {point.position + point.error_m * point.normal, direction, 0, kInfinity};
  result.density = density(result.light, point.position, point.triangle, point.normal, direction);
  if (!(result.density > 0)) return false;
  result.flux_lm = Rgb(DVec3(point.luminance) * (static_cast<double>(result.cos_lamp) / result.density));
  return true;
}

bool LightStarts::start_near(const Light& light, RandomStream& random, Start& result) const {
  const bool area = light.kind == Light::Kind::area;
  EmissionPoint point;
  point.position = light.position;
  if (area) {
    const float u_triangle = random.uniform();
    point = luminaires_->sample_point(result.light, u_triangle, random.uniform2());
    if (!(point.density > 0)) return false;
    if (scene_->material_of(point.triangle).double_sided && random.uniform() < 0.5f)
      point.normal = -point.normal;
    result.extended = true;
    result.triangle = point.triangle;
  }
  Vec3 direction;
  if (!aim(point.position, random, direction)) direction = sample_lobe(light, point.normal, random);
  Rgb value = point.luminance;
  if (area) {
    result.cos_lamp = glm::dot(point.normal, direction);
    if (result.cos_lamp < 0 && scene_->material_of(point.triangle).double_sided)
      point.normal = -point.normal, result.cos_lamp = -result.cos_lamp;
    if (!(result.cos_lamp > 0)) return false;
    value *= result.cos_lamp;
  } else {
    value = light.intensity * intensity_share(*scene_, light, DVec3(direction));
  }
  result.ray = {area ? point.position + point.error_m * point.normal : point.position, direction, 0,
                kInfinity};
  result.density = density(result.light, point.position, point.triangle, point.normal, direction);
  if (!(result.density > 0)) return false;
  result.flux_lm = Rgb(DVec3(value) / result.density);
  return max_component(result.flux_lm) > 0;
}

bool LightStarts::start(RandomStream& random, Start& result) const {
  if (share_.empty()) return false;
  result = Start();
  result.light = choose_light(random.uniform_double());
  const Light& light = (*luminaires_)[result.light];
  if (light.kind == Light::Kind::directional || light.kind == Light::Kind::environment)
    return start_at_infinity(light, random, result);
  return light.kind == Light::Kind::area && light.fitting >= 0 ? start_at_opening(light, random, result)
                                                               : start_near(light, random, result);
}

}  // namespace phos::inline reference
