#include "scene/lamp/panel.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/lamp/luminaires.h"
#include "scene/lamp/near.h"
#include "scene/offset.h"

namespace phos::inline scene {

/// Makes one of two triangles that are the halves of a parallelogram.
bool LampPanel::join(Patch& first, const Patch& second) {
  const auto corner = [](const Patch& t, unsigned i) {
    return i % 3 == 0 ? t.corner : t.corner + t.edge[i % 3 - 1];
  };
  for (unsigned a = 0; a < 3; ++a) {
    for (unsigned b = 0; b < 3; ++b) {
      const Vec3 opposite = corner(first, a), p = corner(first, a + 1), q = corner(first, a + 2);
      // The common edge runs the other way round in the second triangle.
      const float slack = first.error_m + second.error_m;
      if (glm::length(p - corner(second, b + 2)) > slack || glm::length(q - corner(second, b + 1)) > slack)
        continue;
      const float gap = glm::length((p - opposite) - (corner(second, b) - q));
      if (gap > 4 * slack) continue;
      first.corner = opposite, first.edge[0] = p - opposite, first.edge[1] = q - opposite;
      first.error_m = std::max(first.error_m, second.error_m) + gap;
      first.parallelogram = true;
      return true;
    }
  }
  return false;
}

LampPanel::LampPanel(const Scene& scene, const Light& light) {
  if (light.kind != Light::Kind::area) return;
  const Instance& instance = scene.instance[light.instance];
  const Material& material = scene.material[instance.material];
  if (!shines_evenly(scene, instance)) return;
  luminance_cd_m2_ = material.emission, two_sided_ = material.double_sided;
  double sum = 0;
  std::vector<double> below;
  Bounds bounds;
  for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
       ++t) {
    const auto& v = scene.triangle[t].v;
    const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
    const float area = phos::area_m2(scene, t);
    if (!(area > 0)) continue;
    for (const Vec3* corner : {&a, &b, &c}) bounds.include(*corner);
    const Patch patch{a, {b - a, c - a}, geometric_normal(scene, t), offset_m(a, b, c), false};
    sum += static_cast<double>(area);
    if (!patch_.empty() && !patch_.back().parallelogram && join(patch_.back(), patch)) {
      below.back() = sum;
      continue;
    }
    patch_.push_back(patch), below.push_back(sum);
  }
  for (const double x : below) cdf_.push_back(static_cast<float>(x / sum));
  area_m2_ = static_cast<float>(sum);
  if (patch_.empty()) return;
  middle_ = bounds.centre();
  const float near_m = kNearRadii * 0.5f * bounds.diagonal_m();
  near2_m2_ = near_m * near_m;
}

LampPanel::Way LampPanel::way(const SurfacePoint& point, float u_patch, const Vec2& u) const {
  std::size_t k = 0;
  if (patch_.size() > 1) {
    const auto above = std::upper_bound(cdf_.begin(), cdf_.end() - 1, u_patch);
    k = static_cast<std::size_t>(above - cdf_.begin());
  }
  const Patch& patch = patch_[k];
  const Vec2 weight = patch.parallelogram ? u : sample_triangle(u);
  const Vec3 end = patch.corner + (weight.x * patch.edge[0] + weight.y * patch.edge[1]);
  const Vec3 way = end - point.position;
  Way result;
  const float height_m = glm::dot(way, point.normal), above_m = glm::dot(way, point.geometric_normal);
  float before_m = -glm::dot(way, patch.normal);
  if (two_sided_) before_m = std::fabs(before_m);
  if (!(height_m > 0) || !(before_m > 0)) return result;
  result.ray.origin = point.position + point.error_m * point.geometric_normal;
  const Vec3 free_way = end - result.ray.origin;
  const float d2 = glm::dot(free_way, free_way);
  if (!(d2 > 0)) return result;
  const float per_m = 1 / std::sqrt(d2), per_m2 = per_m * per_m;
  result.weight_sr = (height_m * per_m2) * (before_m * per_m2) * area_m2_;
  result.above = above_m > 0;
  result.ray.direction = free_way * per_m;
  result.ray.t_max_m = d2 * per_m - std::max(patch.error_m, point.error_m);
  return result;
}

}  // namespace phos::inline scene
