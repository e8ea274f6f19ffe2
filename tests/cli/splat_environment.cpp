// --environment, from the command line of every stage to the picture.
#include <gtest/gtest.h>

#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

/// A sheet on the ground and a screen beside it, a lamp-less OBJ with a camera.
std::string open_scene(const std::string& folder) {
  const std::string path = folder + "/open.obj";
  spill(path,
        "mtllib open.mtl\nusemtl grey\no ground\n"
        "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\nf 1 2 3 4\n"
        "o screen\nv -1 0 -1\nv 1 0 -1\nv 1 1.5 -1\nv -1 1.5 -1\nf 5 6 7 8\n");
  spill(folder + "/open.mtl", "newmtl grey\nKd 0.6 0.6 0.6\n");
  spill(folder + "/open.lights.json",
        R"({"cameras": [{"name": "eye", "eye": [0, 1.2, 4], "target": [0, 0.5, 0], "yfov_deg": 50}]})");
  return path;
}

/// A sky, brighter above, with a small sun; cd/m2.
std::string sky(const std::string& folder, const std::string& name, float strength = 100) {
  constexpr int kHeight = 32;
  Image image(2 * kHeight, kHeight);
  std::vector<Rgb> texels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 2 * kHeight; ++x)
      texels.push_back(x == 40 && y == 8 ? strength * Rgb(200, 180, 140)
                                         : strength * Rgb(0.6f, 0.8f, 1) * (y < kHeight / 2 ? 1.f : 0.2f));
  image.set_rgb("", texels);
  write_exr(folder + "/" + name, image);
  return folder + "/" + name;
}

double mean_luminance(const Image& image, const std::string& layer) {
  double sum = 0;
  for (const Rgb& c : image.rgb(layer)) sum += static_cast<double>(luminance(c));
  return sum / static_cast<double>(image.pixels());
}

}  // namespace

/// The picture of the caches agrees with path tracing: direct light, indirect light, and the sky behind.
TEST(EnvironmentTools, AgreeWithTheReference) {
  const std::string f = scratch("environment"), scene = open_scene(f), map = sky(f, "sky.exr");
  const std::vector<std::string> lit = {"--environment", map, "--environment-rotation", "30"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), lit.begin(), lit.end());
    const auto done = run_tool(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
  };
  run({"photons", scene, "--photons", "200000", "-o", f + "/a.photons"});
  run({"irradiance", scene, f + "/a.photons", "--estimate", "gather", "--rays", "512", "--camera", "eye",
       "--width", "48", "-o", f + "/a.irradiance"});
  run({"splat", scene, f + "/a.irradiance", "--width", "48", "--light-samples", "64", "-o", f + "/a.exr"});
  run({"reference", scene, "--width", "48", "--samples", "256", "-o", f + "/r.exr"});
  const Image a = read_image(f + "/a.exr"), r = read_image(f + "/r.exr");
  for (const char* layer : {"", "direct", "indirect", "emission"}) {
    const double expected = mean_luminance(r, layer);
    EXPECT_GT(expected, 0) << layer;
    EXPECT_NEAR(mean_luminance(a, layer), expected,
                (std::string(layer) == "indirect" ? 0.06 : 0.02) * expected)
        << layer;
  }
}

/// A cache belongs to its environment: none, another map, another turn or another strength is another scene.
TEST(EnvironmentTools, RefuseCachesOfAnotherEnvironment) {
  const std::string f = scratch("environment-other"), scene = open_scene(f), map = sky(f, "sky.exr");
  ASSERT_EQ(
      run_tool({"photons", scene, "--environment", map, "--photons", "1000", "-o", f + "/a.photons"}).code,
      0);
  const auto refused = [&](const std::vector<std::string>& lit, const std::string& why) {
    std::vector<std::string> words = {scene, f + "/a.photons", "-o", f + "/a.irradiance"};
    words.insert(words.end(), lit.begin(), lit.end());
    expect_refused("irradiance", words, 4, why);
  };
  refused({}, "give the same --environment");
  refused({"--environment", sky(f, "other.exr", 101)}, "another --environment");
  refused({"--environment", map, "--environment-rotation", "1"}, "another rotation");
  refused({"--environment", map, "--environment-scale", "1.5"}, "scale");
  EXPECT_EQ(
      run_tool({"irradiance", scene, f + "/a.photons", "--environment", map, "-o", f + "/a.irradiance"}).code,
      0);
  // The same map in another place is the same environment.
  spill(f + "/copy.exr", slurp(map));
  EXPECT_EQ(run_tool({"irradiance", scene, f + "/a.photons", "--environment", f + "/copy.exr", "-o",
                      f + "/b.irradiance"})
                .code,
            0);
  refused({"--sky", "overcast"}, "made under an environment map, not --sky overcast");
  // How the map is turned is the photons'.
  const std::string turned = f + "/turned.photons";
  ASSERT_EQ(run_tool({"photons", scene, "--environment", map, "--environment-rotation", "90", "--photons",
                      "1000", "-o", turned})
                .code,
            0);
  const std::vector<std::string> silent = {"irradiance", scene, turned, "--environment", map, "-o"};
  std::vector<std::string> said = silent, unsaid = silent;
  said.insert(said.end(), {f + "/said.irradiance", "--environment-rotation", "90"});
  unsaid.push_back(f + "/unsaid.irradiance");
  EXPECT_EQ(run_tool(said).code, 0);
  EXPECT_EQ(run_tool(unsaid).code, 0);
  EXPECT_EQ(slurp(f + "/said.irradiance"), slurp(f + "/unsaid.irradiance"));
}

TEST(EnvironmentTools, RefuseWhatIsNoMap) {
  const std::string f = scratch("environment-bad"), scene = open_scene(f), map = sky(f, "sky.exr");
  for (const std::string tool : {"photons", "reference"}) {
    const auto refused = [&](const std::string& file, const std::string& word) {
      expect_refused(tool, {scene, "--environment", file, "-o", f + "/out"}, 3, word);
      EXPECT_FALSE(std::filesystem::exists(f + "/out"));
    };
    refused(f + "/nowhere.exr", "nowhere.exr");
    refused(f, f);
    refused(scene, "open.obj");
    Image image(8, 8);
    image.set_rgb("", std::vector<Rgb>(64, Rgb(1)));
    write_exr(f + "/square.exr", image);
    refused(f + "/square.exr", "twice as wide");
    Image wrong(8, 4);
    std::vector<Rgb> texels(32, Rgb(1));
    texels[9] = Rgb(1, -2, 1);
    wrong.set_rgb("", texels);
    write_exr(f + "/negative.exr", wrong);
    refused(f + "/negative.exr", "column 1, row 1");
    expect_refused(tool, {scene, "--environment-scale", "2", "-o", f + "/out"}, 2, "--environment");
    expect_refused(tool, {scene, "--environment", map, "--environment-scale", "0", "-o", f + "/out"}, 2,
                   "--environment-scale");
    expect_refused(tool, {scene, "--environment", map, "--environment-rotation", "nan", "-o", f + "/out"}, 2,
                   "--environment-rotation");
  }
}

TEST(EnvironmentTools, SceneTellsOfIt) {
  const std::string f = scratch("environment-scene"), scene = open_scene(f), map = sky(f, "sky.exr");
  const auto told = run_tool({"scene", scene, "--environment", map});
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.out.find("environment"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("64 x 32"), std::string::npos) << told.out;
  // All black: no light, and a warning that says so.
  Image black(8, 4);
  black.set_rgb("", std::vector<Rgb>(32, Rgb(0)));
  write_exr(f + "/black.exr", black);
  const auto dark = run_tool({"scene", scene, "--environment", f + "/black.exr"});
  EXPECT_NE(dark.out.find("light \"environment\": has no intensity"), std::string::npos) << dark.out;
  expect_refused("photons", {scene, "--environment", f + "/black.exr", "-o", f + "/out"}, 3, "no light");
}
