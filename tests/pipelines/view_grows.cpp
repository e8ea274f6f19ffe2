// A cache grows while browsers look at it: holes fill within 20 frames, for all browsers.
#include <gtest/gtest.h>

#include <future>

#include "support/browser.h"
#include "support/run.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

constexpr int kSide = 128;

/// The share of the pixels in which no record reaches. The box fills the picture but for its margin.
double holes(const std::vector<float>& indirect) {
  constexpr int kMargin = kSide / 32, kInside = kSide - 2 * kMargin;
  EXPECT_EQ(indirect.size(), static_cast<std::size_t>(kSide * kSide));
  if (indirect.size() != static_cast<std::size_t>(kSide * kSide)) return 1;
  int open = 0;
  for (int y = kMargin; y < kSide - kMargin; ++y)
    for (int x = kMargin; x < kSide - kMargin; ++x)
      open += indirect[static_cast<std::size_t>(y * kSide + x)] == 0;
  return static_cast<double>(open) / (kInside * kInside);
}

class GrowingBrowser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_chromium()) return;
    const std::string scene = data("cornell-measured.glb");
    folder_ = scratch("view-grows");
    EXPECT_EQ(run_tool({"photons", scene, "--photons", "100000", "-o", folder_ + "/box.photons"}).code, 0);
    EXPECT_EQ(run_tool({"irradiance", scene, folder_ + "/box.photons", "--place", "photons",
                        "--max-candidates", "8", "-o", folder_ + "/few.irradiance"})
                  .code,
              0);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }
  void SetUp() override {
    if (!has_chromium())
      GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
    view_ = std::make_unique<ViewProgram>(
        std::vector<std::string>{data("cornell-measured.glb"), folder_ + "/few.irradiance",
                                 folder_ + "/box.photons", "--save", folder_ + "/walked.irradiance"});
    ASSERT_NE(view_->port(), 0u);
  }
  /// Indirect illuminance of the picture after so many frames.
  std::vector<float> indirect(int frames) const {
    const std::string side = std::to_string(kSide);
    const Shown shown = open_page(view_->url() + "?width=" + side + "&height=" + side +
                                  "&dump=2&grow=" + std::to_string(frames));
    EXPECT_EQ(shown.console, "");
    EXPECT_EQ(shown.page.find("cannot be shown"), std::string::npos);
    return values_of(shown);
  }

  static std::string folder_;
  std::unique_ptr<ViewProgram> view_;
};
std::string GrowingBrowser::folder_;

TEST_F(GrowingBrowser, HolesFillWithinTwentyFrames) {
  const double before = holes(indirect(0));
  const double after = holes(indirect(20));
  const double later = holes(indirect(0));
  std::printf("[ FIGURES  ] holes before: %.4f, after 20 frames: %.4f, on a new page: %.4f\n", before, after,
              later);
  EXPECT_GT(before, 0.2);
  EXPECT_LT(after, 0.002);
  EXPECT_LT(later, 0.002);
  const test::Run end = view_->end();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(run_tool({"info", folder_ + "/walked.irradiance", "--verify"}).code, 0);
  // All programs read the saved cache: the picture of phos-splat has no holes either.
  const test::Run splat =
      run_tool({"splat", data("cornell-measured.glb"), folder_ + "/walked.irradiance", "--width", "64",
                "--height", "64", "--direct", "none", "-o", folder_ + "/walked.exr"});
  EXPECT_EQ(splat.code, 0) << splat.err;
}

TEST_F(GrowingBrowser, TwoAtOnce) {
  auto other = std::async(std::launch::async, [&] { return indirect(20); });
  const std::vector<float> one = indirect(20);
  EXPECT_LT(holes(one), 0.002);
  EXPECT_LT(holes(other.get()), 0.002);
}

}  // namespace
}  // namespace phos::test
