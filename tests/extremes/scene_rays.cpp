// Rays that leave a surface do not meet it again, at any size and far from the origin, and meet what is close
// by.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/rays.h"

using namespace phos;

namespace {

struct Setting {
  float scale_m, offset;  // offset in diagonals
};

constexpr Setting kSettings[] = {{1e-6f, 0}, {1, 0}, {1e6f, 0}, {1e-6f, 1e3f}, {1, 1e3f}, {1e6f, 1e3f}};

Vec3 random_vector(RandomStream& random) { return 2.f * Vec3(random.uniform2(), random.uniform()) - 1.f; }

Scene soup(const std::vector<Vec3>& positions) {
  Scene scene;
  scene.position = positions;
  const auto n = static_cast<std::uint32_t>(positions.size() / 3);
  for (std::uint32_t i = 0; i < n; ++i) scene.triangle.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  scene.triangle_instance.assign(n, 0);
  scene.instance.resize(1);
  scene.instance[0].triangle_count = n;
  scene.material.resize(1);
  return scene;
}

/// A point of triangle 0, as a ray from the front or the back finds it; built by hand so that no other
/// triangle is in the way.
SurfacePoint point_on(const RayScene& rays, const Vec2& weights, bool front) {
  const Scene& scene = rays.scene();
  const Vec3 n = glm::normalize(
      glm::cross(scene.position[1] - scene.position[0], scene.position[2] - scene.position[0]));
  Ray ray;
  ray.direction = front ? -n : n;
  return rays.surface(ray, {1, 0, weights.x, weights.y});
}

}  // namespace

TEST(LeavingRays, NeverMeetTheirOwnTriangle) {
  for (const Setting& setting : kSettings) {
    int hits = 0, rays_cast = 0;
    for (int k = 0; k < 400; ++k) {
      RandomStream random(11, Stage::test, static_cast<std::uint64_t>(k));
      const Vec3 offset = setting.offset * random_vector(random);
      std::vector<Vec3> corners;
      for (int i = 0; i < 3; ++i) corners.push_back(setting.scale_m * (random_vector(random) + offset));
      if (k % 4 == 0)
        corners[2] = 0.5f * (corners[0] + corners[1]) + 0.01f * (corners[2] - corners[0]);  // a sliver
      const Scene scene = soup(corners);
      const RayScene rays(scene);
      for (int s = 0; s < 100; ++s) {
        const SurfacePoint p = point_on(rays, sample_triangle(random.uniform2()), s % 2 == 0);
        Vec3 local = sample_uniform_cone(random.uniform2(), 0);
        if (s % 5 == 0) local = glm::normalize(Vec3(local.x, local.y, 1e-3f * local.z));  // grazing
        const Vec3 d = make_frame(p.geometric_normal).to_world(local);
        if (glm::dot(d, p.geometric_normal) <= 0) continue;
        ++rays_cast;
        hits += rays.occluded({p.leave(d), d, 0, kInfinity});
      }
    }
    EXPECT_EQ(hits, 0) << "of " << rays_cast << " at scale " << setting.scale_m << " offset "
                       << setting.offset;
    EXPECT_GT(rays_cast, 30000);
  }
}

TEST(LeavingRays, MeetAParallelWallCloseBy) {
  for (const Setting& setting : kSettings) {
    int misses = 0;
    for (int k = 0; k < 400; ++k) {
      RandomStream random(12, Stage::test, static_cast<std::uint64_t>(k));
      const Vec3 offset = setting.offset * random_vector(random);
      std::vector<Vec3> corners;
      for (int i = 0; i < 3; ++i) corners.push_back(setting.scale_m * (random_vector(random) + offset));
      float largest = 0;
      for (const Vec3& p : corners) largest = std::max(largest, max_component(glm::abs(p)));
      const Vec3 n = normalized_or_zero(glm::cross((corners[1] - corners[0]) / setting.scale_m,
                                                   (corners[2] - corners[0]) / setting.scale_m));
      if (n == Vec3(0)) continue;
      const float gap = 1e-4f * largest;
      // The wall is a copy of the triangle, 2 times as large about its centre.
      const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.f;
      for (int i = 0; i < 3; ++i)
        corners.push_back(centre + 2.f * (corners[static_cast<std::size_t>(i)] - centre) + gap * n);
      const Scene scene = soup(corners);
      const RayScene rays(scene);
      for (int s = 0; s < 20; ++s) {
        const SurfacePoint p = point_on(rays, sample_triangle(random.uniform2()), true);
        ASSERT_LT(p.error_m, 0.2f * gap);
        Hit hit;
        const bool found =
            rays.intersect({p.leave(p.geometric_normal), p.geometric_normal, 0, kInfinity}, hit);
        misses += !(found && hit.triangle == 1);
      }
    }
    EXPECT_EQ(misses, 0) << "at scale " << setting.scale_m << " offset " << setting.offset;
  }
}

TEST(Visibility, HoldsBetweenFacingWallsAtAnyScale) {
  for (const Setting& setting : kSettings) {
    for (const float gap : {2.f, 0.01f}) {
      const auto at = [&](float x, float y, float z) {
        return setting.scale_m * (Vec3(x, y, z) + 2.f * setting.offset * Vec3(0.9f, 0.3f, -0.7f));
      };
      std::vector<Vec3> corners = {at(-1, -1, 0),   at(1, -1, 0),  at(0, 1, 0),
                                   at(-1, -1, gap), at(0, 1, gap), at(1, -1, gap)};
      Scene open = soup(corners);
      for (const Vec2& p : {Vec2(-20, -10), Vec2(20, -10), Vec2(0, 30)})
        corners.push_back(at(p.x, p.y, gap / 2));
      Scene closed = soup(corners);
      const RayScene clear(open), blocked(closed);
      const float step = setting.offset > 0 ? setting.scale_m * setting.offset * 1e-4f : 0;  // of coordinates
      for (int k = 0; k < 200; ++k) {
        RandomStream random(13, Stage::test, static_cast<std::uint64_t>(k));
        const Vec2 wa = sample_triangle(random.uniform2()), wb = sample_triangle(random.uniform2());
        Ray down, up;
        down.direction = Vec3(0, 0, -1);
        const SurfacePoint a = clear.surface(down, {1, 0, wa.x, wa.y});
        const SurfacePoint b = clear.surface(up, {1, 1, wb.x, wb.y});
        EXPECT_TRUE(clear.visible(a, b) && clear.visible(b, a));
        EXPECT_TRUE(clear.visible(a, b.position, b.error_m));
        if (gap * setting.scale_m < 20 * step) continue;  // the three walls fall together in floats
        EXPECT_FALSE(blocked.visible(a, b) || blocked.visible(b, a));
        EXPECT_FALSE(blocked.visible(a, b.position, b.error_m));
      }
    }
  }
}
