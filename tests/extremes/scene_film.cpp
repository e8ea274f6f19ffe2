// Films of every kind of model, at any size, also where all of it vanishes.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/lamp/luminaires.h"
#include "scene/motion/anchor.h"
#include "scene/report/lint.h"
#include "support/animated.h"
#include "support/jumps.h"

namespace phos {
namespace {

using test::Animated;
using test::jumps_of;

void expect_sound(const Scene& s) {
  ASSERT_EQ(s.normal.size(), s.position.size());
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    ASSERT_TRUE(is_finite(s.position[i]));
    ASSERT_NEAR(glm::length(s.normal[i]), 1, 1e-4f);
  }
  EXPECT_FALSE(s.bounds.empty());
  for (const Light& light : s.light) EXPECT_TRUE(is_finite(light.flux_lm));
  for (const Finding& f : lint_scene(s)) EXPECT_EQ(f.message.find("nan"), std::string::npos) << f.message;
}

/// changes() throws where the topology differs.
void expect_one_scene(const std::string& path, std::int64_t most_frames) {
  const Scene first = load_frame(path, {}, 0);
  const std::int64_t step = std::max<std::int64_t>(1, first.frames / most_frames);
  for (std::int64_t f = 0; f < first.frames; f += step) {
    const Scene s = load_frame(path, {}, f);
    expect_sound(s);
    EXPECT_NO_THROW(changes(first, s)) << path << " " << f;
    EXPECT_EQ(load_frame(path, {}, f).hash, s.hash);
  }
}

TEST(FilmExtremes, KhronosModelsKeepTheirTriangles) {
  const std::string folder = test::shared("scenes/conformance/khronos");
  if (folder.empty()) GTEST_SKIP() << "the reference scenes are not beside the project";
  for (const char* name : {"AnimatedTriangle", "AnimatedMorphCube", "InterpolationTest", "RiggedSimple"})
    expect_one_scene(folder + "/" + name + ".glb", 12);
  for (const char* name : {"CesiumMilkTruck", "BrainStem", "AnimatedMorphSphere"})
    expect_one_scene(folder + "/" + name + ".glb", 3);
}

TEST(FilmExtremes, ShippedFilms) {
  for (const char* name : {"cube-in-a-box.glb", "moving-light.glb", "spheres.glb"})
    expect_one_scene(test::data(name), 5);
  const Scene a = load_frame(test::data("cube-in-a-box.glb"), {}, 10),
              b = load_frame(test::data("cube-in-a-box.glb"), {}, 11),
              c = load_frame(test::data("cube-in-a-box.glb"), {}, 12),
              d = load_frame(test::data("cube-in-a-box.glb"), {}, 13);
  EXPECT_TRUE(changes(a, b).anything_moved());
  EXPECT_FALSE(jumps(a, b, c, d));
}

/// Frames beyond either end hold the pose there.
TEST(FilmExtremes, HoldsOutsideTheAnimation) {
  Animated g;
  g.animate(g.slab("block", 1, 0, 1, 0), "translation", {2, 4}, {0, 1, 0, 1, 1, 0});
  const std::string path = g.write("film_outside", 5);
  EXPECT_EQ(load_frame(path, {}, 0).hash, load_frame(path, {}, 2).hash);
  EXPECT_EQ(load_frame(path, {}, 4).hash, load_frame(path, {}, std::int64_t{1} << 30).hash);
}

/// The same film at sizes that differ by 10^12 has the same jumps, anchors and rays.
TEST(FilmExtremes, AnySize) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    Animated g;
    g.slab("floor", 4 * scale, 0, 0, 0);
    const int block = g.slab("block", scale, 0, scale, 0), leaper = g.slab("leaper", scale, 0, 2 * scale, 0),
              lamp = g.lamp("bulb", "point", 9, 0, scale, 0);
    g.animate(block, "translation", {0, 9}, {0, scale, 0, scale, scale, 0});
    g.animate(leaper, "translation", {0, 3}, {0, 2 * scale, 0, scale, 2 * scale, 0}, "STEP");
    g.animate(lamp, "translation", {0, 6}, {0, scale, 0, scale, scale, 0}, "STEP");
    g.animate(leaper, "scale", {0, 8}, {1, 1, 1, 0, 0, 0}, "STEP");
    const std::string path = g.write("film_size", 10);
    EXPECT_EQ(jumps_of(path, 10), (std::vector<std::int64_t>{3, 6, 8})) << scale;
    const Scene from = load_frame(path, {}, 0), to = load_frame(path, {}, 9);
    EXPECT_EQ(changes(from, to).moved, (std::vector<bool>{false, true, true}));
    const RayScene rays(from);
    const Anchor anchor = anchor_at(rays, scale * Vec3(0.2f, 1, 0.1f), {0, 1, 0});
    const std::optional<Pose> pose = pose_of(to, anchor);
    ASSERT_TRUE(pose) << scale;
    EXPECT_LE(glm::distance(pose->position / scale, Vec3(1.2f, 1, 0.1f)), 1e-6f);
  }
}

/// Through zero to a mirrored block, and one that is mirrored always: fronts stay fronts.
TEST(FilmExtremes, MirroredAndNegativeScales) {
  Animated g;
  g.slab("floor", 4, 0, 0, 0);
  const int block = g.slab("block", 1, 0, 1, 0), mirrored = g.slab("mirrored", 1, 0, 2, 0);
  g.animate(block, "scale", {0, 8}, {1, 1, 1, -1, 1, 1});
  g.animate(mirrored, "scale", {0, 8}, {-1, 1, 1, -2, 1, 1});
  const std::string path = g.write("film_mirrored", 9);
  for (int f = 0; f < 9; ++f) {
    const Scene s = load_frame(path, {}, f);
    expect_sound(s);
    ASSERT_EQ(s.triangle.size(), 6u);
    for (std::uint32_t t = 0; t < 6; ++t) {
      const bool gone = f == 4 && s.triangle_instance[t] == 1;
      EXPECT_EQ(geometric_normal(s, t), Vec3(0, gone ? 0 : 1, 0)) << f;
    }
    EXPECT_NO_THROW(changes(load_frame(path, {}, 0), s));
  }
  // Where the block comes to be mirrored, its triangles have other corners.
  EXPECT_EQ(jumps_of(path, 9), std::vector<std::int64_t>{5});
}

/// Flat, as a line and as a point, alone and with what stays; lamps that shrink to nothing.
TEST(FilmExtremes, Collapse) {
  for (const Vec3& end : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 0, 1)}) {
    for (const bool alone : {false, true}) {
      Animated g;
      if (!alone) g.slab("floor", 4, 0, 0, 0);
      const int lamp = g.slab("lamp", 1, 0, 1, 0, Animated::glow(10));
      g.animate(lamp, "scale", {0, 4}, {1, 1, 1, end.x, end.y, end.z});
      const std::string path = g.write("film_collapse", 5);
      const Scene first = load_frame(path, {}, 0), last = load_frame(path, {}, 4);
      expect_sound(last);
      EXPECT_NO_THROW(changes(first, last));
      const bool flat = end == Vec3(1, 0, 1);
      EXPECT_EQ(last.light.size(), flat ? 1u : 0u);
      const RayScene rays(last);
      const Luminaires lights(last);
      SurfacePoint p;
      EXPECT_EQ(trace(rays, {{0.1f, 9, 0.1f}, {0, -1, 0}}, p), flat || !alone);
      EXPECT_EQ(pose_of(last, {alone ? 0u : 2u}).has_value(), flat);
    }
  }
}

/// A morph target that opens a point into a square, and a skin whose joint has no size at the start.
TEST(FilmExtremes, WhatDeformsOutOfNothing) {
  Animated g;
  g.slab("floor", 4, 0, 0, 0);
  Json p, n, target;
  p["attributes"]["POSITION"] = g.vec3(std::vector<float>(12, 0));
  p["indices"] = g.indices({0, 1, 2, 0, 2, 3, 0, 0, 1});
  target["POSITION"] = g.vec3({0, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 0});
  p["targets"] = Json::Array{target};
  n["mesh"] = g.mesh(p), n["name"] = "flower";
  g.animate(g.node(n), "weights", {0, 4}, {0, 1});
  const std::string path = g.write("film_flower", 5);
  for (int f = 0; f < 5; ++f) {
    const Scene s = load_frame(path, {}, f);
    expect_sound(s);
    EXPECT_EQ(s.triangle.size(), 4u);  // that of two corners is none at any time
    EXPECT_EQ(pose_of(s, {2}).has_value(), f > 0);
  }
  EXPECT_EQ(jumps_of(path, 5), std::vector<std::int64_t>());
}

/// Without an animation the triangles without area are left out, as they were.
TEST(FilmExtremes, StillScenesLoseTheirDegenerateTriangles) {
  Animated g;
  g.slab("floor", 4, 0, 0, 0);
  g.slab("dot", 0, 0, 1, 0);
  const Scene still = load_scene(g.write("film_still_dot", 1));
  EXPECT_EQ(still.instance.size(), 1u);
  EXPECT_EQ(still.triangle.size(), 2u);
  EXPECT_EQ(still.events.at("degenerate triangles dropped"), 2u);
}

TEST(FilmExtremes, Ranges) {
  for (const char* bad :
       {"9:3", "a:b", "1:", ":", "", ":3", "-1:2", "1:2:3", "1.5", "0:99999999999999999999", " 1", "0x3"}) {
    try {
      parse_frames(bad);
      FAIL() << bad;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage) << bad;
    }
  }
  const FrameRange one = parse_frames("7"), some = parse_frames("0:47");
  EXPECT_TRUE(one.first == 7 && one.last == 7 && some.first == 0 && some.last == 47);
}

}  // namespace
}  // namespace phos
