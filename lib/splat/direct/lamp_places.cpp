#include "splat/direct/lamp_places.h"

#include <algorithm>
#include <cmath>

#include "scene/luminaire/photometry.h"
#include "scene/sky/environment.h"

namespace phos::inline splat {
namespace {

/// The k-th of `count` points that fill the cube evenly: steps of 1/count, and of two numbers that multiples
/// of each other never come near to (golden ratio; Roberts 2018).
Vec3 even_point(int k, int count) {
  const double y = 0.5 + 0.6180339887498949 * k, z = 0.5 + 0.7548776662466927 * k;
  return Vec3((k + 0.5) / count, y - std::floor(y), z - std::floor(z));
}

bool is_solid(const Scene& scene, const Light& light) {
  return light.kind == Light::Kind::area && !scene.fitting[static_cast<std::size_t>(light.fitting)].flat();
}

std::optional<LampPlace> area_sample(const Scene& scene, const Luminaires& luminaires, std::size_t i, int k,
                                     int count) {
  const Vec3 u = even_point(k, count);
  const EmissionPoint point = luminaires.sample_point(i, u.z, Vec2(u));
  LampPlace sample;
  sample.shape = PlaceShape::area;
  sample.forward = point.normal;
  sample.two_sided = scene.material_of(point.triangle).double_sided;
  const double per_sample = static_cast<double>(point.density) * count;
  if (!(per_sample > 0) || max_component(point.luminance) <= 0) return std::nullopt;
  sample.colour = Rgb(glm::dvec3(point.luminance) / per_sample);
  sample.position = sample.two_sided ? point.position : point.position + point.error_m * point.normal;
  sample.instance = scene.light[i].instance;
  return sample;
}

/// A luminaire's light from the k-th of `count` places on its opening; from a point there is one.
std::optional<LampPlace> luminaire_sample(const Scene& scene, const Luminaires& luminaires, std::size_t i,
                                          int k, int count, const ShareMap& map) {
  const Light& light = scene.light[i];
  const Fitting& fitting = scene.fitting[static_cast<std::size_t>(light.fitting)];
  LampPlace sample;
  sample.shape = PlaceShape::map;
  sample.colour = Rgb(DVec3(fitting.peak_cd()) * static_cast<double>(map.greatest));
  sample.position = light.position;
  if (light.kind == Light::Kind::area) {
    const Vec3 u = even_point(k, count);
    const EmissionPoint point = luminaires.sample_point(i, u.z, Vec2(u));
    if (!(point.density > 0)) return std::nullopt;
    const bool solid = is_solid(scene, light);
    if (solid) sample.shape = PlaceShape::area_map;
    sample.forward = point.normal;
    sample.colour = Rgb(DVec3(sample.colour) / (count * (solid ? static_cast<double>(point.density) : 1.0)));
    const bool two_sided = scene.material_of(point.triangle).double_sided;
    sample.position = two_sided ? point.position : point.position + point.error_m * point.normal;
    sample.instance = light.instance;
  }
  return sample;
}

LampPlace punctual_sample(const Light& light) {
  LampPlace sample;
  sample.colour = light.intensity;
  sample.position = light.position;
  if (light.kind == Light::Kind::directional) sample.shape = PlaceShape::directional;
  if (light.kind == Light::Kind::spot) {
    sample.shape = PlaceShape::spot;
    sample.cos_outer = light.cos_outer, sample.cos_inner = light.cos_inner;
  }
  if (sample.shape != PlaceShape::point) sample.forward = light.direction;
  return sample;
}

/// The environment's light from the k-th of `count` directions.
std::optional<LampPlace> environment_sample(const Scene& scene, int k, int count) {
  const Environment::Sample part = scene.environment->sample(Vec2(even_point(k, count)));
  if (!(part.density > 0)) return std::nullopt;
  LampPlace sample;
  sample.shape = PlaceShape::directional;
  sample.forward = -part.direction;
  sample.colour = part.luminance / (part.density * static_cast<float>(count));
  return sample;
}

}  // namespace

/// Of a solid opening, its luminance; of a flat one or a point, the intensity.
ShareMap share_map(const Scene& scene, const Light& light) {
  const Fitting& fitting = scene.fitting[static_cast<std::size_t>(light.fitting)];
  const bool solid = is_solid(scene, light);
  ShareMap map;
  map.axes = glm::transpose(fitting.axes());
  for (int y = 0; y < ShareMap::kHeight; ++y) {
    for (int x = 0; x < ShareMap::kWidth; ++x) {
      const Vec3 d = fitting.axes() * c_gamma_direction(x, y);
      const float area_m2 = solid ? fitting.projected_area_m2(d) : 1.f;
      map.share.push_back(area_m2 > 0 ? fitting.share(d) / area_m2 : 0.f);
    }
  }
  map.greatest = *std::max_element(map.share.begin(), map.share.end());
  for (float& v : map.share) v = map.greatest > 0 ? v / map.greatest : 0.f;
  return map;
}

int place_count(const Light& light, int samples) { return light.extended() ? samples : 1; }

std::optional<LampPlace> lamp_place(const Scene& scene, const Luminaires& luminaires, std::size_t i, int k,
                                    int count, const ShareMap& map) {
  const Light& light = scene.light[i];
  if (light.fitting >= 0) return luminaire_sample(scene, luminaires, i, k, count, map);
  if (light.kind == Light::Kind::area) return area_sample(scene, luminaires, i, k, count);
  if (light.kind == Light::Kind::environment) return environment_sample(scene, k, count);
  return punctual_sample(light);
}

}  // namespace phos::inline splat
