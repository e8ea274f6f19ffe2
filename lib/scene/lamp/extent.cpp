#include "scene/lamp/extent.h"

#include <cmath>

namespace phos::inline scene {
namespace {

constexpr float kSameDirection = 0.999f;
constexpr float kThinnest = 1e-4f;  // thickness of a plane lamp, in its radii

bool is_plane(const Scene& scene, std::uint32_t begin, std::uint32_t end, const LampExtent& lamp) {
  for (std::uint32_t t = begin; t < end; ++t) {
    if (!(glm::dot(geometric_normal(scene, t), lamp.front) > kSameDirection)) return false;
    for (const std::uint32_t v : scene.triangle[t].v)
      if (!(std::fabs(glm::dot(scene.position[v] - lamp.centre, lamp.front)) < kThinnest * lamp.radius_m))
        return false;
  }
  return true;
}

}  // namespace

LampExtent extent_of(const Scene& scene, const Light& light) {
  const Instance& instance = scene.instance[light.instance];
  const std::uint32_t begin = instance.first_triangle, end = begin + instance.triangle_count;
  Bounds bounds;
  for (std::uint32_t t = begin; t < end; ++t)
    for (const std::uint32_t v : scene.triangle[t].v) bounds.include(scene.position[v]);
  LampExtent lamp{bounds.centre(), 0.501f * bounds.diagonal_m(), geometric_normal(scene, begin)};
  if (scene.material[instance.material].double_sided || !is_plane(scene, begin, end, lamp))
    lamp.front = Vec3(0);
  return lamp;
}

}  // namespace phos::inline scene
