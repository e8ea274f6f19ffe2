// Morton's order, where it is known, and where points coincide, are few, or far apart.
#include "photon/tree/space_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "core/random.h"

namespace phos {
namespace {

using Rows = Column<std::uint32_t>;

/// More than one chunk of the sort.
std::vector<Vec3> many(float scale) {
  std::vector<Vec3> points(300'000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    RandomStream random(1, Stage::test, i);
    random.start_bounce(0);
    const Vec2 xy = random.uniform2();
    points[i] = scale * Vec3(xy.x, xy.y, random.uniform());
  }
  return points;
}

double mean_step(const std::vector<Vec3>& points, const Rows& order) {
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i) sum += glm::distance(points[order[i]], points[order[i - 1]]);
  return sum / static_cast<double>(order.size() - 1);
}

TEST(SpaceOrder, CornersOfACube) {
  const std::vector<Vec3> corners{{1, 1, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0},
                                  {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  EXPECT_EQ(space_order(corners), (Rows{1, 4, 2, 6, 3, 7, 5, 0})) << "z before y before x";
}

TEST(SpaceOrder, NoneOneAndCoincident) {
  EXPECT_EQ(space_order({}), Rows{});
  EXPECT_EQ(space_order(std::vector<Vec3>{{1, 2, 3}}), Rows{0});
  EXPECT_EQ(space_order(std::vector<Vec3>(4, Vec3(1e18f))), (Rows{0, 1, 2, 3}));
}

TEST(SpaceOrder, ExtremeCoordinatesKeepTheirOrder) {
  const float tiny = std::numeric_limits<float>::min();
  EXPECT_EQ(space_order(std::vector<Vec3>{{tiny, 0, 0}, {0, 0, 0}}), (Rows{1, 0}));
  EXPECT_EQ(space_order(std::vector<Vec3>{{1e18f, 0, 0}, {0, 0, 0}, {-1e18f, 0, 0}}), (Rows{2, 1, 0}));
}

TEST(SpaceOrder, IsAPermutationOfNearNeighbours) {
  const std::vector<Vec3> points = many(1);
  Rows order = space_order(points);
  // Half of the steps are about as long as points are apart, a quarter twice that, an eighth ...
  EXPECT_LT(mean_step(points, order), 3 / std::cbrt(static_cast<double>(points.size())));
  std::sort(order.begin(), order.end());
  Rows all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(order, all);
}

TEST(SpaceOrder, AnyScaleAndAnyThreadsGiveTheSame) {
  const Rows order = space_order(many(1));
  EXPECT_EQ(space_order(many(0x1p-20f)), order);
  EXPECT_EQ(space_order(many(0x1p20f)), order);
  for (const int threads : {1, 7}) {
    set_threads(threads);
    EXPECT_EQ(space_order(many(1)), order) << threads;
  }
  set_threads(0);
}

}  // namespace
}  // namespace phos
