// Measured luminaires, from the command line of every stage to the picture.
#include <gtest/gtest.h>

#include <cmath>

#include "file/json_parse.h"
#include "image/image.h"
#include "support/refused.h"

namespace phos::test {
namespace {

double mean_luminance(const Image& image, const std::string& layer) {
  double sum = 0;
  for (const Rgb& c : image.rgb(layer)) sum += static_cast<double>(luminance(c));
  return sum / static_cast<double>(image.pixels());
}

Json scene_json(std::vector<std::string> words) {
  words.insert(words.begin(), "scene");
  words.push_back("--json");
  const test::Run run = run_tool(words);
  EXPECT_EQ(run.code, 0) << run.err;
  return parse_json(run.out, "output");
}

const Json* light_named(const Json& scene, const std::string& name) {
  for (const Json& light : scene.find("lights")->as_array())
    if (light.find("name")->as_string() == name) return &light;
  return nullptr;
}

TEST(LuminaireTools, TellWhatALuminaireDoes) {
  const test::Run run = run_tool({"scene", data("luminaires/spot.ies")});
  EXPECT_EQ(run.code, 0) << run.err;
  for (const char* word :
       {"LM-63-2019, type C, absolute photometry", "945.1 lm", "maximum 4120 cd at C 0, gamma 0 deg",
        "beam angle (half of the maximum): C0-C180 24.4", "disc 0.1 m across"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  const Json j = scene_json({data("luminaires/pendant.ldt")});
  EXPECT_NEAR(j.find("lumens")->as_number(), 3297.4, 0.5);
  EXPECT_NEAR(j.find("light_output_ratio")->as_number(), 0.8244, 1e-3);
  const std::string f = scratch("luminaire-bad");
  spill(f + "/cut.ies", slurp(data("luminaires/spot.ies")).substr(0, 300));
  expect_refused("scene", {f + "/cut.ies"}, 3, "cut.ies:14: ends before");
}

TEST(LuminaireTools, DrawThePolarPlot) {
  const std::string f = scratch("goniometric");
  for (const char* name : {"spot.ies", "street.ies", "flood.ies", "pendant.ldt"}) {
    const std::string file = data(std::string("luminaires/") + name);
    const test::Run png = run_tool({"picture", "--goniometric", file, "-o", f + "/a.png"});
    EXPECT_EQ(png.code, 0) << png.err;
    EXPECT_EQ(png.err, "") << "no warnings";
    EXPECT_EQ(read_png(f + "/a.png").width, 1440);
    ASSERT_EQ(run_tool({"picture", "--goniometric", file, "-o", f + "/a.svg"}).code, 0);
    EXPECT_NE(slurp(f + "/a.svg").find("<svg"), std::string::npos);
  }
  for (const auto& [option, value, what] :
       {std::tuple("--layer", "direct", "is for images"), std::tuple("--max", "3", "is for images"),
        std::tuple("--x", "a", "is for tables"), std::tuple("--frames", "0:3", "is for sequences"),
        std::tuple("--fps", "25", "is for sequences")})
    expect_refused("picture",
                   {"--goniometric", data("luminaires/spot.ies"), option, value, "-o", f + "/b.png"}, 2,
                   what);
  expect_refused("scene", {data("luminaires/spot.ies"), "--frame", "3"}, 2, "is for scenes");
  expect_refused("scene", {data("luminaires/spot.ies"), "--sky", "overcast"}, 2, "is for scenes");
  expect_refused("picture", {data("luminaires/spot.ies"), "-o", f + "/b.png"}, 2, "pass --goniometric");
  expect_refused("picture", {"--goniometric", data("sky.hdr"), "-o", f + "/b.png"}, 3, "neither an IES");
  expect_refused("picture", {"--goniometric", data("luminaires/spot.ies"), "-o", f + "/b.hdr"}, 2,
                 "polar plot");
  EXPECT_FALSE(std::filesystem::exists(f + "/b.png"));
}

TEST(LuminaireTools, ScenesHaveTheFilesLumens) {
  const Json j = scene_json({data("luminaires.gltf")});
  const Json *pendant = light_named(j, "pendant"), *spot = light_named(j, "spot");
  ASSERT_TRUE(pendant && spot);
  EXPECT_EQ(pendant->find("kind")->as_string(), "area");
  EXPECT_NEAR(pendant->find("lumens")->as_number(), 3297.4, 0.5);
  // multiplier 1.5, colour 1 0.85 0.7: luminance 0.87106.
  EXPECT_NEAR(spot->find("lumens")->as_number(), 945.1 * 1.5 * 0.87106, 1);
  EXPECT_LT(spot->find("down")->as_array()[1].as_number(), -0.9999) << "the node's -z";
  const Json points = scene_json({data("luminaires.gltf"), "--luminaires-as", "points"});
  EXPECT_EQ(light_named(points, "pendant")->find("kind")->as_string(), "measured");
  EXPECT_NE(points.find("hash")->as_string(), j.find("hash")->as_string());
}

TEST(LuminaireTools, GiveLightsByName) {
  const std::string scene = data("luminaires.gltf"), street = data("luminaires/street.ies");
  const Json before = scene_json({scene}), after = scene_json({scene, "--luminaire", "lamp=" + street}),
             other = scene_json(
                 {scene, "--luminaire", "pendant=" + street + ",lamp=" + data("luminaires/flood.ies")});
  EXPECT_NE(before.find("hash")->as_string(), after.find("hash")->as_string());
  const double lumens = scene_json({street}).find("lumens")->as_number();
  EXPECT_NEAR(light_named(after, "lamp")->find("lumens")->as_number(), lumens, 1e-3 * lumens);
  EXPECT_NEAR(light_named(other, "pendant")->find("lumens")->as_number(), lumens, 1e-3 * lumens);
  EXPECT_LT(light_named(after, "lamp")->find("down")->as_array()[1].as_number(), -0.9999)
      << "point lights hang down";
  expect_refused("scene", {scene, "--luminaire", "bulb=" + street}, 2,
                 "no point, spot or IES light \"bulb\"; the scene has \"lamp\", \"pendant\", \"spot\"");
  expect_refused("scene", {scene, "--luminaire", street}, 2, "NAME=FILE");
  expect_refused("scene", {scene, "--luminaire", "lamp=nowhere.ies"}, 3, "nowhere.ies");
}

/// Decimal commas are common in names of lamps.
TEST(LuminaireTools, NamesAndFilesWithCommas) {
  const std::string f = scratch("luminaire-commas"), lamp = "Downlight 3,5 W", file = f + "/iso 3,5W.ies";
  std::filesystem::create_directory(f + "/luminaires");
  for (const char* name : {"pendant.ldt", "spot.ies"})
    spill(f + "/luminaires/" + name, slurp(data(std::string("luminaires/") + name)));
  std::string scene = slurp(data("luminaires.gltf"));
  for (std::size_t at = 0; (at = scene.find("\"lamp\"", at)) != std::string::npos; at += lamp.size())
    scene.replace(at, 6, "\"" + lamp + "\"");
  spill(f + "/room.gltf", scene);
  spill(file, slurp(data("luminaires/street.ies")));
  const double lumens = scene_json({file}).find("lumens")->as_number();
  for (const std::string& word : {lamp + "=" + file, "Downlight 3\\,5 W=" + file,
                                  "pendant=" + data("luminaires/flood.ies") + "," + lamp + "=" + file}) {
    const Json j = scene_json({f + "/room.gltf", "--luminaire", word});
    EXPECT_NEAR(light_named(j, lamp.c_str())->find("lumens")->as_number(), lumens, 1e-3 * lumens) << word;
  }
  expect_refused("scene", {f + "/room.gltf", "--luminaire", "downlight 3,5 W=" + file}, 2,
                 "no point, spot or IES light \"downlight 3,5 W\"");
}

/// The picture of the caches agrees with path tracing, and with a cache of another distribution nothing is
/// drawn.
TEST(LuminaireTools, AgreeWithTheReference) {
  const std::string f = scratch("luminaires"), scene = data("luminaires.gltf");
  const std::vector<std::string> lit = {"--luminaire", "lamp=" + data("luminaires/flood.ies")};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), lit.begin(), lit.end());
    const test::Run done = run_tool(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
  };
  run({"photons", scene, "--photons", "200000", "-o", f + "/a.photons"});
  run({"irradiance", scene, f + "/a.photons", "--estimate", "gather", "--rays", "512", "--width", "48", "-o",
       f + "/a.irradiance"});
  run({"splat", scene, f + "/a.irradiance", "--width", "48", "--light-samples", "64", "-o", f + "/a.exr"});
  run({"reference", scene, "--width", "48", "--samples", "256", "-o", f + "/r.exr"});
  const Image a = read_image(f + "/a.exr"), r = read_image(f + "/r.exr");
  // One sample to a pixel sees small openings roughly.
  for (const auto& [layer, within] : {std::pair{"direct", 0.02}, {"indirect", 0.06}, {"emission", 0.1}}) {
    const double expected = mean_luminance(r, layer);
    EXPECT_GT(expected, 0) << layer;
    EXPECT_NEAR(mean_luminance(a, layer), expected, within * expected) << layer;
  }
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    words.insert(words.begin(), {scene, f + "/a.irradiance", "-o", f + "/no.exr"});
    expect_refused("splat", words, 4, why);
  };
  refused({}, "was made with --luminaire lamp=FILE, and files are not recorded; give the same --luminaire");
  refused({"--luminaire", "lamp=" + data("luminaires/street.ies")}, "another --luminaire");
  EXPECT_FALSE(std::filesystem::exists(f + "/no.exr"));
}

}  // namespace
}  // namespace phos::test
