// Geo-referenced models: scenes far from the world's origin keep the shape, the light and the bytes that they
// have at home.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/error.h"
#include "core/origin.h"
#include "scene/load.h"
#include "scene/motion/film.h"
#include "scene/point_table.h"
#include "support/far_model.h"
#include "support/limits.h"
#include "support/run.h"

namespace phos::test {
namespace {

Scene load(const std::string& bytes, const std::string& name, const SceneOptions& options = {}) {
  const std::string path = scratch("origin") + "/" + name;
  spill(path, bytes);
  return load_scene(path, options);
}

bool same_bytes(const Scene& a, const Scene& b) {
  return a.position.size() == b.position.size() &&
         std::memcmp(a.position.data(), b.position.data(), a.position.size() * sizeof(Vec3)) == 0 &&
         a.light.size() == 1 && b.light.size() == 1 && a.light[0].position == b.light[0].position &&
         a.camera[0].to_world == b.camera[0].to_world;
}

/// Off by whole steps: the scene is the very same but for where it is, until doubles cannot say its floats.
TEST(Origin, NodesFarAwayGiveTheSameBytes) {
  const Scene home = load(model_at(DVec3(0)), "home.glb");
  EXPECT_EQ(home.origin_m, DVec3(0));
  double last = 0;
  for (int n = 5; n < 60; ++n) {
    const DVec3 site(std::ldexp(1.0, n), -std::ldexp(1.0, n - 1), std::ldexp(3.0, n - 2));
    Scene far;
    try {
      far = load(model_at(site), "far.glb");
    } catch (const Error&) {
      break;  // nothing is left of its triangles
    }
    if (!same_bytes(home, far)) break;
    EXPECT_EQ(far.origin_m, site) << n;
    EXPECT_NE(far.hash, home.hash);
    EXPECT_EQ(far.light[0].flux_lm, home.light[0].flux_lm);
    EXPECT_EQ(far.bounds.diagonal_m(), home.bounds.diagonal_m());
    last = std::ldexp(1.0, n);
  }
  EXPECT_GE(last, 1e6);
  expect_limit({"scene of glTF nodes", "offset from the world's origin, m", 0, last / std::sqrt(2.0), 0,
                "above: doubles of the node matrices round"});
}

/// Off by anything: each coordinate is within the rounding of one at home.
TEST(Origin, AnyOffset) {
  for (const DVec3& site :
       {DVec3(691607.25, 5334760.385, 519.7), DVec3(1e6 / 3, 0.1, -1e6), DVec3(-4e5, 2e7, 1e3)}) {
    const Scene far = load(model_at(site), "far.glb");
    ASSERT_NE(far.origin_m, DVec3(0));
    const DVec3 corner[4] = {{-0.5, 0, -0.5}, {-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}};
    constexpr std::size_t kCorner[6] = {0, 1, 2,
                                        0, 2, 3};  // of its two triangles, with vertices of their own
    ASSERT_EQ(far.position.size(), 12u);
    for (std::size_t i = 0; i < 6; ++i) {
      const DVec3 off = far.origin_m + DVec3(far.position[i]) - (site + corner[kCorner[i]]);
      EXPECT_LT(glm::length(off), 3e-7) << i;  // floats of up to 2 m, and doubles of 2e7 m
    }
    EXPECT_LT(far.bounds.hi.x, 3);
    EXPECT_EQ(origin_in(far.parts), far.origin_m);
  }
}

TEST(Origin, StaysPutThroughAFilm) {
  const DVec3 site(1 << 20, 0, 1 << 21);
  const std::string path = scratch("origin") + "/film.glb";
  spill(path, model_at(site, true));
  const Scene first = load_frame(path, {}, 0), last = load_frame(path, {}, 24);
  EXPECT_EQ(first.origin_m, last.origin_m);
  EXPECT_EQ(first.origin_m, site);
  EXPECT_EQ(last.position[0] - first.position[0], Vec3(0.25f, 0, 0));
}

/// Vertices that hold the offset were rounded when they were written: no new rounding, and a warning.
TEST(Origin, OffsetsInVerticesAreWarnedOf) {
  const DVec3 site(1 << 20, 0, 1 << 21);
  const Scene far = load(model_at(site, false, true), "vertices.glb"),
              home = load(model_at(DVec3(0), false, true), "home.glb");
  EXPECT_EQ(far.origin_m, site);
  EXPECT_TRUE(same_bytes(home, far));  // half metres survive floats of 2^21
  const auto warned = [](const Scene& s) {
    return std::any_of(s.warnings.begin(), s.warnings.end(), [](const Note& w) {
      return w.line().find("put that offset into the node's translation") != std::string::npos;
    });
  };
  EXPECT_TRUE(warned(far));
  EXPECT_FALSE(warned(home));
  EXPECT_FALSE(warned(load(model_at(site), "nodes.glb")));
}

TEST(Origin, ObjKeepsItsDigits) {
  const std::string folder = scratch("origin"), path = folder + "/site.obj";
  spill(path,
        "v 691607.001 519.25 5334760.002\nv 691607.001 519.25 5334761.002\nv 691608.003 519.25 5334760.002\n"
        "f 1 2 3\n");
  spill(folder + "/site.lights.json",
        R"({"lights":[{"kind":"point","position":[691607.5,520.001,5334760.5],"intensity":10}],
            "cameras":[{"eye":[691607.5,522,5334760.5],"target":[691607.5,520,5334760.25]}]})");
  const Scene s = load_scene(path);
  ASSERT_EQ(s.position.size(), 3u);
  EXPECT_NEAR(static_cast<double>(s.position[2].x - s.position[0].x), 1.002, 1e-6);
  const DVec3 lamp = s.origin_m + DVec3(s.light[0].position);
  EXPECT_NEAR(lamp.y, 520.001, 1e-6);
  EXPECT_NEAR(static_cast<double>(s.light[0].position.y - s.position[0].y), 0.751, 1e-6);
  EXPECT_NEAR(s.origin_m.x + static_cast<double>(s.camera[0].to_world[3].x), 691607.5, 1e-6);
}

TEST(Origin, PointsOfTheWorldComeOutAsTheyWentIn) {
  const DVec3 origin(691607, 519, 5334760);
  const PointTable table =
      parse_points("x,y,z,nx,ny,nz\n691607.125,519.7,5334760.002,0,1,0\n", "points.csv", origin);
  EXPECT_NEAR(static_cast<double>(table.position[0].z), 0.002, 1e-9);
  EXPECT_EQ(world_text(origin.x, table.position[0].x), "691607.125");
  EXPECT_EQ(world_text(origin.y, table.position[0].y), "519.7");
  EXPECT_EQ(world_text(0, 0.1f), "0.1");
  for (std::uint32_t i = 1; i < 2000; ++i) {
    const float v =
        std::ldexp(static_cast<float>(i * 2654435761u), -static_cast<int>(i % 60)) * (i % 2 ? 1.f : -1.f);
    const std::string text = world_text(origin.z, v);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    const double lost = std::fabs(origin.z + static_cast<double>(v)) * 0x1p-53;
    EXPECT_NEAR(back - origin.z, static_cast<double>(v), std::fabs(static_cast<double>(v)) * 0x1p-23 + lost)
        << text;
  }
}

TEST(Origin, ScenesNearTheOriginStayAsTheyAre) {
  const auto origin = [](const DVec3& lo, const DVec3& hi) {
    DBounds b;
    b.include(lo), b.include(hi);
    return suitable_origin_m(b);
  };
  EXPECT_EQ(origin(DVec3(0), DVec3(1)), DVec3(0));
  EXPECT_EQ(origin(DVec3(10), DVec3(11)), DVec3(0));
  EXPECT_EQ(origin(DVec3(1000), DVec3(1001)), DVec3(1000));
  const DVec3 tiny = origin(DVec3(1e-3), DVec3(1e-3 + 1e-9));
  EXPECT_NEAR(tiny.x, 1e-3, 2e-9);
  EXPECT_EQ(std::fmod(tiny.x, 0x1p-29), 0) << "whole steps";
  EXPECT_EQ(origin(DVec3(5), DVec3(5)), DVec3(0)) << "a point";
  EXPECT_EQ(suitable_origin_m({}), DVec3(0));
  EXPECT_EQ(origin(DVec3(-1e308), DVec3(1e308)), DVec3(0)) << "no finite diagonal";
}

}  // namespace
}  // namespace phos::test
