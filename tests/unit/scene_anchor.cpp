// Places that go with their triangles.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/motion/anchor.h"
#include "scene/motion/film.h"
#include "support/animated.h"
#include "support/scenes.h"

namespace phos {
namespace {

using test::Animated;

Scene one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Scene s;
  s.position = {a, b, c};
  s.triangle = {{{0, 1, 2}}}, s.triangle_instance = {0};
  s.instance.resize(1), s.instance[0].triangle_count = 1;
  s.material.resize(1);
  finalize(s);
  return s;
}

void expect_near(const Vec3& a, const Vec3& b, float most) {
  EXPECT_LE(glm::distance(a, b), most) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Anchor, PoseOfATriangle) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    const Scene s = one_triangle(scale * Vec3(1, 2, 3), scale * Vec3(1, 2, 5), scale * Vec3(4, 2, 3));
    const std::optional<Pose> pose = pose_of(s, {0, 0.25f, 0.5f});
    ASSERT_TRUE(pose);
    expect_near(pose->position / scale, Vec3(2.5f, 2, 3.5f), 1e-6f);
    expect_near(pose->turn * Vec3(1, 0, 0), Vec3(0, 0, 1), 1e-6f);
    expect_near(pose->turn * Vec3(0, 0, 1), Vec3(0, 1, 0), 1e-6f);
    expect_near(pose->turn * Vec3(0, 1, 0), Vec3(1, 0, 0), 1e-6f);
    EXPECT_NEAR(glm::length(pose->turn), 1, 1e-6f);
  }
}

TEST(Anchor, IsNowhereWithoutArea) {
  const Vec3 a(1, 2, 3), b(2, 3, 4);
  for (const Vec3& c : {a, b, 0.5f * (a + b), 2.f * b - a}) EXPECT_FALSE(pose_of(one_triangle(a, b, c), {0}));
  EXPECT_FALSE(pose_of(one_triangle(a, a, a), {0}));
  const Scene s = one_triangle(a, b, Vec3(0));
  EXPECT_TRUE(pose_of(s, {0}));
  EXPECT_FALSE(pose_of(s, {1}));
  EXPECT_FALSE(pose_of(s, Anchor()));
}

/// The pose of a surface that a rigid movement takes elsewhere is taken there too.
TEST(Anchor, TurnsWithItsSurface) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(1, Stage::test, i);
    const auto vector = [&] {
      return Vec3(random.uniform(), random.uniform(), random.uniform()) * 2.f - 1.f;
    };
    const Vec3 corner[3] = {vector(), vector(), vector()}, shift = 3.f * vector();
    const float angle = 6.3f * random.uniform();
    const Mat3 turn(glm::rotate(Mat4(1), angle, sample_uniform_sphere(random.uniform2())));
    const auto there = [&](const Vec3& p) { return turn * p + shift; };
    const Scene before = one_triangle(corner[0], corner[1], corner[2]),
                after = one_triangle(there(corner[0]), there(corner[1]), there(corner[2]));
    const Vec2 uv = sample_triangle(random.uniform2());
    const std::optional<Pose> from = pose_of(before, {0, uv.x, uv.y}), to = pose_of(after, {0, uv.x, uv.y});
    ASSERT_TRUE(from && to);
    expect_near(to->position, there(from->position), 2e-6f);
    const float sliver = 1 / area_m2(before, 0);  // the rounding of its corners turns it by as much
    const Vec3 v = vector();
    expect_near(turned(*from, *to, v), turn * v, 2e-6f * std::max(1.f, sliver));
  }
}

/// A block about the y axis at every frame: the movement of its vertices is that of its places.
TEST(Anchor, GoesWithAnAnimation) {
  Animated g;
  g.slab("floor", 4, 0, 0, 0);
  const float h = std::sqrt(0.5f);
  g.animate(g.slab("block", 1, 0, 1, 0), "rotation", {0, 8}, {0, 0, 0, 1, 0, h, 0, h});
  const std::string path = g.write("anchor_spin", 9);
  const Scene start = load_frame(path, {}, 0);
  const RayScene rays(start);
  const Vec3 p(0.3f, 1, 0.2f), up(0, 1, 0), along(1, 2, 3);
  const Anchor anchor = anchor_at(rays, p, up);
  const std::optional<Pose> from = pose_of(start, anchor);
  ASSERT_TRUE(from);
  for (int f = 0; f <= 8; ++f) {
    const std::optional<Pose> to = pose_of(load_frame(path, {}, f), anchor);
    ASSERT_TRUE(to);
    const Mat3 turn(glm::rotate(Mat4(1), static_cast<float>(f) / 8 * kPi / 2, up));
    expect_near(to->position, turn * p, 1e-6f);
    expect_near(turned(*from, *to, along), turn * along, 4e-6f);
  }
}

void scale_scene(Scene& s, float scale) {
  for (Vec3& p : s.position) p *= scale;
  finalize(s);
}

/// Every place that a ray finds is found again, from the side it is seen and from behind.
TEST(Anchor, FindsWhatRaysSee) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    Scene s = test::cornell();
    scale_scene(s, scale);
    const RayScene rays(s);
    const float size = s.bounds.diagonal_m();
    int seen = 0, lost = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      RandomStream random(2, Stage::test, i);
      SurfacePoint p;
      const Vec3 inside =
          s.bounds.lo + s.bounds.size() * Vec3(random.uniform(), random.uniform(), random.uniform());
      if (!trace(rays, {inside, sample_uniform_sphere(random.uniform2())}, p)) continue;
      ++seen;
      for (const Vec3& n : {p.smooth_normal, -p.smooth_normal}) {
        const Anchor anchor = anchor_at(rays, p.position, n);
        const std::optional<Pose> pose = pose_of(s, anchor);
        if (!pose) {
          ++lost;
          continue;
        }
        EXPECT_LE(glm::distance(pose->position, p.position), 1e-5f * size);
        // Beside an edge the neighbour may be the nearer one.
        if (anchor.triangle == p.triangle) continue;
        EXPECT_GT(std::fabs(glm::dot(geometric_normal(s, anchor.triangle), n)), 0.1f);
      }
    }
    EXPECT_GT(seen, 1500);
    EXPECT_EQ(lost, 0) << scale;
  }
}

TEST(Anchor, NothingInTheAir) {
  const Scene s = test::cornell();
  const RayScene rays(s);
  const Vec3 middle = s.bounds.centre();
  SurfacePoint p;
  ASSERT_TRUE(trace(rays, {middle, {0, -1, 0}}, p));
  EXPECT_NE(anchor_at(rays, p.position, p.geometric_normal).triangle, kNoTriangle);
  EXPECT_EQ(anchor_at(rays, p.position + 1e-3f * p.geometric_normal, p.geometric_normal).triangle,
            kNoTriangle);
  EXPECT_EQ(anchor_at(rays, middle, {0, 1, 0}).triangle, kNoTriangle);
}

/// Two sheets closer than rounding, back to back: each side's own.
TEST(Anchor, TakesTheSheetThatFacesThePoint) {
  Scene s = one_triangle({-1, 0, -1}, {0, 0, 2}, {1, 0, -1});
  for (const Vec3& p : {Vec3(-1, -1e-7f, -1), Vec3(1, -1e-7f, -1), Vec3(0, -1e-7f, 2)})
    s.position.push_back(p);
  s.normal.clear();
  s.triangle.push_back({{3, 4, 5}}), s.triangle_instance.push_back(0), s.instance[0].triangle_count = 2;
  finalize(s);
  const RayScene rays(s);
  ASSERT_GT(geometric_normal(s, 0).y, 0.9f);
  EXPECT_EQ(anchor_at(rays, {0, 0, 0}, {0, 1, 0}).triangle, 0u);
  EXPECT_EQ(anchor_at(rays, {0, 0, 0}, {0, -1, 0}).triangle, 1u);
}

}  // namespace
}  // namespace phos
