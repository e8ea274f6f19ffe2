#include "direct/lamp_sampler.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/lamp/extent.h"
#include "scene/material/passage.h"
#include "scene/offset.h"
#include "scene/sky/environment.h"

namespace phos::inline direct {
namespace {

// By power no lamp falls below this part of an equal share, so that one close by is not starved.
constexpr double kMinimumShare = 0.1;
constexpr long kMostSamples = 4;
/// Where both have light, the hierarchy of lamps and the far ones have no smaller part than this: the promise
/// of the hierarchy is rough.
constexpr double kLeastOfEither = 0.2;
/// An area light is near from this distance to its centre on, in radii of the sphere about it.
constexpr float kNear = 1.5f;
/// Share of rays near a lamp; and where there are too many lamps to tell.
constexpr float kRaysNear = 0.5f, kRaysAmongMany = 0.125f;

}  // namespace

LampSampler::LampSampler(const RayScene& rays, const Luminaires& lights) : rays_(rays), lights_(lights) {
  if (lights.size() == 0) return;
  double sum = 0, entropy = 0;
  for (const double share : lights.power_shares(kMinimumShare)) {
    share_.push_back(static_cast<float>(share));
    cdf_.push_back(sum += share);
    if (share > 0) entropy -= share * std::log(share);
  }
  samples_ = static_cast<std::uint32_t>(std::clamp(std::lround(std::exp(entropy)), 1l, kMostSamples));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    area_ = area_ || lights[i].kind == Light::Kind::area;
    panel_.emplace_back(rays.scene(), lights[i]);
  }
  if (lights.size() > kMostCompared) {
    tree_.emplace(rays.scene(), lights);
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (!LightTree::holds(lights[i]))
        far_.push_back(i), far_lamp_.push_back(lamp_of(rays.scene(), lights[i]));
    return;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) lamp_.push_back(lamp_of(rays.scene(), lights[i]));
}

LampSampler::Lamp LampSampler::lamp_of(const Scene& scene, const Light& light) {
  Lamp lamp;
  lamp.kind = light.kind;
  lamp.centre = light.position, lamp.front = light.direction;
  lamp.strength = luminance(light.intensity);
  if (light.kind == Light::Kind::point) lamp.front = Vec3(0);
  const bool beam = light.kind == Light::Kind::spot || light.kind == Light::Kind::measured;
  if (beam) lamp.beam = light;
  if (light.kind != Light::Kind::area) return lamp;
  const LampExtent extent = extent_of(scene, light);
  lamp.centre = extent.centre, lamp.radius_m = extent.radius_m, lamp.front = extent.front;
  lamp.strength = luminance(light.flux_lm) / (lamp.front != Vec3(0) ? kPi : 4 * kPi);
  return lamp;
}

/// Illuminance at the point from a lamp that nothing hides, roughly for an area light; 0 only where it brings
/// none.
float LampSampler::promise_lx(const Lamp& lamp, const SurfacePoint& point) const {
  if (lamp.kind == Light::Kind::environment) return lights_.promise_beyond_lx(point.position);
  if (lamp.kind == Light::Kind::directional) {
    const bool above = glm::dot(lamp.front, point.geometric_normal) < 0;
    return above ? std::max(0.f, -glm::dot(lamp.front, point.normal)) * lamp.strength : 0.f;
  }
  const Vec3 way = lamp.centre - point.position;
  const float height = glm::dot(way, point.normal), r = lamp.radius_m;
  if (!(height > -r) || !(glm::dot(way, point.geometric_normal) > -r)) return 0;
  const float d2 = glm::dot(way, way), d = std::sqrt(d2);
  if (lamp.kind == Light::Kind::area) {
    float facing = 1;
    if (lamp.front != Vec3(0)) {
      const float before = -glm::dot(way, lamp.front);
      if (before < -1e-3f * r) return 0;
      facing = (std::max(before, 0.f) + 0.05f * r) / (d + r);
    }
    return lamp.strength * facing * (height + r) / ((d + r) * (d2 + r * r));
  }
  return lamp.strength * intensity_share(rays_.scene(), lamp.beam, -DVec3(way)) * height / (d * d2);
}

float LampSampler::promises(const SurfacePoint& point, Promises& each) const {
  float sum = 0;
  for (std::size_t i = 0; i < lamp_.size(); ++i) sum += each[i] = promise_lx(lamp_[i], point);
  return sum;
}

LampSampler::Choice LampSampler::choose(const SurfacePoint& point, float u) const {
  if (share_.size() == 1) return {0, 1, u};
  if (tree_) return choose_of_many(point, u);
  Promises each;
  const float sum = promises(point, each);
  if (sum > 0 && std::isfinite(sum)) {
    float beyond = u * sum;
    std::size_t i = 0, last = 0;
    for (; i < lamp_.size(); ++i) {
      if (!(each[i] > 0)) continue;
      last = i;
      if (beyond < each[i]) break;
      beyond -= each[i];
    }
    const float rest = i < lamp_.size() ? beyond / each[last] : kBelowOne;  // the sum's rounding
    return {last, each[last] / sum, std::min(rest, kBelowOne)};
  }
  const double x = static_cast<double>(u) * cdf_.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(cdf_.begin(), cdf_.end() - 1, x) - cdf_.begin());
  const double below = i > 0 ? cdf_[i - 1] : 0;
  const auto rest = static_cast<float>((x - below) / (cdf_[i] - below));
  return {i, share_[i], std::clamp(rest, 0.f, kBelowOne)};
}

float LampSampler::probability(const SurfacePoint& point, std::size_t light) const {
  if (share_.size() == 1) return 1;
  if (tree_) return probability_of_many(point, light);
  Promises each;
  const float sum = promises(point, each);
  return sum > 0 && std::isfinite(sum) ? each[light] / sum : share_[light];
}

double LampSampler::tree_share(const SurfacePoint& point, std::vector<double>& far_lx) const {
  double far = 0;
  far_lx.clear();
  for (const Lamp& lamp : far_lamp_) {
    const double lx = static_cast<double>(promise_lx(lamp, point));
    far_lx.push_back(std::isfinite(lx) ? std::max(lx, 0.0) : 0), far += far_lx.back();
  }
  if (tree_->empty()) return 0;
  const double near = tree_->importance_lx(LightTree::root(), point);
  if (!(far > 0)) return 1;
  if (!(near > 0)) return 0;
  return std::isfinite(near) ? std::clamp(near / (near + far), kLeastOfEither, 1 - kLeastOfEither)
                             : 1 - kLeastOfEither;
}

LampSampler::Choice LampSampler::choose_of_many(const SurfacePoint& point, float u) const {
  std::vector<double> far_lx;
  const double tree = tree_share(point, far_lx);
  const double x = static_cast<double>(u);
  if (x < tree) {
    const LightTree::Choice choice = tree_->choose(LightTree::root(), point, x / tree);
    return {choice.light, static_cast<float>(tree * choice.probability),
            std::min(static_cast<float>(choice.rest), kBelowOne)};
  }
  double sum = 0;
  for (const double lx : far_lx) sum += lx;
  double beyond = (x - tree) / (1 - tree) * sum;
  std::size_t k = 0, last = 0;
  for (; k < far_.size(); ++k) {
    if (!(far_lx[k] > 0)) continue;
    last = k;
    if (beyond < far_lx[k]) break;
    beyond -= far_lx[k];
  }
  if (!(sum > 0)) return {far_[0], static_cast<float>((1 - tree)), static_cast<float>(x)};  // none lights it
  const auto rest = k < far_.size() ? static_cast<float>(beyond / far_lx[last]) : kBelowOne;
  return {far_[last], static_cast<float>((1 - tree) * far_lx[last] / sum), std::min(rest, kBelowOne)};
}

float LampSampler::probability_of_many(const SurfacePoint& point, std::size_t light) const {
  std::vector<double> far_lx;
  const double tree = tree_share(point, far_lx);
  if (LightTree::holds(lights_[light])) return static_cast<float>(tree * tree_->probability(point, light));
  double sum = 0, own = 0;
  for (std::size_t k = 0; k < far_.size(); ++k) sum += far_lx[k], own += far_[k] == light ? far_lx[k] : 0;
  if (!(sum > 0)) return far_[0] == light ? static_cast<float>(1 - tree) : 0.f;
  return static_cast<float>((1 - tree) * own / sum);
}

/// Close to an area light, points on it are a poor choice: their density per sr varies without bound. (Of an
/// environment its own samples are the better ones even where its brightest part is hidden.)
float LampSampler::ray_share(const SurfacePoint& point) const {
  if (!area_) return 0;
  if (lamp_.empty()) return kRaysAmongMany;
  for (const Lamp& lamp : lamp_) {
    const Vec3 way = lamp.centre - point.position;
    const float reach = kNear * lamp.radius_m;
    if (glm::dot(way, way) < reach * reach && promise_lx(lamp, point) > 0) return kRaysNear;
  }
  return 0;
}

void LampSampler::by_ray(const SurfacePoint& point, const Vec2& u, float ray_share,
                         ArrivingLight& light) const {
  const Vec3 local = sample_cosine_hemisphere(u);
  const Vec3 direction = make_frame(point.normal).to_world(local);
  if (!(local.z > 0) || !(glm::dot(direction, point.geometric_normal) > 0)) return;
  SurfacePoint found;
  Rgb share(1);
  const bool hit = trace_straight(rays_, {point.leave(direction), direction}, found, share);
  const Rgb luminance = hit ? emitted_luminance(rays_.scene(), found, -direction)
                            : background_luminance(rays_.scene(), direction);
  if (!(max_component(luminance) > 0)) return;
  const std::int32_t lamp = hit ? lights_.light_of(found.triangle) : lights_.environment();
  if (lamp < 0) return;
  const auto i = static_cast<std::size_t>(lamp);
  const float cos_light = std::fabs(glm::dot(found.geometric_normal, direction));
  const float by_lamp = probability(point, i) *
                        (hit ? lights_.density(i, point.position, found.triangle, found.distance_m, cos_light)
                             : lights_.density_beyond(point.position, direction));
  light.lux = share * luminance * (local.z / (ray_share * local.z / kPi + (1 - ray_share) * by_lamp));
  light.certain = true;
}

void LampSampler::sample(const SurfacePoint& point, const std::array<float, 3>& u,
                         ArrivingLight& light) const {
  light.lux = Rgb(0);
  if (lights_.size() == 0) return;
  const float rays = ray_share(point);
  if (u[0] < rays) return by_ray(point, {u[1], u[2]}, rays, light);
  const Choice lamp = choose(point, std::min((u[0] - rays) / (1 - rays), kBelowOne));
  if (const LampPanel& panel = panel_[lamp.light]; rays == 0 && !panel.empty()) {
    const LampPanel::Way way = panel.way(point, lamp.rest, {u[1], u[2]});
    if (!(way.weight_sr > 0) || !way.above) return;
    light.lux = panel.luminance() * (way.weight_sr / lamp.probability);
    light.ray = way.ray, light.certain = !(way.ray.t_max_m > 0);
    return;
  }
  Illumination arriving;
  if (!lights_.illuminate(lamp.light, point.position, lamp.rest, {u[1], u[2]}, arriving)) return;
  const float cosine = glm::dot(point.normal, arriving.direction);
  if (!(cosine > 0) || !(glm::dot(point.geometric_normal, arriving.direction) > 0)) return;
  float density = (1 - rays) * lamp.probability;
  if (arriving.density > 0) density = density * arriving.density + rays * cosine / kPi;
  light.lux = arriving.value * (cosine / density);
  light.ray = shadow_ray(point, arriving);
  light.certain = !(light.ray.t_max_m > 0);
}

}  // namespace phos::inline direct
