#include "scene/lamp/luminaires.h"

#include <algorithm>

#include "core/error.h"
#include "core/sampling.h"
#include "scene/lamp/near.h"
#include "scene/offset.h"
#include "scene/shading_frame.h"
#include "scene/sky/environment.h"
#include "scene/texture/texture.h"
#include "scene/texture/visible_share.h"

namespace phos::inline scene {

Rgb emitted_luminance(const Scene& scene, const SurfacePoint& point, const Vec3& towards) {
  const Material& material = scene.material[point.material];
  if (!material.emits() || !(point.front || material.double_sided)) return Rgb(0);
  if (const std::int32_t f = scene.instance[point.instance].fitting; f >= 0)
    return scene.fitting[static_cast<std::size_t>(f)].luminance(towards);
  return visible_share(scene, point) * material.emission *
         Rgb(look_up(scene, material.emissive, point.uv0, point.uv1));
}

bool shines_evenly(const Scene& scene, const Instance& instance) {
  const Material& material = scene.material[instance.material];
  return instance.fitting < 0 && !material.emissive.used() && material.alpha_mode == Material::Alpha::opaque;
}

Ray shadow_ray(const SurfacePoint& point, const Illumination& light) {
  if (std::isfinite(light.distance_m)) return ray_between(point, light.position, light.error_m);
  return {point.leave(light.direction), light.direction};
}

Rgb arriving_share(const RayScene& rays, const Ray& shadow_ray) {
  return shadow_ray.t_max_m > 0 ? rays.transmittance(shadow_ray) : Rgb(1);
}

Rgb arriving_share(const RayScene& rays, const SurfacePoint& from, const Illumination& light) {
  return arriving_share(rays, shadow_ray(from, light));
}

Rgb background_luminance(const Scene& scene, const Vec3& direction) {
  return scene.environment ? scene.environment->luminance(direction) : Rgb(0);
}

float spot_falloff(const Light& light, double cos_angle) {
  if (cos_angle >= light.cos_inner) return 1;
  if (cos_angle <= light.cos_outer) return 0;
  const double t = (cos_angle - light.cos_outer) / (light.cos_inner - light.cos_outer);
  return static_cast<float>(t * t);
}

float spot_falloff(const Light& light, const DVec3& way) {
  // 1 - cos from the chord, which keeps the digits of small angles.
  const DVec3 chord = glm::normalize(way) - glm::normalize(DVec3(light.direction));
  return spot_falloff(light, 1 - 0.5 * glm::dot(chord, chord));
}

float intensity_share(const Scene& scene, const Light& light, const DVec3& way) {
  if (light.kind == Light::Kind::spot) return spot_falloff(light, way);
  if (light.kind != Light::Kind::measured) return 1;
  return scene.fitting[static_cast<std::size_t>(light.fitting)].share(Vec3(glm::normalize(way)));
}

namespace {

/// In double: the point then lies on the plane to within the rounding of its coordinates.
Vec3 point_at(const Vec3 corner[3], const Vec2& weights) {
  const auto u = static_cast<double>(weights.x), v = static_cast<double>(weights.y);
  return Vec3((1 - u - v) * glm::dvec3(corner[0]) + u * glm::dvec3(corner[1]) + v * glm::dvec3(corner[2]));
}

struct Corners {
  Vec3 p[3];
  float error_m() const { return offset_m(p[0], p[1], p[2]); }
  Vec3 normal() const { return normal_of(p[0], p[1], p[2]); }
  double area_m2() const {
    return 0.5 *
           glm::length(glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0])));
  }
};

Corners corners_of(const Scene& scene, std::uint32_t triangle) {
  const auto& v = scene.triangle[triangle].v;
  return {{scene.position[v[0]], scene.position[v[1]], scene.position[v[2]]}};
}

/// Square of the distance from the middle of a triangle, or of the whole of which it is a part, within which
/// it is near.
float near2_m2(const Vec3 corner[3], const Vec3& middle) {
  float radius_m = 0;
  for (int i = 0; i < 3; ++i) radius_m = std::max(radius_m, glm::length(corner[i] - middle));
  return kNearRadii * radius_m * (kNearRadii * radius_m);
}

/// Mean luminance of a triangle's emission, from 16 of its points.
double mean_emission(const Scene& scene, std::uint32_t triangle) {
  constexpr int kSide = 4;
  const Material& material = scene.material_of(triangle);
  if (!material.emissive.used() && material.alpha_mode == Material::Alpha::opaque)
    return luminance(material.emission);
  double sum = 0;
  for (int k = 0; k < kSide * kSide; ++k) {
    const Vec2 u((static_cast<float>(k % kSide) + 0.5f) / kSide,
                 (static_cast<float>(k / kSide) + 0.5f) / kSide);
    const Vec2 weights = sample_triangle(u);
    sum += luminance(emission_at(scene, triangle, weights.x, weights.y));
  }
  return sum / (kSide * kSide);
}

}  // namespace

Luminaires::Luminaires(const Scene& scene) : scene_(&scene), mirrors_(scene), image_bounds_(scene, mirrors_) {
  if (scene.environment && !scene.portal.empty())
    portals_.emplace(*scene.environment, scene.portal, scene.portal_sight, scene.blind);
  instance_light_.assign(scene.instance.size(), -1);
  shape_.resize(scene.light.size());
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const Light& light = scene.light[i];
    if (light.kind == Light::Kind::environment) environment_ = static_cast<std::int32_t>(i);
    if (light.kind != Light::Kind::area) continue;
    instance_light_[light.instance] = static_cast<std::int32_t>(i);
    shape_[i] = make_shape(light);
  }
}

Luminaires::Shape Luminaires::make_shape(const Light& light) const {
  const Instance& instance = scene_->instance[light.instance];
  const std::size_t n = instance.triangle_count;
  std::vector<double> area(n), mean(n);
  double power = 0, total_area = 0;
  const Fitting* fitting =
      light.fitting < 0 ? nullptr : &scene_->fitting[static_cast<std::size_t>(light.fitting)];
  for (std::size_t k = 0; k < n; ++k) {
    const auto triangle = static_cast<std::uint32_t>(instance.first_triangle + k);
    area[k] = corners_of(*scene_, triangle).area_m2();
    mean[k] = fitting ? fitting->facets()[k].lm_per_m2 : mean_emission(*scene_, triangle);
    power += area[k] * mean[k], total_area += area[k];
  }
  // A triangle whose probed texels are all dark may still shine somewhere: it keeps a tenth of the mean. Not
  // one of an opening, of which it is known.
  const double least = !fitting && total_area > 0 ? 0.1 * power / total_area : 0;
  Shape shape;
  shape.cdf.resize(n), shape.facet.resize(n);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += area[k] * (power > 0 ? std::max(mean[k], least) : 1.0);
    shape.cdf[k] = sum;
  }
  for (std::size_t k = 0; k < n; ++k) {
    shape.cdf[k] = sum > 0 ? shape.cdf[k] / sum : static_cast<double>(k + 1) / static_cast<double>(n);
    const double share = shape.cdf[k] - (k > 0 ? shape.cdf[k - 1] : 0);
    const Corners c = corners_of(*scene_, static_cast<std::uint32_t>(instance.first_triangle + k));
    shape.facet[k] = {{c.p[0], c.p[1], c.p[2]},
                      c.normal(),
                      c.error_m(),
                      area[k] > 0 ? static_cast<float>(share / area[k]) : 0.f,
                      static_cast<float>(share),
                      point_at(c.p, Vec2(1.f / 3)),
                      near2_m2(c.p, point_at(c.p, Vec2(1.f / 3)))};
  }
  if (n == 2 && std::fabs(shape.cdf[0] - 0.5) < 1e-6) find_parallelogram(instance, shape);
  return shape;
}

void Luminaires::find_parallelogram(const Instance& instance, Shape& shape) const {
  const Corners t[2] = {corners_of(*scene_, instance.first_triangle),
                        corners_of(*scene_, instance.first_triangle + 1)};
  for (unsigned a = 0; a < 3; ++a) {
    for (unsigned b = 0; b < 3; ++b) {
      const Vec3 &p = t[0].p[(a + 1) % 3], &q = t[0].p[(a + 2) % 3];
      // The common edge runs the other way round in the second triangle.
      if (p != t[1].p[(b + 2) % 3] || q != t[1].p[(b + 1) % 3]) continue;
      const Vec3 gap = (p - t[0].p[a]) - (t[1].p[b] - q);
      const float size = glm::length(p - q) + t[0].error_m();
      if (glm::length(gap) > 1e-5f * size) continue;
      shape.parallelogram = true;
      shape.corner[0] = static_cast<std::uint8_t>(a), shape.corner[1] = static_cast<std::uint8_t>(b);
      const Vec3 middle = 0.5f * (p + q);
      const float near2 = near2_m2(t[0].p, middle);
      for (Facet& facet : shape.facet) facet.middle = middle, facet.near2_m2 = near2;
    }
  }
}

std::size_t Luminaires::choose_facet(const Shape& shape, float u_triangle) {
  const auto it = std::upper_bound(shape.cdf.begin(), shape.cdf.end(), static_cast<double>(u_triangle));
  return std::min(static_cast<std::size_t>(it - shape.cdf.begin()), shape.cdf.size() - 1);
}

/// Uniform over a facet, or over the parallelogram.
Luminaires::Spot Luminaires::choose(const Shape& shape, float u_triangle, const Vec2& u) {
  if (!shape.parallelogram)
    return {static_cast<std::uint32_t>(choose_facet(shape, u_triangle)), sample_triangle(u)};
  // Across the square: one triangle below its diagonal, the other above it, turned by half a turn.
  const bool second = u.x + u.y > 1;
  const float xs[2] = {u.x, 1 - u.x}, ys[2] = {u.y, 1 - u.y};
  const float x = xs[second], y = ys[second];
  // Of the corners after the opposite one, and so on round.
  const float weight[] = {x, y, 1 - x - y, x, y};
  const unsigned corner = shape.corner[second];
  return {second, {weight[3 - corner], weight[4 - corner]}};
}

/// Uniform over the solid angle of near parts.
Luminaires::Spot Luminaires::choose(const Shape& shape, std::size_t facet, const Near& near, const Vec2& u) {
  const auto [second, weights] = near.patch.sample(u);
  if (!shape.parallelogram) return {static_cast<std::uint32_t>(facet), weights};
  // As see_near() takes the corners: {opposite, p, q} and {q, p, opposite}.
  float of_corner[3];
  const unsigned corner = shape.corner[second];
  const float rest = 1 - weights.x - weights.y;
  of_corner[corner] = second ? weights.y : rest;
  of_corner[(corner + (second ? 2 : 1)) % 3] = weights.x;
  of_corner[(corner + (second ? 1 : 2)) % 3] = second ? rest : weights.y;
  return {second, {of_corner[1], of_corner[2]}};
}

std::optional<Luminaires::Near> Luminaires::see_near(const Shape& shape, std::size_t k, const Vec3& from) {
  const Facet& facet = shape.facet[k];
  const Vec3 way = facet.middle - from;
  if (!(glm::dot(way, way) < facet.near2_m2)) return {};
  if (!shape.parallelogram) {
    const SphericalPatch patch(facet.corner, from);
    if (!(patch.solid_angle_sr() > kLeastNear_sr)) return {};
    return Near{patch, static_cast<double>(facet.share) / patch.solid_angle_sr()};
  }
  const unsigned a = shape.corner[0], b = shape.corner[1];
  const Vec3 *p = shape.facet[0].corner, *q = shape.facet[1].corner;
  const Vec3 one[] = {p[a], p[(a + 1) % 3], p[(a + 2) % 3]};
  const SphericalPatch patch(one, q[b], from);
  if (!(patch.solid_angle_sr() > kLeastNear_sr)) return {};
  return Near{patch, 1 / patch.solid_angle_sr()};
}

EmissionPoint Luminaires::point_of(const Light& light, const Shape& shape, const Spot& spot) const {
  const Facet& facet = shape.facet[spot.triangle];
  EmissionPoint point;
  point.position = point_at(facet.corner, spot.weights);
  point.normal = facet.normal;
  point.error_m = facet.error_m;
  point.triangle = scene_->instance[light.instance].first_triangle + spot.triangle;
  point.luminance = emission_at(*scene_, point.triangle, spot.weights.x, spot.weights.y);
  point.density = facet.density_per_m2;
  return point;
}

EmissionPoint Luminaires::sample_point(std::size_t i, float u_triangle, const Vec2& u) const {
  const Light& light = scene_->light[i];
  const Shape& shape = shape_[i];
  PHOS_CHECK(light.kind == Light::Kind::area && !shape.cdf.empty(), "light ", i, " has no area");
  return point_of(light, shape, choose(shape, u_triangle, u));
}

EmissionPoint Luminaires::sample_seen_from(std::size_t i, const Vec3& direction, float u_triangle,
                                           const Vec2& u) const {
  const Light& light = scene_->light[i];
  PHOS_CHECK(light.kind == Light::Kind::area && light.fitting >= 0, "light ", i, " has no opening");
  const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
  const std::size_t k = fitting.seen_facet(direction, u_triangle);
  const Facet& facet = shape_[i].facet[k];
  const float cosine = glm::dot(facet.normal, direction), seen_m2 = fitting.projected_area_m2(direction);
  EmissionPoint point;
  point.triangle = scene_->instance[light.instance].first_triangle + static_cast<std::uint32_t>(k);
  point.position = point_at(facet.corner, sample_triangle(u));
  point.normal = cosine < 0 ? -facet.normal : facet.normal;
  point.error_m = facet.error_m;
  const bool seen = cosine > 0 || (cosine < 0 && scene_->material_of(point.triangle).double_sided);
  point.density = seen && seen_m2 > 0 ? std::fabs(cosine) / seen_m2 : 0.f;
  point.luminance = fitting.luminance(direction);
  return point;
}

namespace {

/// False where the two places are one.
bool set_way(const Vec3& from, const Vec3& to, Illumination& light) {
  const Vec3 way = to - from;
  light.position = to;
  light.direction = normalized_or_zero(way);
  light.distance_m = glm::dot(way, light.direction);
  return light.direction != Vec3(0);
}

}  // namespace

bool Luminaires::View::illuminate(float u_triangle, const Vec2& u, Illumination& result) {
  const Scene& scene = *lights_.scene_;
  const Light& light = scene.light[i_];
  result = Illumination();
  if (light.kind == Light::Kind::directional) {
    result.direction = -light.direction;
    result.value = light.intensity;
    return true;
  }
  if (light.kind == Light::Kind::environment) {
    const std::optional<PortalLight>& portals = lights_.portals_;
    const Environment::Sample sample = portals ? portals->sample(from_, u) : scene.environment->sample(u);
    result.direction = sample.direction;
    result.value = sample.luminance;
    result.density = sample.density;
    return result.density > 0;
  }
  if (light.kind == Light::Kind::area) return illuminate_from_area(u_triangle, u, result);
  if (!set_way(from_, light.position, result)) return false;
  const float share = intensity_share(scene, light, DVec3(from_) - DVec3(light.position));
  result.value = light.intensity * (share / (result.distance_m * result.distance_m));
  return share > 0 && is_finite(result.value);
}

bool Luminaires::View::illuminate_from_area(float u_triangle, const Vec2& u, Illumination& result) {
  const Scene& scene = *lights_.scene_;
  const Light& light = scene.light[i_];
  const Shape& shape = lights_.shape_[i_];
  if (shape.cdf.empty()) return false;
  const std::size_t facet = shape.parallelogram ? 0 : choose_facet(shape, u_triangle);
  if (looked_at_ != facet) looked_at_ = facet, near_ = see_near(shape, facet, from_);
  const EmissionPoint point =
      lights_.point_of(light, shape, near_ ? choose(shape, facet, *near_, u) : choose(shape, u_triangle, u));
  if (!set_way(from_, point.position, result)) return false;
  const float cosine = -glm::dot(result.direction, point.normal);
  const float cos_light = scene.material_of(point.triangle).double_sided ? std::fabs(cosine) : cosine;
  if (!(cos_light > 0)) return false;
  result.value = light.fitting < 0
                     ? point.luminance
                     : scene.fitting[static_cast<std::size_t>(light.fitting)].luminance(-result.direction);
  result.normal = cosine > 0 ? point.normal : -point.normal;
  result.error_m = point.error_m;
  result.triangle = point.triangle;
  result.density = near_ ? static_cast<float>(near_->density)
                         : point.density * result.distance_m * result.distance_m / cos_light;
  return result.density > 0 && std::isfinite(result.density);
}

float Luminaires::density(std::size_t i, const Vec3& from, std::uint32_t triangle, float distance_m,
                          float cos_light) const {
  const Light& light = scene_->light[i];
  if (light.kind != Light::Kind::area || !(cos_light > 0)) return 0;
  const Instance& instance = scene_->instance[light.instance];
  const std::uint32_t k = triangle - instance.first_triangle;  // wraps for one before it
  if (k >= instance.triangle_count) return 0;
  if (const auto near = see_near(shape_[i], k, from)) return static_cast<float>(near->density);
  return shape_[i].facet[k].density_per_m2 * distance_m * distance_m / cos_light;
}

float Luminaires::area_density(std::size_t i, std::uint32_t triangle) const {
  const Light& light = scene_->light[i];
  if (light.kind != Light::Kind::area) return 0;
  const Instance& instance = scene_->instance[light.instance];
  const std::uint32_t k = triangle - instance.first_triangle;  // wraps for one before it
  return k < instance.triangle_count ? shape_[i].facet[k].density_per_m2 : 0;
}

float Luminaires::density_beyond(const Vec3& from, const Vec3& direction) const {
  if (environment_ < 0) return 0;
  return portals_ ? portals_->density(from, direction) : scene_->environment->density(direction);
}

float Luminaires::promise_beyond_lx(const Vec3& from) const {
  if (environment_ < 0) return 0;
  // A surface turned any way receives a quarter of the light from all sides.
  return portals_ ? portals_->promise_lx(from) : 0.25f * luminance(Rgb(scene_->environment->integral_lx()));
}

std::int32_t Luminaires::light_of(std::uint32_t triangle) const {
  return instance_light_[scene_->triangle_instance[triangle]];
}

std::vector<double> Luminaires::power_shares(double minimum_share, double environment_lm) const {
  const std::size_t n = size();
  const auto flux_lm = [&](const Light& light) {
    const bool other = light.kind == Light::Kind::environment && environment_lm >= 0;
    return other ? environment_lm : static_cast<double>(luminance(light.flux_lm));
  };
  double total = 0;
  for (const Light& light : scene_->light) total += flux_lm(light);
  std::vector<double> shares(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double even = 1 / static_cast<double>(n);
    const double own = total > 0 && std::isfinite(total) ? flux_lm(scene_->light[i]) / total : even;
    shares[i] = minimum_share * even + (1 - minimum_share) * own;
  }
  return shares;
}

}  // namespace phos::inline scene
