// Luminaires in scenes: EXT_lights_ies, names on the command line, openings, hashes, and what is odd about
// them.
#include <gtest/gtest.h>

#include <functional>

#include "scene/motion/film.h"
#include "scene/report/lint.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/luminaires.h"
#include "support/run.h"

namespace phos::test {
namespace {

Json numbers(std::initializer_list<double> values) {
  Json out = Json::Array{};
  for (const double v : values) out.push_back(v);
  return out;
}

struct Parts {
  Json lamp, of_lamp, profile;  ///< the node, its EXT_lights_ies, and the profile that names
};
using Edit = std::function<void(Parts&)>;

/// A floor, and a node "lamp" with a spot.ies 2 m above it, its -z down.
Gltf with_luminaire(const Edit& edit = {}) {
  Gltf g;
  Json primitive, floor;
  primitive["attributes"]["POSITION"] = g.vec3({-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4});
  primitive["indices"] = g.indices({0, 1, 2, 0, 2, 3});
  floor["mesh"] = g.mesh(primitive);
  g.node(floor);
  const std::string ies = slurp(data("luminaires/spot.ies"));
  Parts parts;
  parts.profile["bufferView"] = g.view(std::vector<char>(ies.begin(), ies.end()));
  parts.profile["mimeType"] = "application/x-ies-lm-63";
  parts.lamp["name"] = "lamp";
  parts.lamp["translation"] = numbers({0, 2, 0});
  parts.lamp["rotation"] = numbers({-std::sqrt(0.5), 0, 0, std::sqrt(0.5)});
  parts.of_lamp["light"] = 0;
  if (edit) edit(parts);
  parts.lamp["extensions"]["EXT_lights_ies"] = parts.of_lamp;
  g.json["extensions"]["EXT_lights_ies"]["lights"].push_back(parts.profile);
  g.json["extensionsRequired"] = Json::Array{"EXT_lights_ies"};
  g.node(parts.lamp);
  return g;
}

Scene load(const Gltf& g, const SceneOptions& options = {}) {
  const std::string path = scratch("scene_hanging") + "/scene.glb";
  spill(path, g.bytes());
  return load_scene(path, options);
}

TEST(ExtLightsIes, ShinesDownTheNodesMinusZ) {
  const Scene scene = load(with_luminaire());
  ASSERT_EQ(scene.fitting.size(), 1u);
  const Fitting& lamp = scene.fitting[0];
  EXPECT_LT(glm::length(lamp.down() - Vec3(0, -1, 0)), 1e-6f);
  EXPECT_LT(glm::length(lamp.axes()[0] - Vec3(1, 0, 0)), 1e-6f) << "C0 is the node's x";
  EXPECT_LT(glm::length(lamp.axes()[1] - Vec3(0, 0, -1)), 1e-6f) << "C90 its y";
  EXPECT_NEAR(lamp.intensity_cd({0, -1, 0}).y, 4120, 1);
  ASSERT_EQ(scene.light.size(), 1u);
  EXPECT_EQ(scene.light[0].kind, Light::Kind::area);
  EXPECT_NEAR(scene.light[0].area_m2, kPi * 0.05f * 0.05f, 1e-6f);
  // Slightly below the node, facing down.
  EXPECT_LT(scene.bounds.hi.y, 2);
  EXPECT_GT(scene.bounds.hi.y, 1.999f);
}

TEST(ExtLightsIes, ColourAndMultiplierScaleTheLightAndNodesTheOpening) {
  const Scene scene = load(with_luminaire([](Parts& p) {
    p.of_lamp["multiplier"] = 3, p.of_lamp["color"] = numbers({1, 0.5, 2});  // clamped to 1
    p.lamp["scale"] = numbers({2, 2, 2});
  }));
  const double lm = scene.fitting[0].photometry().flux_lm();
  EXPECT_NEAR(scene.light[0].flux_lm.x, 3 * lm, 0.01);
  EXPECT_NEAR(scene.light[0].flux_lm.y, 1.5 * lm, 0.01);
  EXPECT_NEAR(scene.light[0].flux_lm.z, 3 * lm, 0.01);
  EXPECT_NEAR(scene.light[0].area_m2, kPi * 0.1f * 0.1f, 1e-6f);
}

TEST(ExtLightsIes, TheHashKnowsTheDistribution) {
  Gltf g = with_luminaire();
  const std::string before = load(g).hash;
  EXPECT_EQ(load(g).hash, before);
  const std::size_t at = g.bin.find("4120");
  ASSERT_NE(at, std::string::npos);
  g.bin.replace(at, 4, "4121");
  EXPECT_NE(load(g).hash, before);
}

TEST(ExtLightsIes, BrokenOnesAreOneLine) {
  const auto expect = [](const Gltf& g, const std::string& word) {
    const std::string told = complaint_of([&] { load(g); });
    EXPECT_NE(told.find(word), std::string::npos) << "expected: " << word << "\ntold: " << told;
  };
  struct Case {
    Edit edit;
    const char* word;
  };
  for (const Case& c : {
           Case{[](Parts& p) { p.of_lamp["light"] = 1; }, "names none of the 1 light"},
           {[](Parts& p) { p.of_lamp["light"] = "a"; }, "names none of the 1 light"},
           {[](Parts& p) { p.of_lamp = Json::Object{}; }, "names none of the 1 light"},
           {[](Parts& p) { p.of_lamp["multiplier"] = -1; }, "multiplier must be 0 or more"},
           {[](Parts& p) { p.of_lamp["color"] = 1; }, "color must be three numbers"},
           {[](Parts& p) { p.profile["bufferView"] = 99; }, "bufferView names none of the"},
           {[](Parts& p) { p.profile = Json::Object{}; }, "neither uri nor bufferView"},
           {[](Parts& p) {
              p.profile = Json::Object{{"uri", "nowhere.ies"}};
            },
            "nowhere.ies"},
           {[](Parts& p) {
              p.profile = Json::Object{{"uri", "data:,abc"}};
            },
            "not valid base64"},
       })
    expect(with_luminaire(c.edit), c.word);
  Gltf g = with_luminaire();
  g.bin[g.bin.find("TILT")] = 'X';
  expect(g, "TILT=");
  g.json["extensions"]["EXT_lights_ies"]["lights"] = 3;
  expect(g, "must be an array");
}

TEST(HangingLuminaires, PointsAndSpotsByName) {
  Gltf g = with_luminaire();
  Json point, spot;
  point["type"] = "point", point["color"] = numbers({1, 0.5, 0.25}), point["intensity"] = 7;
  spot["type"] = "spot", spot["spot"]["outerConeAngle"] = 0.5;
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{point, spot};
  for (const int i : {0, 1}) {
    Json node;
    node["name"] = i == 0 ? "bulb" : "beam";
    node["translation"] = numbers({1.0 + i, 1, 0});
    node["extensions"]["KHR_lights_punctual"]["light"] = i;
    g.node(node);
  }
  SceneOptions options;
  options.luminaires.of_lights = {"bulb=" + data("luminaires/flood.ies"),
                                  "beam=" + data("luminaires/spot.ies")};
  options.luminaires.as = LuminairesAs::points;
  const Scene scene = load(g, options);
  ASSERT_EQ(scene.light.size(), 3u);
  const auto light = [&](const std::string& name) {
    for (const Light& l : scene.light)
      if (l.name == name) return l;
    return Light();
  };
  EXPECT_EQ(light("bulb").kind, Light::Kind::measured);
  EXPECT_EQ(light("bulb").position, Vec3(1, 1, 0));
  EXPECT_LT(glm::length(light("bulb").direction - Vec3(0, -1, 0)), 1e-6f) << "hangs down";
  EXPECT_LT(glm::length(light("beam").direction - Vec3(0, 0, -1)), 1e-6f) << "as the spot did";
  // The hue is the light's, the lumens are the file's.
  const Rgb flux = light("bulb").flux_lm;
  EXPECT_NEAR(luminance(flux),
              scene.fitting[static_cast<std::size_t>(light("bulb").fitting)].photometry().flux_lm(), 0.05);
  EXPECT_NEAR(flux.y / flux.x, 0.5, 1e-5);
}

TEST(HangingLuminaires, FilmsSeeThemTurn) {
  const auto scene_at = [](double deg) {
    Scene scene;
    begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
    add_quad(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    const double a = deg * std::numbers::pi / 180;
    // About its own axis: place and direction stay.
    hang_luminaire(scene, luminaire(lopsided()),
                   {"lamp", hanging_down({0, 2, 0}, {std::cos(a), 0, std::sin(a)}, 1), Rgb(1)},
                   LuminairesAs::points);
    finalize(scene);
    return scene;
  };
  EXPECT_FALSE(changes(scene_at(10), scene_at(10)).lights);
  EXPECT_TRUE(changes(scene_at(10), scene_at(11)).lights);
  EXPECT_NE(scene_at(10).hash, scene_at(11).hash);
}

TEST(HangingLuminaires, TheLintAsksAboutThoseThatDoNotFit) {
  const auto finds = [](const Scene& scene, const std::string& code) {
    const std::vector<Finding> all = lint_scene(scene);
    return std::any_of(all.begin(), all.end(), [&](const Finding& f) { return f.code == code; });
  };
  using Form = LuminousOpening::Form;
  const Scene fine = measured_room(luminaire(isotropic(100), {Form::box, {0.6f, 0.6f, 0.1f}}));
  EXPECT_FALSE(finds(fine, "luminaire-too-large") || finds(fine, "luminaire-outside"));
  EXPECT_TRUE(
      finds(measured_room(luminaire(isotropic(100), {Form::box, {6, 0.6f, 0.1f}})), "luminaire-too-large"));
  Scene outside;
  begin_instance(outside, "floor", add_lambert(outside, "grey", 0.5f));
  add_room(outside, Vec3(0), Vec3(3));
  hang(outside, luminaire(isotropic(100), {Form::box, {0.6f, 0.6f, 0.1f}}), {2.9f, 2, 1});
  finalize(outside);
  EXPECT_TRUE(finds(outside, "luminaire-outside"));
}

/// A dark file is no light, and no mistake.
TEST(HangingLuminaires, DarkOnesAreLeftOut) {
  const Scene scene = measured_room(luminaire(isotropic(0), {LuminousOpening::Form::box, {1, 1, 0}}));
  EXPECT_TRUE(scene.light.empty());
  EXPECT_NE(scene.warnings.back().line().find("has no intensity"), std::string::npos);
}

}  // namespace
}  // namespace phos::test
