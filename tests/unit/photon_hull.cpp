#include "photon/hull.h"

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"

namespace phos {
namespace {

Hull hull_of(const std::vector<Vec2>& points) {
  Hull hull;
  convex_hull(points, hull);
  return hull;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

TEST(Hull, SquareWithPointsInsideAndOnItsEdges) {
  const Hull h = hull_of({{0, 0}, {2, 0}, {1, 0}, {1, 1}, {2, 2}, {0, 2}, {0, 1}, {0.5f, 1.5f}});
  EXPECT_EQ(std::set<std::uint32_t>(h.vertices.begin(), h.vertices.end()),
            (std::set<std::uint32_t>{0, 1, 4, 5}));
  EXPECT_DOUBLE_EQ(h.area, 4);
  EXPECT_NEAR(h.centroid.x, 1, 1e-12);
  EXPECT_NEAR(h.centroid.y, 1, 1e-12);
}

TEST(Hull, TriangleAreaAndCentroid) {
  const Hull h = hull_of({{1, 1}, {4, 1}, {1, 3}});
  EXPECT_DOUBLE_EQ(h.area, 3);
  EXPECT_NEAR(h.centroid.x, 2, 1e-12);
  EXPECT_NEAR(h.centroid.y, 5.0 / 3, 1e-12);
}

TEST(Hull, ContainsEveryPointAndTurnsLeftAtEveryVertex) {
  for (std::uint64_t round = 0; round < 20; ++round) {
    RandomStream random(1, Stage::test, round);
    std::vector<Vec2> points(10 + 50 * round);
    for (Vec2& p : points) p = random.uniform2();
    const Hull h = hull_of(points);
    ASSERT_GE(h.vertices.size(), 3u);
    for (std::size_t i = 0; i < h.vertices.size(); ++i) {
      const glm::dvec2 a(points[h.vertices[i]]), b(points[h.vertices[(i + 1) % h.vertices.size()]]);
      const glm::dvec2 c(points[h.vertices[(i + 2) % h.vertices.size()]]);
      EXPECT_GT(cross(b - a, c - b), 0);
      for (const Vec2& p : points) EXPECT_GE(cross(b - a, glm::dvec2(p) - a), 0);
    }
  }
}

TEST(Hull, NothingOnePointTwoPointsAndALineHaveNoArea) {
  EXPECT_TRUE(hull_of({}).vertices.empty());
  EXPECT_EQ(hull_of({{3, 4}}).vertices.size(), 1u);
  EXPECT_EQ(hull_of({{3, 4}, {5, 6}}).area, 0);
  EXPECT_EQ(hull_of({{1, 1}, {1, 1}, {1, 1}}).vertices.size(), 1u);
  const Hull line = hull_of({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {3, 3}});
  EXPECT_EQ(line.vertices.size(), 2u);
  EXPECT_EQ(line.area, 0);
}

TEST(Hull, NearlyCollinearPointsAreSafe) {
  RandomStream random(2, Stage::test, 0);
  std::vector<Vec2> points(1000);
  for (Vec2& p : points) {
    const float x = random.uniform();
    p = {x, 0.3f * x + 0.1f};
  }
  const Hull h = hull_of(points);
  EXPECT_GE(h.vertices.size(), 2u);
  EXPECT_LT(h.area, 1e-7);
  EXPECT_GE(h.area, 0);
}

TEST(Hull, PassesOverPointsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Hull h = hull_of({{nan, 0}, {0, 0}, {1, 0}, {kInfinity, 1}, {0, 1}, {0, -kInfinity}});
  EXPECT_EQ(std::set<std::uint32_t>(h.vertices.begin(), h.vertices.end()),
            (std::set<std::uint32_t>{1, 2, 4}));
  EXPECT_DOUBLE_EQ(h.area, 0.5);
  EXPECT_TRUE(hull_of({{nan, nan}}).vertices.empty());
}

TEST(Hull, SameAreaFarFromTheOriginAndAtAnyScale) {
  for (const float scale : {1e-15f, 1e-6f, 1.f, 1e6f, 1e15f}) {
    const Hull h = hull_of({{0, 0}, {scale, 0}, {scale, scale}, {0, scale}});
    EXPECT_NEAR(h.area / (double(scale) * double(scale)), 1, 1e-12) << scale;
  }
  const Hull far =
      hull_of({{1e5f, 1e5f}, {1e5f + 0.25f, 1e5f}, {1e5f + 0.25f, 1e5f + 0.25f}, {1e5f, 1e5f + 0.25f}});
  EXPECT_DOUBLE_EQ(far.area, 0.0625);
}

}  // namespace
}  // namespace phos
