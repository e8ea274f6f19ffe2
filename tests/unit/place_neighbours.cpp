#include <gtest/gtest.h>

#include "core/random.h"
#include "place/neighbour_clamp.h"

namespace phos {
namespace {

struct Point {
  Vec3 p, n;
  float radius_m;
};

std::vector<Point> some_points(std::size_t n) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(6, Stage::test, i);
    const bool wall = random.uniform() < 0.3f;
    const Vec3 p =
        wall ? Vec3(0, random.uniform(), random.uniform()) : Vec3(random.uniform(), random.uniform(), 0);
    points.push_back({p, wall ? Vec3(1, 0, 0) : Vec3(0, 0, 1), 0.01f + random.uniform() * random.uniform()});
  }
  return points;
}

TEST(NeighbourClamp, IsTheLowerEnvelopeOfAllPairsInAnyOrder) {
  const std::vector<Point> points = some_points(600);
  Bounds bounds;
  for (const Point& q : points) bounds.include(q.p);
  for (const std::size_t step : {1u, 7u}) {
    NeighbourClamp clamp(bounds);
    std::vector<float> radius;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i) order.push_back(i * step % points.size());
    for (const std::size_t i : order) {
      radius.push_back(0);
      radius.back() = clamp.insert(points[i].p, points[i].n, points[i].radius_m, false,
                                   [&](std::size_t j, float r) { radius[j] = r; });
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      float expected = kInfinity;
      for (const std::size_t j : order) {
        expected = std::min(expected, points[j].radius_m + glm::length(points[j].p - points[order[i]].p));
      }
      EXPECT_NEAR(clamp.radius_m(i), expected, 2e-6f);
      EXPECT_EQ(clamp.radius_m(i), radius[i]);
    }
  }
}

TEST(NeighbourClamp, OfThoseByErrorJudgedPointsClampTheOnesAfterThem) {
  Bounds bounds;
  bounds.include(Vec3(0)), bounds.include(Vec3(1));
  NeighbourClamp clamp(bounds, ClampBy::judged, 0.5f);
  const auto never = [](std::size_t, float) { FAIL(); };
  const std::vector<Point> points = some_points(100);  // so many that the octree branches
  for (const Point& q : points) EXPECT_EQ(clamp.insert(q.p, q.n, q.radius_m, false, never), q.radius_m);
  clamp.lower(40, 0.001f);
  EXPECT_EQ(clamp.radius_m(40), 0.001f);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(clamp.radius_m(i), points[i].radius_m);
  const Vec3 p = points[40].p + Vec3(0, 0.05f, 0);
  EXPECT_NEAR(clamp.insert(p, points[40].n, 1, false, never), 0.001f + 0.5f * 0.05f, 1e-6f);
}

TEST(NeighbourClamp, TheOtherSideOfAWallAndFrozenPointsAreLeftAlone) {
  Bounds bounds;
  bounds.include(Vec3(0)), bounds.include(Vec3(1));
  NeighbourClamp clamp(bounds);
  const auto never = [](std::size_t, float) { FAIL(); };
  clamp.insert(Vec3(0.5f), {0, 0, 1}, 1, true, never);
  clamp.insert(Vec3(0.5f), {0, 0, -1}, 0.01f, false, never);
  EXPECT_EQ(clamp.insert(Vec3(0.5f, 0.5f, 0.6f), {0, 0, 1}, 0.02f, false, never), 0.02f);
  EXPECT_EQ(clamp.radius_m(0), 1.f);
}

TEST(NeighbourClamp, ManyPointsAtOnePlace) {
  NeighbourClamp clamp{Bounds()};
  int calls = 0;
  for (int i = 0; i < 100; ++i) {
    clamp.insert(Vec3(0), {0, 0, 1}, 1.f / static_cast<float>(1 + i), false,
                 [&](std::size_t, float) { ++calls; });
  }
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(clamp.radius_m(i), 0.01f);
  EXPECT_GT(calls, 0);
}

}  // namespace
}  // namespace phos
