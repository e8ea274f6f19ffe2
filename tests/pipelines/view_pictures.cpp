// Pictures of the page of phos-view against those of phos-splat: gloss, panes, mirrors, a large scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "image/image.h"
#include "support/browser.h"
#include "support/run.h"
#include "support/shiny_room.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

enum class Quantity : int { luminance = 0, illuminance = 1, indirect = 2, gloss = 4 };

struct Pixels {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Root mean square of the difference over the mean of b where `counts` holds, but for the share of pixels
/// that differ most: at edges a pixel's middle falls on one surface or on another.
double difference(
    const Pixels& a, const Pixels& b, double edges,
    const std::function<bool(int, int)>& counts = [](int, int) { return true; }) {
  EXPECT_EQ(a.values.size(), b.values.size());
  if (a.values.size() != b.values.size()) return 1e9;
  std::vector<double> square;
  double mean = 0;
  for (int y = 0; y < b.height; ++y)
    for (int x = 0; x < b.width; ++x) {
      if (!counts(x, y)) continue;
      const auto i = static_cast<std::size_t>(y * b.width + x);
      const double v = static_cast<double>(b.values[i]), d = static_cast<double>(a.values[i]) - v;
      square.push_back(d * d), mean += v;
    }
  std::sort(square.begin(), square.end());
  mean /= static_cast<double>(square.size());
  square.resize(static_cast<std::size_t>((1 - edges) * static_cast<double>(square.size())));
  double sum = 0;
  for (const double s : square) sum += s;
  EXPECT_GT(mean, 0);
  return std::sqrt(sum / static_cast<double>(square.size())) / mean;
}

class Pictures : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_chromium())
      GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
    folder_ = scratch("view-pictures");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  void make(const std::vector<std::string>& command) const {
    const test::Run run = run_tool(command);
    ASSERT_EQ(run.code, 0) << run.err;
  }
  /// A quantity that the page draws.
  Pixels shown(const std::vector<std::string>& inputs, Quantity quantity, int width, int height) const {
    const ViewProgram view(inputs);
    EXPECT_NE(view.port(), 0u);
    const Shown page =
        open_page(view.url() + "?width=" + std::to_string(width) + "&height=" + std::to_string(height) +
                  "&dump=" + std::to_string(static_cast<int>(quantity)));
    EXPECT_EQ(page.console, "");
    return {width, height, values_of(page)};
  }
  /// A layer of phos-splat, its luminance where it has colours.
  Pixels splatted(std::vector<std::string> arguments, const std::string& layer, int width, int height) const {
    arguments.insert(arguments.begin(), "splat");
    arguments.insert(arguments.end(), {"--width", std::to_string(width), "--height", std::to_string(height),
                                       "--pixel-samples", "1", "-o", file("splat.exr")});
    const test::Run run = run_tool(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    const Image image = read_image(file("splat.exr"));
    Pixels pixels{width, height, {}};
    if (layer == "illuminance") {
      const auto lux = image.channel("illuminance.Y");
      pixels.values.assign(lux.begin(), lux.end());
      return pixels;
    }
    const auto r = image.channel(layer + "R"), g = image.channel(layer + "G"), b = image.channel(layer + "B");
    for (std::size_t i = 0; i < r.size(); ++i) pixels.values.push_back(luminance(Rgb(r[i], g[i], b[i])));
    return pixels;
  }
  /// Photons and records of a scene at file(NAME.glb).
  std::string records_of(const std::string& name, const std::vector<std::string>& options = {}) const {
    make({"photons", file(name + ".glb"), "--photons", "60000", "-o", file(name + ".photons")});
    std::vector<std::string> command = {
        "irradiance", file(name + ".glb"),       file(name + ".photons"), "--place", "surface",
        "-o",         file(name + ".irradiance")};
    command.insert(command.end(), options.begin(), options.end());
    make(command);
    return file(name + ".irradiance");
  }

  std::string folder_;
};

TEST_F(Pictures, GlossIsThatOfTheRadianceRecords) {
  const std::string scene = data("cornell-glossy22.glb");
  make({"photons", scene, "--photons", "60000", "-o", file("photons")});
  make({"brdf", scene, "-o", file("brdf")});
  make({"radiance", scene, file("photons"), file("brdf"), "--place", "view", "--width", "64", "-o",
        file("radiance")});
  make({"irradiance", scene, file("photons"), file("radiance"), "-o", file("irradiance")});
  const std::vector<std::string> inputs = {scene, file("irradiance"), file("radiance"), file("brdf")};
  std::vector<std::string> indirect = inputs;
  indirect.insert(indirect.end(), {"--direct", "none"});
  const double off =
      difference(shown(inputs, Quantity::gloss, 96, 96), splatted(indirect, "glossy.", 96, 96), 0.005);
  std::printf("[ FIGURES  ] gloss: %.5f\n", off);
  EXPECT_LT(off, 0.01);
}

/// The wall behind a tinted pane, which lamps light through the pane.
TEST_F(Pictures, PanesTakeTheirShareOfTheLightOfLamps) {
  const std::string scene = shiny_room(file("room.glb"), {.pane = true}), cache = records_of("room");
  const auto back_wall = [](int x, int y) { return x > 36 && x < 78 && y > 38 && y < 60; };
  const Pixels page = shown({scene, cache}, Quantity::luminance, 128, 128),
               splat = splatted({scene, cache, "--direct", "traced"}, "", 128, 128);
  const double off = difference(page, splat, 0.02, back_wall);
  std::printf("[ FIGURES  ] behind a pane: %.5f\n", off);
  EXPECT_LT(off, 0.01);
}

/// Records hold all light here: the page draws no light of lamps that comes by way of mirrors.
TEST_F(Pictures, MirrorsShowTheRoom) {
  const std::string scene = shiny_room(file("room.glb"), {.pane = true, .mirror = true, .ball = true});
  const std::string cache = records_of("room", {"--paths", "all"});
  const double off = difference(shown({scene, cache}, Quantity::luminance, 128, 128),
                                splatted({scene, cache}, "", 128, 128), 0.02);
  std::printf("[ FIGURES  ] mirrors: %.5f\n", off);
  EXPECT_LT(off, 0.02);
}

TEST_F(Pictures, SponzaIsThatOfSplat) {
  const std::string scene = shared("scenes/sponza.glb");
  if (scene.empty()) GTEST_SKIP() << "../shared/scenes/sponza.glb is not there";
  make({"photons", scene, "--photons", "100000", "-o", file("photons")});
  make({"irradiance", scene, file("photons"), "--place", "view", "--width", "96", "-o", file("irradiance")});
  const double off =
      difference(shown({scene, file("irradiance")}, Quantity::indirect, 160, 90),
                 splatted({scene, file("irradiance"), "--direct", "none"}, "illuminance", 160, 90), 0.02);
  std::printf("[ FIGURES  ] Sponza: %.5f\n", off);
  EXPECT_LT(off, 0.01);
}

}  // namespace
}  // namespace phos::test
