// Dimming, wipe, isolux lines and times of frames: the picture in a browser changes as arithmetic says.
#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <map>

#include "core/json.h"
#include "file/json_parse.h"
#include "support/browser.h"
#include "support/lamp_groups.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

constexpr std::size_t kWide = 64, kHigh = 48;

/// A set of two groups, and a set without names to compare it with.
class Lamps : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_chromium()) return;
    folder_ = scratch("view-lamps");
    groups_ = lamp_groups(folder_);
    std::vector<std::string> words = groups_.named();
    words.insert(words.end(), {"--compare", groups_.cache("all"), "--lamp-places", "4"});
    view_ = std::make_unique<ViewProgram>(words);
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
  static Shown open(const std::string& query) { return open_page(view_->url() + query); }
  /// The values of each query that follows "?width=..&height=..", by all pages at once.
  static std::vector<std::vector<float>> dumps(const std::vector<std::string>& queries) {
    std::vector<std::future<std::vector<float>>> pages;
    for (std::size_t i = 0; i < queries.size(); ++i)
      pages.push_back(std::async(std::launch::async, [&, i] {
        const Shown shown =
            open("?width=" + std::to_string(kWide) + "&height=" + std::to_string(kHigh) + "&" + queries[i]);
        EXPECT_EQ(shown.console, "") << queries[i];
        return values_of(shown);
      }));
    std::vector<std::vector<float>> values;
    for (auto& page : pages) {
      values.push_back(page.get());
      EXPECT_EQ(values.back().size(), kWide * kHigh);
      values.back().resize(kWide * kHigh);
    }
    return values;
  }

  static std::string folder_;
  static LampGroups groups_;
  static std::unique_ptr<ViewProgram> view_;
};
std::string Lamps::folder_;
LampGroups Lamps::groups_;
std::unique_ptr<ViewProgram> Lamps::view_;

float greatest(const std::vector<float>& values) { return *std::max_element(values.begin(), values.end()); }

TEST_F(Lamps, AddUpWithTheirWeights) {
  // Luminance holds all that a picture adds up: records, direct light and emission.
  const std::string of = "dump=0&wipe=1";
  const auto v =
      dumps({of + "&weight=right:0", of + "&weight=left:0", of + "&weight=left:0.5&weight=right:0.25",
             of + "&weight=left:0.5&weight=right:0.5", of});
  const float rounding = 1e-6f * greatest(v[4]);
  EXPECT_GT(rounding, 0);
  for (std::size_t i = 0; i < v[0].size(); ++i) {
    ASSERT_NEAR(v[2][i], 0.5f * v[0][i] + 0.25f * v[1][i], rounding) << i;
    ASSERT_NEAR(v[4][i], v[0][i] + v[1][i], rounding) << i;
    ASSERT_NEAR(v[3][i], 0.5f * v[4][i], rounding) << i;
  }
  EXPECT_NE(v[0], v[1]);
}

TEST_F(Lamps, WipeShowsASetOnEachSide) {
  const auto v = dumps({"dump=1&wipe=1", "dump=1&wipe=0", "dump=1&wipe=0.25", "dump=1&wipe=0&weight=:0.5"});
  std::size_t other = 0;
  for (std::size_t i = 0; i < v[0].size(); ++i) {
    ASSERT_EQ(v[2][i], v[i % kWide < kWide / 4 ? 0 : 1][i]) << i;
    ASSERT_EQ(2 * v[3][i], v[1][i]) << i;
    other += v[0][i] != v[1][i];
  }
  EXPECT_GT(other, v[0].size() / 2);
}

TEST_F(Lamps, IsoluxLinesStandWhereASteppingOfLuxIs) {
  constexpr float kStep = 40;
  const auto v = dumps({"dump=1&wipe=1", "dump=isolux&step=40&wipe=1"});
  const auto level = [&](std::size_t i) { return std::floor(v[0][i] / kStep); };
  std::size_t lines = 0, steps = 0;
  for (std::size_t i = kWide; i < v[0].size(); ++i) {  // from the top: the row above is the one before
    const bool step = (i % kWide + 1 < kWide && level(i) != level(i + 1)) || level(i) != level(i - kWide);
    steps += step;
    if (v[1][i] < 0.5f) continue;
    ++lines;
    EXPECT_TRUE(step) << i;
  }
  EXPECT_GT(lines, 50u);
  EXPECT_GT(3 * lines, steps);  // the others are edges of surfaces
}

TEST_F(Lamps, UnknownGroupIsNamedWithTheLikest) {
  const Shown shown = open("?weight=lefd:0.5");
  EXPECT_NE(shown.page.find("there is no group \"lefd\"; did you mean \"left\"?"), std::string::npos);
}

TEST_F(Lamps, FramesAreTimed) {
  const Shown shown = open("?bench=5&width=64&height=48");
  EXPECT_EQ(shown.console, "");
  const Json times = parse_json(words_of(shown, "bench"), "bench");
  ASSERT_NE(times.find("frames"), nullptr);
  EXPECT_EQ(times.find("frames")->as_integer(), 5);
  for (const char* name : {"frames_per_second", "ms", "width", "height"})
    EXPECT_NE(times.find(name), nullptr) << name;
}

}  // namespace
}  // namespace phos::test
