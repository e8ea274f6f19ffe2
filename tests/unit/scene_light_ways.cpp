// Ways of light by mirrors, panes, curved glass and gloss: which there are, how much of a lamp's light they
// carry, and how well rays from a sensor find it.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "scene/report/light_ways.h"
#include "scene/report/unsampled.h"
#include "support/scenes.h"

namespace phos {
namespace {

Material made(const char* name, Model model) {
  Material m;
  m.name = name, m.model = model;
  m.ks = Rgb(0.9f), m.ior = 1.5f, m.kd = Rgb(1);
  return m;
}

Light point_lamp(const Vec3& at) {
  Light lamp;
  lamp.kind = Light::Kind::point, lamp.name = "bulb";
  lamp.position = at, lamp.intensity = Rgb(100);
  return lamp;
}

/// A grey floor, and beside it a wall of `material` that stands on it.
Scene floor_and(const Material& material) {
  Scene s;
  const std::uint32_t grey = test::add_lambert(s, "grey", 0.5f);
  s.material.push_back(material);
  test::begin_instance(s, "floor", grey);
  test::add_quad(s, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  test::begin_instance(s, "wall", 1);
  test::add_quad(s, {2, 0, -2}, {0, 0, 4}, {0, 3, 0});
  s.light.push_back(point_lamp({0, 1.5f, 0}));
  finalize(s);
  return s;
}

std::vector<LightWay> ways_of(const Scene& s) { return light_ways(RayScene(s), Luminaires(s), true); }

TEST(LightWays, NoneWithoutMirrorsGlassOrSharpGloss) {
  EXPECT_FALSE(sends_light_on(test::cornell()));
  Material broad = made("satin", Model::conductor);
  broad.alpha_x = broad.alpha_y = 0.3f;
  const Scene s = floor_and(broad);
  EXPECT_FALSE(sends_light_on(s));
  EXPECT_TRUE(ways_of(s).empty());
}

TEST(LightWays, MirrorCarriesWhatComesToTheFloorByIt) {
  const Scene s = floor_and(made("mirror wall", Model::mirror));
  const std::vector<LightWay> ways = ways_of(s);
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].lamp, "bulb");
  EXPECT_EQ(ways[0].kind, LightWay::Kind::mirrored);
  EXPECT_EQ(by_text(ways[0]), "mirror \"mirror wall\"");
  EXPECT_EQ(ways[0].hit_share, 0);
  // Light of the image at (4, 1.5, 0) that goes to the floor through the wall: by quadrature.
  double lm = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = -2 + 4 * (i + 0.5) / kSteps, z = -2 + 4 * (j + 0.5) / kSteps;
      const double at_wall = 2 / (4 - x), wall_y = 1.5 * (1 - at_wall), wall_z = z * at_wall;
      if (wall_y < 0 || wall_y > 3 || std::fabs(wall_z) > 2) continue;
      const double d2 = (4 - x) * (4 - x) + 1.5 * 1.5 + z * z;
      lm += 0.9 * 1.5 / (d2 * std::sqrt(d2)) * (16. / kSteps / kSteps);
    }
  const double share = lm / (4 * std::numbers::pi);
  EXPECT_NEAR(ways[0].share, share, 4 * std::sqrt(0.9 * share / kRaysOfALamp));
}

TEST(LightWays, ImagesInFlatMirrorsAreDirectLight) {
  const Scene s = floor_and(made("mirror wall", Model::mirror));
  EXPECT_TRUE(light_ways(RayScene(s), Luminaires(s)).empty());
}

TEST(LightWays, SameForAnyNumberOfThreads) {
  const Scene s = floor_and(made("mirror wall", Model::mirror));
  set_threads(1);
  const std::string one = to_json(ways_of(s)).dump();
  set_threads(4);
  EXPECT_EQ(to_json(ways_of(s)).dump(), one);
  set_threads(0);
}

TEST(LightWays, PaneReflectsAndPassingItIsNoWay) {
  const Scene s = floor_and(made("window", Model::thin_dielectric));
  const std::vector<LightWay> ways = ways_of(s);
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(by_text(ways[0]), "pane \"window\"");
  // A lamp behind the pane comes straight; what the pane reflects leaves the scene.
  Scene behind = floor_and(made("window", Model::thin_dielectric));
  behind.light[0].position = Vec3(3, 2.9f, 0);
  finalize(behind);
  EXPECT_TRUE(ways_of(behind).empty());
}

TEST(LightWays, LampOfAnAreaIsHitByItsSolidAngle) {
  Scene s = floor_and(made("mirror wall", Model::mirror));
  s.light.clear();
  const std::uint32_t glow = test::add_lambert(s, "glow", 0, 1000);
  test::begin_instance(s, "panel", glow);
  test::add_quad(s, {-0.1f, 2, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f});  // down
  finalize(s);
  const std::vector<LightWay> ways = ways_of(s);
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].lamp, "panel");
  // 0.04 m2, 2 to 4 m wide of the image and 2 m below it, both cosines: 0.04 c^2 / (pi d^2), d from 2.8 to 6.
  EXPECT_GT(ways[0].hit_share, 0.04 * 0.1 / (std::numbers::pi * 40));
  EXPECT_LT(ways[0].hit_share, 0.04 * 0.5 / (std::numbers::pi * 8));
  EXPECT_FALSE(samples(Sampler::path_tracing, ways[0], 1000));
  EXPECT_TRUE(samples(Sampler::path_tracing, ways[0], 1e6));
  EXPECT_TRUE(samples(Sampler::photons, ways[0], 1));
  const auto wanted = samples_wanted(ways, Sampler::path_tracing, 1'000'000);
  EXPECT_TRUE(samples(Sampler::path_tracing, ways[0], static_cast<double>(wanted)));
  EXPECT_FALSE(samples(Sampler::path_tracing, ways[0], static_cast<double>(wanted - 1)));
  EXPECT_EQ(samples_wanted(ways, Sampler::path_tracing, 1000), 0);
}

TEST(LightWays, SharpGlossByItsLobe) {
  Material steel = made("steel", Model::conductor);
  steel.alpha_x = steel.alpha_y = 0.02f;
  const Scene s = floor_and(steel);
  const std::vector<LightWay> ways = ways_of(s);
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].kind, LightWay::Kind::gloss);
  EXPECT_EQ(by_text(ways[0]), "gloss of \"steel\"");
  EXPECT_NEAR(ways[0].hit_share, 12 * 0.02 * 0.02, 1e-6);
}

TEST(LightWays, LittleLightCountsForNothing) {
  Scene s;
  const std::uint32_t grey = test::add_lambert(s, "grey", 0.5f);
  s.material.push_back(made("screw", Model::mirror));
  test::begin_instance(s, "room", grey);
  test::add_room(s, {-2, 0, -2}, {2, 3, 2});
  test::begin_instance(s, "screw", 1);
  test::add_quad(s, {1.99f, 1, 0}, {0, 0, 0.02f}, {0, 0.02f, 0});
  s.light.push_back(point_lamp({0, 1.5f, 0}));
  finalize(s);
  EXPECT_TRUE(sends_light_on(s));
  EXPECT_TRUE(ways_of(s).empty());
}

TEST(LightWays, SurviveTheirJson) {
  const std::vector<LightWay> ways = ways_of(floor_and(made("mirror wall", Model::mirror)));
  const std::vector<LightWay> read = light_ways_from(to_json(ways));
  EXPECT_EQ(to_json(read).dump(), to_json(ways).dump());
  EXPECT_TRUE(light_ways_from(Json("nonsense")).empty());
}

TEST(Unsampled, TellsLampWayAndCount) {
  LightWay way{"sun", LightWay::Kind::mirrored, {"wall"}, {"mirror \"wall\""}, 0.1, 0};
  const std::string none = unsampled_line(way, Sampler::path_tracing, 1000);
  EXPECT_NE(none.find("lamp \"sun\" reaches surfaces by way of mirror \"wall\", which path tracing does not "
                      "sample here; stderr is not stated"),
            std::string::npos)
      << none;
  way.hit_share = 1e-3;
  EXPECT_NE(unsampled_line(way, Sampler::gathering, 1000)
                .find("would hit 1 times, and 10 are wanted: 10000 samples"),
            std::string::npos)
      << unsampled_line(way, Sampler::gathering, 1000);
}

/// Ways of one lamp and kind are one: what is worst of both, and all their materials.
TEST(Unsampled, TwoListsAreUnited) {
  using Kind = LightWay::Kind;
  const LightWay sun{"sun", Kind::bent, {"ball"}, {"curved glass \"ball\""}, 0.1, 0.02},
      other{"sun", Kind::bent, {"ball", "lens"}, {"curved glass \"ball\"", "curved glass \"lens\""},
            0.2,   0.03},
      mirrored{"sun", Kind::mirrored, {"wall"}, {"mirror \"wall\""}, 0.1, 0},
      bulb{"bulb", Kind::bent, {"ball"}, {"curved glass \"ball\""}, 0.3, 0.01};
  const std::vector<LightWay> all = united({sun, mirrored}, {bulb, other});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].lamp, "sun");
  EXPECT_EQ(all[0].materials, other.materials);
  EXPECT_EQ(all[0].by, other.by);
  EXPECT_EQ(all[0].share, 0.2);
  EXPECT_EQ(all[0].hit_share, 0.02);
  EXPECT_EQ(all[1].kind, Kind::mirrored);
  EXPECT_EQ(all[2].lamp, "bulb");
  EXPECT_EQ(to_json(united({}, all)).dump(), to_json(all).dump());
  EXPECT_EQ(to_json(united(all, {})).dump(), to_json(all).dump());
}

TEST(Unsampled, NotedInAFileOnlyWhereThereIsAny) {
  Provenance p;
  note_unsampled(p, {});
  EXPECT_TRUE(p.extra.is_null());
  note_unsampled(p, {{"sun", LightWay::Kind::bent, {"ball"}, {"curved glass \"ball\""}, 0.1, 0}});
  ASSERT_EQ(unsampled_in(p).size(), 1u);
  EXPECT_EQ(unsampled_in(p)[0].kind, LightWay::Kind::bent);
}

}  // namespace
}  // namespace phos
