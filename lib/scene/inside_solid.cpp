#include "scene/inside_solid.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/origin.h"
#include "core/random.h"
#include "core/sampling.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/receiver.h"

namespace phos::inline scene {
namespace {

constexpr std::uint64_t kPaths = 64;
constexpr std::uint32_t kBounces = 16;

/// The corners of a cube, turned so that they do not run along walls and diagonals.
std::array<Vec3, 8> turned_corners() {
  std::array<Vec3, 8> d;
  const Vec3 x = glm::normalize(Vec3(3, 1, 0.6f)), y = glm::normalize(glm::cross(Vec3(0.2f, -0.7f, 2), x)),
             z = glm::cross(x, y);
  for (std::size_t i = 0; i < 8; ++i)
    d[i] = glm::normalize((i & 1 ? 1.f : -1.f) * x + (i & 2 ? 1.f : -1.f) * y + (i & 4 ? 1.f : -1.f) * z);
  return d;
}

const std::array<Vec3, 8>& eight_directions() {
  static const std::array<Vec3, 8> kDirections = turned_corners();
  return kDirections;
}

Vec3 lifted(const SurfacePoint& p) { return p.position + p.error_m * p.geometric_normal; }

/// Does light of a lamp without extent come straight to p?
bool sees_lamp(const RayScene& rays, const Vec3& p, const Light& light) {
  if (light.extended()) return false;
  if (light.kind == Light::Kind::directional) return !rays.occluded({p, -light.direction});
  const Vec3 way = light.position - p;
  const float distance_m = glm::length(way);
  return distance_m > 0 && !rays.occluded({p, way / distance_m, 0, distance_m});
}

/// Does light get to the point, from a lamp or from outside of everything? Surfaces send it any way.
bool light_gets_to(const RayScene& rays, const Vec3& origin) {
  const Scene& scene = rays.scene();
  const std::size_t lamps = scene.light.size();
  for (const Light& light : scene.light)
    if (sees_lamp(rays, origin, light)) return true;
  for (std::uint64_t path = 0; path < kPaths; ++path) {
    RandomStream random(0, Stage::pilot, path);
    random.start_bounce(0);
    Ray ray{origin, sample_uniform_sphere(random.uniform2())};
    for (std::uint32_t bounce = 1; bounce <= kBounces; ++bounce) {
      SurfacePoint seen;
      if (!trace(rays, ray, seen)) return true;
      const Material& m = scene.material[seen.material];
      const bool shines = m.emits() && (seen.front || m.double_sided);
      if (shines || transmits(scene, m)) return true;
      random.start_bounce(bounce);
      const Vec3 direction =
          make_frame(seen.geometric_normal).to_world(sample_cosine_hemisphere(random.uniform2()));
      ray = {seen.leave(direction), direction};
      if (lamps > 0 && sees_lamp(rays, ray.origin, scene.light[(path + bounce) % lamps])) return true;
    }
  }
  return false;
}

}  // namespace

bool inside_solid(const RayScene& rays, const SurfacePoint& receiver) {
  const Scene& scene = rays.scene();
  const Vec3 origin = lifted(receiver);
  int hits = 0, behind = 0, one_sided = 0;
  for (const Vec3& direction : eight_directions()) {
    Hit hit;
    const Ray ray{origin, direction};
    if (!rays.intersect(ray, hit)) continue;
    // Thin panes have no inside.
    if (const Material& m = scene.material_of(hit.triangle); !is_solid_glass(m) && passes_straight(scene, m))
      continue;
    ++hits;
    if (!(glm::dot(geometric_normal(scene, hit.triangle), direction) > 0)) continue;
    ++behind;
    one_sided += !scene.material_of(hit.triangle).double_sided;
  }
  if (2 * behind <= hits) return false;
  return 2 * one_sided > behind || !light_gets_to(rays, origin);
}

const Material* glass_about(const RayScene& rays, const SurfacePoint& receiver) {
  const Scene& scene = rays.scene();
  if (std::none_of(scene.material.begin(), scene.material.end(), is_solid_glass)) return nullptr;
  const Vec3 origin = lifted(receiver);
  const Material* glass = nullptr;
  std::size_t inside = 0;
  for (const Vec3& direction : eight_directions()) {
    Hit hit;
    if (!rays.intersect({origin, direction}, hit)) continue;
    const Material& m = scene.material_of(hit.triangle);
    if (!is_solid_glass(m) || !(glm::dot(geometric_normal(scene, hit.triangle), direction) > 0)) continue;
    ++inside, glass = &m;
  }
  return 2 * inside > eight_directions().size() ? glass : nullptr;
}

void require_in_air(const RayScene& rays, const Vec3& p, const Vec3& n, const std::string& where) {
  const Material* glass = glass_about(rays, receiver(rays.scene(), p, n));
  if (!glass) return;
  throw Error(ExitCode::bad_input, where,
              text("the sensor at ", place_text(rays.scene().origin_m, p), " is inside of solid glass \"",
                   glass->name, "\", where no light is measured: move it into the air"));
}

std::optional<std::string> camera_inside_solid(const RayScene& rays, const Camera& camera) {
  if (!camera.perspective) return std::nullopt;
  SurfacePoint eye;
  eye.position = Vec3(camera.to_world[3]);
  if (const Material* glass = glass_about(rays, eye))
    return text("camera \"", camera.name, "\" stands inside of solid glass \"", glass->name, "\": move it");
  if (!inside_solid(rays, eye)) return std::nullopt;
  return text("camera \"", camera.name,
              "\" stands inside a solid, or behind walls that show their backs: move it");
}

}  // namespace phos::inline scene
