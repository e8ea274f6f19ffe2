// Points that records are asked for: on a surface, near one, in free air.
#include <gtest/gtest.h>

#include "place/points_on_surfaces.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// A room of 6 m: 10.4 m across, so that what is 1 cm off a wall is meant to lie on it.
struct Room {
  Room() {
    begin_instance(scene, "room", add_lambert(scene, "grey", 0.5f));
    add_room(scene, Vec3(-3), Vec3(3));
    finalize(scene);
  }
  Scene scene;
};

TEST(PointsOnSurfaces, StayAreMovedOrAreLeftOut) {
  const Room room;
  const RayScene rays(room.scene);
  const Vec3 up(0, 1, 0);
  const std::vector<SurfaceSample> points = {
      {{1, -3, 1}, up},        {{1, -2.995f, 1}, up},
      {{1, -2.9f, 1}, up},     {{1, -3.005f, 1}, up},
      {{1, 0, 1}, up},         {{1, 3, 1}, -up},
      {{3, 1, 1}, {-1, 0, 0}}, {{3, 1, 1}, up},
      {{0.2f, 90, 0.1f}, up},  {{1, -3, 1}, glm::normalize(Vec3(0.4f, 1, 0))}};
  const PointsOnSurfaces found = put_on_surfaces(rays, points, 1e-3f * room.scene.bounds.diagonal_m());
  EXPECT_EQ(found.in_air, 4u);
  EXPECT_EQ(found.moved, 2u);
  ASSERT_EQ(found.points.size(), 6u);
  EXPECT_EQ(found.points[0].position, points[0].position);
  EXPECT_NEAR(found.points[1].position.y, -3, 1e-6);
  EXPECT_NEAR(found.points[1].position.x, 1, 1e-6);
  EXPECT_NEAR(found.points[2].position.y, -3, 1e-6);
  EXPECT_EQ(found.points[3].position, points[5].position);
  EXPECT_EQ(found.points[4].position, points[6].position);
  EXPECT_EQ(found.points[5].position, points[9].position);
}

TEST(PointsOnSurfaces, EveryPointOfATracedSurfaceStaysAsItIs) {
  const Room room;
  const RayScene rays(room.scene);
  std::vector<SurfaceSample> points;
  for (int i = 0; i < 2000; ++i) {
    const float t = 0.1f + 0.7f * static_cast<float>(i);
    const Ray ray{Vec3(0.1f), glm::normalize(Vec3(std::cos(t), std::sin(1.3f * t), std::sin(0.7f * t)))};
    SurfacePoint point;
    ASSERT_TRUE(trace(rays, ray, point));
    points.push_back({point.position, point.normal});
  }
  const PointsOnSurfaces found = put_on_surfaces(rays, points, 1e-3f * room.scene.bounds.diagonal_m());
  EXPECT_EQ(found.in_air, 0u);
  EXPECT_EQ(found.moved, 0u);
}

}  // namespace
}  // namespace phos::test
