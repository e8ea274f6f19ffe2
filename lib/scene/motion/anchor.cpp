#include "scene/motion/anchor.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/error.h"

namespace phos::inline scene {
namespace {

/// As far as the offset of any triangle of the scene (scene/offset.h) can be from its plane.
float reach_m(const Scene& scene, const Vec3& p) {
  float largest = 0;
  for (const Vec3& v : {p, scene.bounds.lo, scene.bounds.hi})
    largest = std::max(largest, max_component(abs(v)));
  return 0x1p-24f * (16 * largest + 32 * scene.bounds.diagonal_m());
}

/// All surfaces that a ray through p along -n meets, from `reach` before p to as much beyond.
template <class Visit>
void look(const RayScene& rays, const Vec3& p, const Vec3& n, float reach, const Visit& visit) {
  Ray ray{p + reach * n, -n, 0, 2 * reach};
  for (Hit hit; rays.intersect(ray, hit);) {
    visit(hit, std::fabs(hit.distance_m - reach));
    ray.t_min_m = std::nextafter(hit.distance_m, kInfinity);
  }
}

}  // namespace

std::optional<Pose> pose_of(const Scene& scene, const Anchor& anchor) {
  if (anchor.triangle >= scene.triangle.size()) return std::nullopt;
  const auto& corner = scene.triangle[anchor.triangle].v;
  const DVec3 a(scene.position[corner[0]]), b(scene.position[corner[1]]), c(scene.position[corner[2]]);
  const DVec3 normal = glm::cross(b - a, c - a);
  if (normal == DVec3(0)) return std::nullopt;
  const double u = anchor.u, v = anchor.v;
  const DVec3 z = glm::normalize(normal), x = glm::normalize(b - a);
  const glm::dquat turn = glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
  return Pose{Vec3((1 - u - v) * a + u * b + v * c), glm::quat(turn)};
}

Anchor anchor_at(const RayScene& rays, const Vec3& p, const Vec3& n) {
  const float reach = reach_m(rays.scene(), p);
  Anchor best;
  float least = kInfinity;
  // Of surfaces in one place, that whose front faces n; then the nearest. A ray that slips between two
  // triangles on its way in finds one of them on its way out.
  for (const float side : {1.0f, -1.0f}) {
    for (const bool front : {true, false}) {
      look(rays, p, side * n, reach, [&](const Hit& hit, float gap) {
        if ((glm::dot(geometric_normal(rays.scene(), hit.triangle), n) > 0) != front || !(gap < least))
          return;
        best = {hit.triangle, hit.u, hit.v};
        least = gap;
      });
      if (best.triangle != kNoTriangle) return best;
    }
  }
  return best;
}

}  // namespace phos::inline scene
