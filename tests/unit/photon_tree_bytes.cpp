// The tree that all threads build and save is, byte for byte, the one that FLANN builds and saves on one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <flann/flann.hpp>
#include <memory>

#include "core/parallel.h"
#include "core/random.h"
#include "photon/tree/kd_tree.h"

namespace phos {
namespace {

std::vector<std::byte> flanns_own(const std::vector<Vec3>& points) {
  const flann::Matrix<float> matrix(const_cast<float*>(&points.data()->x), points.size(), 3);
  flann::KDTreeSingleIndex<flann::L2_Simple<float>> tree(matrix, flann::KDTreeSingleIndexParams(16, false));
  tree.buildIndex();
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const file = open_memstream(&text, &size);
  tree.saveIndex(file);
  std::fclose(file);
  const std::unique_ptr<char, void (*)(void*)> owner(text, std::free);
  const auto* bytes = reinterpret_cast<const std::byte*>(text);
  return {bytes, bytes + size};
}

void expect_flanns(const std::vector<Vec3>& points, const char* what) {
  const std::vector<std::byte> expected = flanns_own(points);
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    EXPECT_TRUE(KdTree::build(points).save() == expected)
        << what << ", " << points.size() << " points, " << threads << " threads";
  }
  EXPECT_TRUE(KdTree::load(points, expected, "test").save() == expected) << what << ", loaded";
  set_threads(0);
}

/// Points of a kind, in no order.
template <class Point>
std::vector<Vec3> points_of(std::size_t n, const Point& point) {
  std::vector<Vec3> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(3, Stage::test, i);
    const Vec2 xy = random.uniform2();
    points[i] = point(Vec3(xy.x, xy.y, random.uniform()));
  }
  return points;
}

// Sizes at which a block of the stream begins with the order, with the nodes, or within a node, and ends full
// or not; and those above which all threads share a node.
TEST(TreeBytes, OfPointsEverywhere) {
  for (const std::size_t n :
       {1u,     15u,    16u,    17u,    40u,    1000u,   11000u,  16340u,  16341u,  16345u,
        32724u, 32725u, 40001u, 65536u, 70003u, 150000u, 150001u, 150002u, 150007u, 600011u})
    expect_flanns(points_of(n, [](const Vec3& u) { return u; }), "in a cube");
}

TEST(TreeBytes, OfPointsOnPlanesLinesAndEachOther) {
  for (const std::size_t n : {100u, 90001u}) {
    expect_flanns(points_of(n, [](const Vec3& u) { return Vec3(u.x, 0.5f, u.z); }), "on a plane");
    expect_flanns(points_of(n, [](const Vec3& u) { return Vec3(0.25f, u.y, 0); }), "on a line");
    expect_flanns(points_of(n, [](const Vec3&) { return Vec3(3, -4, 5); }), "at one place");
    expect_flanns(points_of(n, [](const Vec3& u) { return glm::floor(9.f * u); }), "on a lattice");
    expect_flanns(points_of(n, [](const Vec3& u) { return 1e6f + u; }), "far off");
    expect_flanns(
        points_of(n, [](const Vec3& u) { return u.x < 0.5f ? Vec3(-0.f, u.y, 0) : Vec3(0, u.y, -0.f); }),
        "beside -0 and 0");
    expect_flanns(points_of(n,
                            [](const Vec3& u) {
                              return Vec3(std::exp2(-90 * u.x), std::exp2(60 * u.y - 30),
                                          std::exp2(50 * u.z));
                            }),
                  "crowded towards an edge");
    expect_flanns(points_of(n, [](const Vec3& u) { return 1e17f * (u - 0.5f); }), "wide apart");
    expect_flanns(points_of(n, [](const Vec3& u) { return 1e-38f * (u - 0.5f); }), "near the least floats");
  }
}

}  // namespace
}  // namespace phos
