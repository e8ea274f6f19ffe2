// Neighbour search against brute force, where points tie, coincide, or are few.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/random.h"
#include "photon/tree/kd_tree.h"

namespace phos {
namespace {

std::vector<Vec3> random_points(std::size_t n, float scale_m, std::uint64_t seed) {
  RandomStream random(seed, Stage::test, 0);
  random.start_bounce(0);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) {
    const Vec2 xy = random.uniform2();
    p = scale_m * Vec3(xy.x, xy.y, random.uniform());
  }
  return points;
}

float distance2(const Vec3& a, const Vec3& b) {  // in FLANN's order of operations
  float sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

std::vector<std::uint32_t> brute_sphere(const std::vector<Vec3>& points, const Vec3& p, float radius_m) {
  std::vector<std::uint32_t> rows;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distance2(p, points[i]) <= radius_m * radius_m) rows.push_back(static_cast<std::uint32_t>(i));
  return rows;
}

std::vector<float> brute_nearest(const std::vector<Vec3>& points, const Vec3& p, std::size_t k) {
  std::vector<float> d;
  for (const Vec3& q : points) d.push_back(distance2(p, q));
  std::sort(d.begin(), d.end());
  d.resize(std::min(k, d.size()));
  return d;
}

void expect_as_brute_force(const KdTree& tree, const std::vector<Vec3>& points, const Vec3& p,
                           float radius_m) {
  std::vector<std::uint32_t> rows;
  std::vector<float> d2;
  tree.in_sphere(p, radius_m, rows);
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, brute_sphere(points, p, radius_m)) << "radius " << radius_m;
  for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{400}, points.size() + 3}) {
    tree.nearest(p, k, rows, d2);
    EXPECT_EQ(d2, brute_nearest(points, p, k)) << "k " << k;
    ASSERT_EQ(rows.size(), d2.size());
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(distance2(p, points[rows[i]]), d2[i]);
    std::sort(rows.begin(), rows.end());
    EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end()) << "a row twice";
    tree.nearest(p, k, rows, d2, radius_m);
    std::vector<float> near = brute_nearest(points, p, k);
    near.erase(std::upper_bound(near.begin(), near.end(), radius_m * radius_m), near.end());
    EXPECT_EQ(d2, near) << "k " << k << " within " << radius_m;
  }
}

void expect_all(const std::vector<Vec3>& points, float scale_m) {
  const KdTree tree = KdTree::build(points);
  const std::vector<std::byte> bytes = tree.save();
  const KdTree loaded = KdTree::load(points, bytes, "test");
  for (const Vec3& p : random_points(20, scale_m, 99))
    for (const float r : {0.0f, 0.03f, 0.2f, 5.0f}) {
      expect_as_brute_force(tree, points, p, r * scale_m);
      expect_as_brute_force(loaded, points, p, r * scale_m);
    }
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 10)
    expect_as_brute_force(loaded, points, points[i], 0.1f * scale_m);
}

TEST(KdTree, AgreesWithBruteForceAtEveryScale) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) expect_all(random_points(3000, scale, 1), scale);
}

TEST(KdTree, FewPoints) {
  for (const std::size_t n :
       {std::size_t{1}, std::size_t{2}, std::size_t{31}, std::size_t{32}, std::size_t{33}})
    expect_all(random_points(n, 1, 2), 1);
}

TEST(KdTree, NoPoints) {
  const KdTree tree = KdTree::build({});
  std::vector<std::uint32_t> rows{1};
  std::vector<float> d2{1};
  tree.in_sphere(Vec3(0), 1, rows);
  EXPECT_TRUE(rows.empty());
  tree.nearest(Vec3(0), 5, rows, d2);
  EXPECT_TRUE(rows.empty() && d2.empty());
  EXPECT_TRUE(tree.save().empty());
  KdTree::load({}, {}, "test").in_sphere(Vec3(0), kInfinity, rows);
  EXPECT_TRUE(rows.empty());
}

TEST(KdTree, TiesDuplicatesAndPlanes) {
  std::vector<Vec3> lattice;
  for (int i = 0; i < 1000; ++i)
    lattice.emplace_back(0.1f * static_cast<float>(i % 10), 0.1f * static_cast<float>(i / 10 % 10),
                         0.1f * static_cast<float>(i / 100));
  expect_all(lattice, 1);
  expect_all(std::vector<Vec3>(500, Vec3(0.3f, 0.4f, 0.5f)), 1);
  std::vector<Vec3> plane = random_points(1000, 1, 3), line = plane, offset = plane;
  for (Vec3& p : plane) p.y = 0.5f;
  for (Vec3& p : line) p = Vec3(0.5f, p.y, 0.25f);
  for (Vec3& p : offset) p += 1e6f;
  expect_all(plane, 1);
  expect_all(line, 1);
  expect_all(offset, 1);
}

TEST(KdTree, RadiusIsInclusiveAndZeroFindsCoincident) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 0}, {3, 4, 0}, {3, 4.001f, 0}};
  const KdTree tree = KdTree::build(points);
  std::vector<std::uint32_t> rows;
  tree.in_sphere(Vec3(0), 5, rows);
  EXPECT_EQ(rows.size(), 3u);
  tree.in_sphere(Vec3(0), 0, rows);
  EXPECT_EQ(rows.size(), 2u);
  tree.in_sphere(Vec3(0), -1, rows);
  EXPECT_TRUE(rows.empty());
  tree.in_sphere(Vec3(0), kInfinity, rows);
  EXPECT_EQ(rows.size(), 4u);
  tree.in_sphere(Vec3(std::nanf(""), 0, 0), 1, rows);
  EXPECT_TRUE(rows.empty());
}

TEST(KdTree, SameBytesEveryTime) {
  const std::vector<Vec3> points = random_points(20000, 1, 5);
  const std::vector<std::byte> a = KdTree::build(points).save();
  const std::vector<Vec3> noise = random_points(30000, 7, 6);
  const KdTree other = KdTree::build(noise);  // leaves other bytes in freed memory
  EXPECT_EQ(a, KdTree::build(points).save());
  EXPECT_EQ(a, KdTree::load(points, a, "test").save());
  EXPECT_NE(a, other.save());
}

TEST(KdTree, RefusesWhatItCannotHold) {
  for (const float bad : {std::nanf(""), kInfinity, -kInfinity, 2e18f}) {
    std::vector<Vec3> points = random_points(100, 1, 7);
    points[57].y = bad;
    EXPECT_THROW(KdTree::build(points), Error) << bad;
  }
}

TEST(KdTree, LoadChecksWhatTheTreeIsOver) {
  const std::vector<Vec3> points = random_points(1000, 1, 8);
  const std::vector<std::byte> bytes = KdTree::build(points).save();
  const std::span<const Vec3> all(points);
  EXPECT_THROW(KdTree::load(all.first(999), bytes, "test"), Error);
  EXPECT_THROW(KdTree::load({}, bytes, "test"), Error);
  EXPECT_THROW(KdTree::load(all, {}, "test"), Error);
  EXPECT_THROW(KdTree::load(all, std::span(bytes).first(20), "test"), Error);
  std::vector<std::byte> signature = bytes;
  signature[3] ^= std::byte{1};
  EXPECT_THROW(KdTree::load(all, signature, "test"), Error);
}

}  // namespace
}  // namespace phos
