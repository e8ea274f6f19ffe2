#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/random.h"
#include "splat/gbuffer.h"
#include "splat/projection.h"
#include "support/scenes.h"

namespace phos {
namespace {

TEST(PixelRay, CountsFromTheTopLeft) {
  const Camera camera = test::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.8f);
  const Ray left = pixel_ray(camera, 40, 20, 0, 0, {0, 0}), right = pixel_ray(camera, 40, 20, 39, 19, {1, 1});
  const float top = std::tan(0.4f);
  EXPECT_NEAR(left.direction.y / -left.direction.z, top, 1e-6);
  EXPECT_NEAR(left.direction.x / -left.direction.z, -2 * top, 1e-6);
  EXPECT_NEAR(right.direction.y / -right.direction.z, -top, 1e-6);
  EXPECT_NEAR(right.direction.x / -right.direction.z, 2 * top, 1e-6);
  const Ray middle = pixel_ray(camera, 41, 21, 20, 10, {0.5f, 0.5f});
  EXPECT_NEAR(glm::length(middle.direction - Vec3(0, 0, -1)), 0, 1e-6);
}

TEST(GBuffer, HoldsWhatTheRaysSee) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const Camera& camera = s.scene.camera[0];
  const GBuffer g = trace_gbuffer(rays, camera, 48, 32, {0.5f, 0.5f});
  ASSERT_EQ(g.position.size(), 48u * 32u);
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    ASSERT_TRUE(g.covered(i)) << "the room is closed";
    const Ray ray =
        pixel_ray(camera, 48, 32, static_cast<int>(i % 48), static_cast<int>(i / 48), {0.5f, 0.5f});
    const Vec3 p(g.position[i]), n(g.normal[i]);
    ASSERT_NEAR(glm::length(n), 1, 1e-5);
    ASSERT_LT(glm::dot(n, ray.direction), 0) << "on the side that is seen";
    ASSERT_NEAR(glm::distance(p, ray.origin + g.normal[i].w * ray.direction), 0, 1e-5);
    ASSERT_NEAR(g.albedo[i].x, 0.5f, 1e-6);
    ASSERT_EQ(g.albedo[i].w, 0);
    ASSERT_EQ(g.hit[i].distance_m, g.normal[i].w);
  }
}

TEST(GBuffer, IsZeroWhereNothingIsVisible) {
  test::AnalyticScene s = test::point_light_over_plane();
  const RayScene rays(s.scene);
  const GBuffer g =
      trace_gbuffer(rays, test::look_at({0, 1, 0}, {0, 2, 0.1f}, {0, 0, 1}, 0.5f), 8, 8, {0.5f, 0.5f});
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_FALSE(g.covered(i));
    EXPECT_EQ(g.position[i], Vec4(0));
    EXPECT_EQ(g.normal[i], Vec4(0));
    EXPECT_EQ(g.hit[i].distance_m, kInfinity);
  }
}

TEST(GBuffer, IsTheSameForAnyNumberOfThreads) {
  const test::AnalyticScene s = test::integrating_sphere(0.5f, 320);
  const RayScene rays(s.scene);
  set_threads(1);
  const GBuffer one = trace_gbuffer(rays, s.scene.camera[0], 64, 64, {0.25f, 0.75f});
  set_threads(2);
  const GBuffer two = trace_gbuffer(rays, s.scene.camera[0], 64, 64, {0.25f, 0.75f});
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.normal, two.normal);
  EXPECT_EQ(one.albedo, two.albedo);
}

/// Does the ray meet the sphere, in front?
bool meets(const Ray& ray, const Vec3& centre, double radius) {
  const DVec3 to = DVec3(centre) - DVec3(ray.origin), direction(ray.direction);
  const double along = glm::dot(to, direction), square = radius * radius - glm::dot(to, to) + along * along;
  return square >= 0 && along + std::sqrt(square) >= 0;
}

void expect_bounds_hold(const Camera& camera, float size, const char* what) {
  constexpr int kWidth = 60, kHeight = 40;
  const Projection projection(camera, kWidth, kHeight);
  int seen = 0;
  for (std::uint64_t item = 0; item < 400; ++item) {
    RandomStream random(5, Stage::test, item);
    const Vec3 centre = size * (4.f * Vec3(random.uniform(), random.uniform(), random.uniform()) - 2.f);
    const double radius = size * std::pow(10.0, 3 * random.uniform_double() - 2.5);
    const PixelRect rect = projection.sphere_bounds(centre, radius);
    PixelRect tight{kWidth, kHeight, 0, 0};
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (!meets(pixel_ray(camera, kWidth, kHeight, x, y, {random.uniform(), random.uniform()}), centre,
                   radius)) {
          continue;
        }
        tight = {std::min(tight.x0, x), std::min(tight.y0, y), std::max(tight.x1, x + 1),
                 std::max(tight.y1, y + 1)};
      }
    }
    if (tight.empty()) continue;
    ++seen;
    ASSERT_LE(rect.x0, tight.x0) << what << " sphere " << item;
    ASSERT_LE(rect.y0, tight.y0) << what << " sphere " << item;
    ASSERT_GE(rect.x1, tight.x1) << what << " sphere " << item;
    ASSERT_GE(rect.y1, tight.y1) << what << " sphere " << item;
    // And no larger than the margin asks, for spheres that lie in the picture as a whole.
    const bool inside = tight.x0 > 3 && tight.y0 > 3 && tight.x1 < kWidth - 3 && tight.y1 < kHeight - 3;
    if (inside && tight.x1 - tight.x0 > 6) {
      ASSERT_GE(rect.x0, tight.x0 - 4) << what << " sphere " << item;
      ASSERT_LE(rect.x1, tight.x1 + 4) << what << " sphere " << item;
    }
  }
  EXPECT_GT(seen, 50) << what;
}

TEST(Projection, BoundsEverySphere) {
  const Camera camera = test::look_at({0.3f, 0.5f, 1.5f}, {0, 0, 0}, {0.2f, 1, 0}, 0.9f);
  expect_bounds_hold(camera, 1, "perspective");
  Camera wide = camera;
  wide.yfov_rad = 2.6f;
  expect_bounds_hold(wide, 1, "wide");
  Camera parallel = camera;
  parallel.perspective = false, parallel.ymag_m = 1.5f;
  expect_bounds_hold(parallel, 1, "orthographic");
  Camera stretched = camera;
  for (int i = 0; i < 3; ++i) stretched.to_world[i] *= i == 0 ? 3.f : 0.5f;
  expect_bounds_hold(stretched, 1, "camera under a scaled node");
}

TEST(Projection, BoundsAtTheEye) {
  const Camera camera = test::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.8f);
  const Projection projection(camera, 100, 80);
  const PixelRect inside = projection.sphere_bounds({0.1f, 0, 0.2f}, 0.5);
  EXPECT_EQ(inside.x0, 0);
  EXPECT_EQ(inside.x1, 100);
  EXPECT_EQ(inside.y0, 0);
  EXPECT_EQ(inside.y1, 80);
  EXPECT_TRUE(projection.sphere_bounds({0, 0, 2}, 1).empty()) << "behind";
  EXPECT_TRUE(projection.sphere_bounds({50, 0, -1}, 1).empty()) << "beside";
  const PixelRect across = projection.sphere_bounds({1, 0, 0.05f}, 0.98);
  EXPECT_EQ(across.x1, 100) << "reaches past the eye's plane on the right";
  EXPECT_GT(across.x0, 0) << "but not to the left edge";
  const PixelRect whole = projection.sphere_bounds({0, 0, -5}, kInfinity);
  EXPECT_EQ(whole.x1, 100);
  const PixelRect dot = projection.sphere_bounds({0, 0, -5}, 1e-9);
  EXPECT_LE(dot.x1 - dot.x0, 4);
  EXPECT_FALSE(dot.empty());
}

}  // namespace
}  // namespace phos
