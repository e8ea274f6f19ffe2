#include "scene/mirror/image_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/lamp/extent.h"
#include "scene/mirror/images.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

/// Images of so many are kept.
constexpr std::size_t kMostKept = 65536;
/// By so much the cosine of an angle between balls may be off: rounding leaves no image out.
constexpr float kSlack = 1e-4f;

/// Sine of half the angle under which a ball is seen from outside; 1 from within.
float seen_sine(float radius_m, float distance_m) {
  return radius_m < distance_m ? radius_m / distance_m : 1.f;
}

float cosine_of(float sine) { return std::sqrt(std::max(0.f, 1 - sine * sine)); }

}  // namespace

ImageBounds::ImageBounds(const Scene& scene, const MirrorPlanes& mirrors) {
  if (mirrors.empty()) return;
  for (const Light& light : scene.light) lamp_.push_back(lamp_of(scene, light));
  const std::size_t chains = mirrors.chains().size();
  if (chains * lamp_.size() > kMostKept) return;
  std::vector<Vec3> kept;
  for (std::size_t chain = 0; chain < chains; ++chain)
    for (std::size_t i = 0; i < lamp_.size(); ++i) kept.push_back(image_of(mirrors, chain, i));
  image_ = std::move(kept);
}

Vec3 ImageBounds::image_of(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light) const {
  if (!image_.empty()) return image_[chain * lamp_.size() + light];
  const Lamp& lamp = lamp_[light];
  const auto index = static_cast<std::int32_t>(chain);
  return lamp.far ? mirrors.image_of_direction(index, lamp.centre)
                  : mirrors.image_of_lamp(index, lamp.centre);
}

ImageBounds::Lamp ImageBounds::lamp_of(const Scene& scene, const Light& light) {
  Lamp lamp;
  lamp.has_images = has_images(scene, light);
  if (!lamp.has_images) return lamp;
  lamp.centre = light.position;
  switch (light.kind) {
    case Light::Kind::area: {
      const LampExtent extent = extent_of(scene, light);
      lamp.centre = extent.centre, lamp.radius_m = extent.radius_m;
      lamp.strength = luminance(light.flux_lm) / kPi;
      break;
    }
    case Light::Kind::environment: {
      const Environment::Sun& sun = *scene.environment->sun();
      lamp.far = true, lamp.centre = Vec3(sun.towards);
      lamp.sine = static_cast<float>(std::sin(std::min(sun.radius_rad, 0.5 * std::numbers::pi)));
      lamp.strength = luminance(sun.illuminance_lx);
      break;
    }
    case Light::Kind::directional:
      lamp.far = true, lamp.centre = -light.direction;
      lamp.strength = luminance(light.intensity);
      break;
    case Light::Kind::point:
    case Light::Kind::spot:
    case Light::Kind::measured:
      lamp.strength = luminance(light.intensity);
      break;
  }
  return lamp;
}

std::optional<ImageBounds::Sight> ImageBounds::sight(const MirrorPlanes::Plane& mirror, bool front,
                                                     const SurfacePoint& point) {
  if (mirror.front_of(point.position) != front) return {};
  Sight sight;
  sight.way = mirror.box.centre() - point.position;
  sight.radius_m = 0.5f * mirror.box.diagonal_m() + 2 * mirror.slack_m;
  if (glm::dot(sight.way, point.geometric_normal) < -sight.radius_m ||
      glm::dot(sight.way, point.normal) < -sight.radius_m)
    return {};
  sight.distance_m = glm::length(sight.way);
  sight.sine = seen_sine(sight.radius_m, sight.distance_m);
  return sight;
}

float ImageBounds::promise_lx(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light,
                              const SurfacePoint& point) const {
  const MirrorPlanes::Chain& last = mirrors.chains()[chain];
  const std::optional<Sight> mirror = sight(mirrors.plane(last.plane), last.front, point);
  return mirror ? promise_lx(mirrors, chain, light, *mirror, point) : 0;
}

float ImageBounds::promise_lx(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light,
                              const Sight& mirror, const SurfacePoint& point) const {
  const Lamp& lamp = lamp_[light];
  if (!lamp.has_images) return 0;
  Vec3 to_lamp = image_of(mirrors, chain, light);
  float sine = lamp.sine, distance_m = 1, lx = lamp.strength * mirrors.chains()[chain].reflectance;
  if (!lamp.far) {
    to_lamp -= point.position;
    distance_m = glm::length(to_lamp);
    if (distance_m + lamp.radius_m < (1 - kSlack) * (mirror.distance_m - mirror.radius_m)) return 0;
    sine = seen_sine(lamp.radius_m, distance_m);
    lx /= std::max(distance_m * distance_m + lamp.radius_m * lamp.radius_m, 1e-30f);
  }
  if (mirror.sine < 1 && sine < 1) {
    const float apart = glm::dot(mirror.way, to_lamp) / (mirror.distance_m * distance_m);
    const float touching = cosine_of(mirror.sine) * cosine_of(sine) - mirror.sine * sine;
    if (apart < touching - kSlack) return 0;
  }
  const float part = mirror.sine < sine ? mirror.sine / sine : 1.f;
  return std::max(lx * part * part, 1e-30f);
}

}  // namespace phos::inline scene
