#include "cache/lamp_choice.h"

#include <algorithm>

namespace phos {
namespace {

// By power no lamp falls below this part of an equal share, so that one close by is not starved.
constexpr double kMinimumShare = 0.1;
constexpr float kBelowOne = 0x1.fffffep-1f;

}  // namespace

LampChoice::LampChoice(const Scene& scene, const Luminaires& lights) {
  if (lights.size() == 0) return;
  double sum = 0;
  for (const double share : lights.power_shares(kMinimumShare)) {
    share_.push_back(static_cast<float>(share));
    cdf_.push_back(sum += share);
  }
  if (lights.size() == 1 || lights.size() > kMostCompared) return;
  for (std::size_t i = 0; i < lights.size(); ++i) lamp_.push_back(lamp_of(scene, lights[i]));
}

LampChoice::Lamp LampChoice::lamp_of(const Scene& scene, const Light& light) {
  Lamp lamp;
  lamp.kind = light.kind;
  lamp.centre = light.position, lamp.front = light.direction;
  lamp.strength = luminance(light.intensity);
  if (light.kind == Light::Kind::point) lamp.front = Vec3(0);
  if (light.kind == Light::Kind::spot) lamp.spot = light;
  if (light.kind != Light::Kind::area) return lamp;
  const Instance& instance = scene.instance[light.instance];
  const std::uint32_t end = instance.first_triangle + instance.triangle_count;
  Bounds bounds;
  for (std::uint32_t t = instance.first_triangle; t < end; ++t)
    for (const std::uint32_t v : scene.triangle[t].v) bounds.include(scene.position[v]);
  lamp.centre = bounds.centre();
  lamp.radius_m = 0.501f * bounds.diagonal_m();
  lamp.front = geometric_normal(scene, instance.first_triangle);
  bool plane = !scene.material[instance.material].double_sided;
  for (std::uint32_t t = instance.first_triangle; t < end && plane; ++t) {
    plane = glm::dot(geometric_normal(scene, t), lamp.front) > 0.999f;
    for (const std::uint32_t v : scene.triangle[t].v) {
      const float off = std::fabs(glm::dot(scene.position[v] - lamp.centre, lamp.front));
      plane = plane && off < 1e-4f * lamp.radius_m;
    }
  }
  if (!plane) lamp.front = Vec3(0);
  lamp.strength = luminance(light.flux_lm) / (plane ? kPi : 4 * kPi);
  return lamp;
}

/// Illuminance at the point from a lamp that nothing hides, roughly for an area light; 0 only where it brings
/// none.
float LampChoice::promise_lx(const Lamp& lamp, const SurfacePoint& point) {
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
  const float cone =
      lamp.kind == Light::Kind::spot ? spot_falloff(lamp.spot, -glm::dot(way, lamp.front) / d) : 1.f;
  return lamp.strength * cone * height / (d * d2);
}

float LampChoice::promises(const SurfacePoint& point, Promises& each) const {
  float sum = 0;
  for (std::size_t i = 0; i < lamp_.size(); ++i) sum += each[i] = promise_lx(lamp_[i], point);
  return sum;
}

LampChoice::Choice LampChoice::choose(const SurfacePoint& point, float u) const {
  if (share_.size() == 1) return {0, 1, u};
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

float LampChoice::probability(const SurfacePoint& point, std::size_t light) const {
  if (share_.size() == 1) return 1;
  Promises each;
  const float sum = promises(point, each);
  return sum > 0 && std::isfinite(sum) ? each[light] / sum : share_[light];
}

}  // namespace phos
