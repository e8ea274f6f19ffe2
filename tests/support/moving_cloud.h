// A hemisphere of rays and the points that they hit, each of which moves by itself: a scene of small
// triangles that face the place, one for each ray.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/random.h"
#include "estimate/hemisphere/hemisphere.h"
#include "scene/scene.h"
#include "temporal/reprojection.h"

namespace phos::test {

struct CloudPoint {
  Vec3 position{0};
  Rgb radiance{0};
  std::optional<Vec3> next{};    ///< its position a frame later; nothing: it stays
  std::optional<Vec3> normal{};  ///< nothing: towards the origin
  std::optional<Vec3> turned{};  ///< the normal a frame later; nothing: towards the origin, or as it is
};

/// The points that rays from the origin see, above z.
class MovingCloud {
 public:
  /// `see(direction)`: the point in that direction; nothing: the ray escapes. `jitter`: rays lie anywhere in
  /// their cells, else in the middle.
  MovingCloud(int rings, int slices, Measure measure, bool jitter, std::uint64_t item,
              const std::function<std::optional<CloudPoint>(const Vec3&)>& see) {
    hemisphere.rings = rings, hemisphere.slices = slices, hemisphere.measure = measure;
    const auto n = static_cast<std::size_t>(rings * slices);
    hemisphere.resize(n), hits.resize(n);
    RandomStream random(5, Stage::test, item);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 u = jitter ? random.uniform2() : Vec2(0.5f);
      const auto ring = static_cast<float>(i / static_cast<std::size_t>(slices));
      const auto slice = static_cast<float>(i % static_cast<std::size_t>(slices));
      const double share = static_cast<double>(ring + u.x) / rings;
      const double phi = 2 * std::numbers::pi * static_cast<double>(slice + u.y) / slices;
      const double sin2 = measure == Measure::solid ? share * (2 - share) : share;
      const double z = std::sqrt(1 - sin2), s = std::sqrt(sin2);
      const Vec3 w(DVec3(s * std::cos(phi), s * std::sin(phi), z));
      hemisphere.direction[i] = w;
      hemisphere.projected_sr[i] = kPi / static_cast<float>(n);
      if (measure == Measure::solid) hemisphere.projected_sr[i] *= 2 * w.z;
      const std::optional<CloudPoint> p = see(w);
      hemisphere.distance_m[i] = p ? glm::length(p->position) : kInfinity;
      hemisphere.radiance[i] = p ? p->radiance : Rgb(0);
      hemisphere.hit_normal[i] = p && p->normal ? *p->normal : -w;
      if (!p) continue;
      hits[i] = {hemisphere.distance_m[i], static_cast<std::uint32_t>(now.triangle.size()), 0, 0};
      add(now, p->position, hemisphere.hit_normal[i], p->next.has_value());
      const Vec3 there = p->next.value_or(p->position);
      const Vec3 normal = p->turned   ? *p->turned
                          : p->normal ? *p->normal
                          : p->next   ? -glm::normalize(there)
                                      : -w;
      add(next, there, normal, p->next.has_value());
    }
  }

  ReprojectionCounts reproject(Hemisphere& ahead, const Vec3& shift_m = Vec3(0)) const {
    return reproject(ahead, shift_m, hemisphere.frame);
  }
  ReprojectionCounts reproject(Hemisphere& ahead, const Vec3& shift_m, const Frame& frame) const {
    return phos::reproject(hemisphere, hits, hemisphere.radiance, {now, next, moved}, shift_m, frame, ahead);
  }

  Hemisphere hemisphere;
  std::vector<Hit> hits;
  Scene now, next;
  std::vector<bool> moved{false, true};

 private:
  static void add(Scene& scene, const Vec3& p, const Vec3& normal, bool moves) {
    const Frame frame = make_frame(normal);
    const auto first = static_cast<std::uint32_t>(scene.position.size());
    const float size = 0.1f * glm::length(p);
    for (const Vec3& corner : {p, p + size * frame.x, p + size * frame.y}) scene.position.push_back(corner);
    scene.triangle.push_back({{first, first + 1, first + 2}});
    scene.triangle_instance.push_back(moves);
  }
};

}  // namespace phos::test
