// The page of phos-view in a browser without a screen: it says no error, and draws the light that phos-splat
// draws.
#include <gtest/gtest.h>

#include <cmath>
#include <future>

#include "image/image.h"
#include "support/browser.h"
#include "support/run.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

constexpr int kSide = 128;

class Browser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_chromium()) return;
    folder_ = scratch("view-browser");
    const std::string scene = data("cornell-measured.glb");
    EXPECT_EQ(run_tool({"photons", scene, "--photons", "100000", "-o", folder_ + "/box.photons"}).code, 0);
    EXPECT_EQ(run_tool({"irradiance", scene, folder_ + "/box.photons", "--place", "surface", "-o",
                        folder_ + "/box.irradiance"})
                  .code,
              0);
    view_ = std::make_unique<ViewProgram>(std::vector<std::string>{scene, folder_ + "/box.irradiance"});
  }
  static void TearDownTestSuite() {
    view_.reset();
    std::filesystem::remove_all(folder_);
  }
  void SetUp() override {
    if (!has_chromium())
      GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
    ASSERT_NE(view_->port(), 0u);
  }
  static std::vector<float> dump(int quantity) {
    const std::string side = std::to_string(kSide);
    return values_of(
        open_page(view_->url() + "?width=" + side + "&height=" + side + "&dump=" + std::to_string(quantity)));
  }
  /// Lux of phos-splat.
  static std::vector<float> splat(std::vector<std::string> options) {
    std::vector<std::string> all = {"splat",
                                    data("cornell-measured.glb"),
                                    folder_ + "/box.irradiance",
                                    "--width",
                                    std::to_string(kSide),
                                    "--height",
                                    std::to_string(kSide),
                                    "--pixel-samples",
                                    "1",
                                    "-o",
                                    folder_ + "/splat.exr"};
    all.insert(all.end(), options.begin(), options.end());
    const test::Run run = run_tool(all);
    EXPECT_EQ(run.code, 0) << run.err;
    const Image image = read_image(folder_ + "/splat.exr");
    const auto lux = image.channel("illuminance.Y");
    return {lux.begin(), lux.end()};
  }
  /// Root mean square of the difference over the mean, but for the share of pixels that differ most: at edges
  /// a pixel's middle falls on one surface or on another.
  static double difference(const std::vector<float>& a, const std::vector<float>& b, double edges) {
    EXPECT_EQ(a.size(), b.size());
    if (a.size() != b.size()) return 1e9;
    std::vector<double> square;
    double mean = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      square.push_back(d * d), mean += static_cast<double>(b[i]);
    }
    std::sort(square.begin(), square.end());
    const auto kept = static_cast<std::size_t>((1 - edges) * static_cast<double>(square.size()));
    double sum = 0;
    for (std::size_t i = 0; i < kept; ++i) sum += square[i];
    EXPECT_GT(mean, 0);
    return std::sqrt(sum / static_cast<double>(kept)) / (mean / static_cast<double>(a.size()));
  }

  static std::string folder_;
  static std::unique_ptr<ViewProgram> view_;
};
std::string Browser::folder_;
std::unique_ptr<ViewProgram> Browser::view_;

TEST_F(Browser, LoadsWithoutErrors) {
  // Some frames after the last shadow map.
  const Shown shown = open_page(
      view_->url(),
      "new Promise((done) => { let left = 20; const frame = () => {"
      " const said = document.getElementById('state').textContent;"
      " if (said === '') --left;"
      " if (left === 0 || said.includes('cannot be shown')) done(); else requestAnimationFrame(frame);"
      " }; requestAnimationFrame(frame); })");
  EXPECT_EQ(shown.console, "");
  EXPECT_NE(shown.page.find("irradiance records of indirect light"), std::string::npos);
  EXPECT_EQ(shown.page.find("cannot be shown"), std::string::npos);
}

TEST_F(Browser, DrawsTheRecordsAsSplatDoes) {
  const double off = difference(dump(2), splat({"--direct", "none"}), 0.005);
  std::printf("[ FIGURES  ] indirect: %.5f\n", off);
  EXPECT_LT(off, 0.01);
}

TEST_F(Browser, DrawsDirectLightAsShadowMapsDo) {
  const std::vector<float> all = splat({"--direct", "shadow-map", "--light-samples", "16"});
  const double off = difference(dump(1), all, 0.01);
  std::printf("[ FIGURES  ] all light: %.5f\n", off);
  EXPECT_LT(off, 0.02);
}

TEST_F(Browser, TwoAtOnce) {
  auto other = std::async(std::launch::async, [&] { return dump(1); });
  const std::vector<float> values = dump(1);
  EXPECT_EQ(values.size(), static_cast<std::size_t>(kSide * kSide));
  EXPECT_EQ(values, other.get());
}

}  // namespace
}  // namespace phos::test
