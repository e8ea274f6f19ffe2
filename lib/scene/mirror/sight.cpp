#include "scene/mirror/sight.h"

#include <algorithm>

#include "core/sampling.h"
#include "scene/mirror/images.h"
#include "scene/offset.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kPlaces = 64;  // of a mirror
constexpr std::size_t kPairs = 4 * kPlaces;
constexpr std::size_t kStride = 29;       // from one partner of a place to the next one's: far apart
constexpr std::size_t kPlacesOfLamp = 4;  // of one with an area
constexpr std::size_t kMostLamps = 256;
constexpr float kRounding = 1e-6f;                               // of a distance
constexpr std::uint32_t kShift[2] = {0x9e3779b9u, 0x7f4a7c15u};  // off corners and edges

}  // namespace

MirrorSight::MirrorSight(const Scene& scene, std::span<const Vec3> normals,
                         std::span<const std::int32_t> plane_of)
    : scene_(scene), rays_(scene), normal_(normals.begin(), normals.end()), place_(normals.size()) {
  std::vector<std::vector<std::uint32_t>> triangles(normals.size());
  for (std::uint32_t t = 0; t < plane_of.size(); ++t)
    if (plane_of[t] >= 0) triangles[static_cast<std::size_t>(plane_of[t])].push_back(t);
  for (std::size_t p = 0; p < triangles.size(); ++p) place_[p] = places_on(scene, triangles[p]);
  find_lamps();
}

/// kPlaces of them, evenly over the area of all triangles.
std::vector<MirrorSight::Place> MirrorSight::places_on(const Scene& scene,
                                                       std::span<const std::uint32_t> triangles) {
  double area = 0;
  for (const std::uint32_t t : triangles) area += static_cast<double>(area_m2(scene, t));
  std::vector<Place> places;
  double before = 0;
  for (const std::uint32_t t : triangles) {
    const auto& v = scene.triangle[t].v;
    const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
    before += static_cast<double>(area_m2(scene, t));
    while (places.size() < kPlaces &&
           (static_cast<double>(places.size()) + 0.5) * area < before * static_cast<double>(kPlaces)) {
      const Vec2 w = sample_triangle(sobol_point(static_cast<int>(places.size()), kShift[0], kShift[1]));
      places.push_back({a + w.x * (b - a) + w.y * (c - a), 4 * offset_m(a, b, c)});
    }
  }
  return places;
}

void MirrorSight::find_lamps() {
  std::vector<std::size_t> with_images;
  for (std::size_t i = 0; i < scene_.light.size(); ++i)
    if (has_images(scene_, scene_.light[i])) with_images.push_back(i);
  // Of very many lamps as many as are looked at, evenly.
  const std::size_t step = (with_images.size() + kMostLamps - 1) / kMostLamps;
  for (std::size_t k = 0; k < with_images.size(); k += std::max<std::size_t>(step, 1)) {
    const Light& light = scene_.light[with_images[k]];
    switch (light.kind) {
      case Light::Kind::environment:
        far_lamp_.push_back(Vec3(scene_.environment->sun()->towards));
        break;
      case Light::Kind::directional:
        far_lamp_.push_back(-light.direction);
        break;
      case Light::Kind::area: {
        const Instance& instance = scene_.instance[light.instance];
        std::vector<std::uint32_t> triangles(instance.triangle_count);
        for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = instance.first_triangle + t;
        const std::vector<Place> places = places_on(scene_, triangles);
        for (std::size_t p = 0; p < places.size(); p += kPlaces / kPlacesOfLamp) lamp_.push_back(places[p]);
        break;
      }
      case Light::Kind::point:
      case Light::Kind::spot:
      case Light::Kind::measured:
        lamp_.push_back({light.position, 0});
        break;
    }
  }
}

bool MirrorSight::free_between(const Place& from, const Vec3& normal, const Place& to) const {
  const Vec3 start = from.position + from.error_m * normal, way = to.position - start;
  const float distance_m = glm::length(way);
  if (!(glm::dot(way, normal) > 0)) return false;
  const Ray ray{start, way / distance_m, 0, (1 - kRounding) * distance_m - to.error_m};
  return !(ray.t_max_m > 0) || max_component(rays_.transmittance(ray)) > 0;
}

float MirrorSight::lit_share(const Side& side) const {
  const std::vector<Place>& places = place_[side.plane];
  const std::size_t lamps = lamp_.size() + far_lamp_.size();
  if (places.empty() || lamps == 0) return 0;
  const Vec3 up = normal(side);
  std::size_t lit = 0;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const Place& place = places[k % places.size()];
    const std::size_t lamp = (k / kPlaces + k * kStride) % lamps;
    if (lamp < lamp_.size()) {
      lit += free_between(place, up, lamp_[lamp]);
      continue;
    }
    const Vec3& direction = far_lamp_[lamp - lamp_.size()];
    lit += glm::dot(direction, up) > 0 &&
           max_component(rays_.transmittance({place.position + place.error_m * up, direction})) > 0;
  }
  return static_cast<float>(lit) / static_cast<float>(kPairs);
}

float MirrorSight::seen_share(const Side& a, const Side& b) const {
  const std::vector<Place>&from = place_[a.plane], &to = place_[b.plane];
  if (from.empty() || to.empty()) return 0;
  const Vec3 up = normal(a), other_up = normal(b);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const Place& place = from[k % from.size()];
    const Place& other = to[(k / kPlaces + k * kStride) % to.size()];
    seen += glm::dot(place.position - other.position, other_up) > 0 &&
            free_between(place, up, {other.position + other.error_m * other_up, other.error_m});
  }
  return static_cast<float>(seen) / static_cast<float>(kPairs);
}

}  // namespace phos::inline scene
