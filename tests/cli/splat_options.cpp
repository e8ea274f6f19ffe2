// phos-splat's choices of layers, edge samples, records drawn and leak test, as a user meets them.
#include <gtest/gtest.h>

#include "image/image.h"
#include "support/run.h"

namespace phos::test {
namespace {

class SplatOptions : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::string(scratch("cli-splat-options"));
    ASSERT_EQ(run_tool({"photons", data("cornell-measured.glb"), "--photons", "20000", "-o",
                        path("a.photons"), "--quiet"})
                  .code,
              0);
    ASSERT_EQ(run_tool({"irradiance", data("cornell-measured.glb"), path("a.photons"), "-o",
                        path("a.irradiance"), "--quiet"})
                  .code,
              0);
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
  }
  static std::string path(const std::string& name) { return *folder_ + "/" + name; }
  static test::Run splat(const std::vector<std::string>& more) {
    std::vector<std::string> all{"splat",
                                 data("cornell-measured.glb"),
                                 path("a.irradiance"),
                                 "--width",
                                 "64",
                                 "--pixel-samples",
                                 "1",
                                 "--light-samples",
                                 "2",
                                 "--splat",
                                 "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return run_tool(all);
  }
  static std::string* folder_;
};
std::string* SplatOptions::folder_ = nullptr;

TEST_F(SplatOptions, NoiseChoosesTheNumberOfRays) {
  const test::Run both = splat({"--noise", "0.02", "-o", path("no.exr")});
  EXPECT_EQ(both.code, 2);
  EXPECT_TRUE(is_one_line(both.err)) << both.err;
  EXPECT_NE(both.err.find("--light-samples"), std::string::npos) << both.err;
  const test::Run run = run_tool({"splat", data("cornell-measured.glb"), path("a.irradiance"), "--width",
                                  "64", "--splat", "cpu", "--noise", "0.02", "-o", path("noise.exr")});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("shadow rays a pixel and light"), std::string::npos) << run.err;
}

TEST_F(SplatOptions, WritesTheLayersAskedFor) {
  ASSERT_EQ(splat({"--layers", "beauty", "-o", path("beauty.exr"), "--quiet"}).code, 0);
  EXPECT_EQ(read_image(path("beauty.exr")).channels().size(), 3u);
  ASSERT_EQ(splat({"--layers", "beauty,illuminance", "-o", path("two.exr"), "--quiet"}).code, 0);
  const Image two = read_image(path("two.exr"));
  EXPECT_EQ(two.channels().size(), 4u);
  EXPECT_TRUE(two.has("illuminance.Y"));
  const test::Run wrong = splat({"--layers", "beauty,ilumination", "-o", path("no.exr")});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(is_one_line(wrong.err)) << wrong.err;
  EXPECT_NE(wrong.err.find("illuminance"), std::string::npos) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
}

TEST_F(SplatOptions, DrawsRecords) {
  ASSERT_EQ(splat({"-o", path("plain.exr"), "--quiet"}).code, 0);
  const test::Run run = splat({"--overlay", "records", "-o", path("records.exr"), "--stats", path("s.json")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("radius from"), std::string::npos) << run.err;
  EXPECT_NE(slurp(path("s.json")).find("overlay.records"), std::string::npos);
  const Image plain = read_image(path("plain.exr")), records = read_image(path("records.exr"));
  EXPECT_NE(plain.rgb(""), records.rgb(""));
  EXPECT_EQ(plain.rgb("indirect"), records.rgb("indirect")) << "other layers stay light";
  const test::Run without = splat({"--overlay", "records", "--layers", "direct", "-o", path("no.exr")});
  EXPECT_EQ(without.code, 2);
  EXPECT_TRUE(is_one_line(without.err)) << without.err;
  const test::Run still = splat({"--overlay", "records", "--overlay-colour", "life", "-o", path("no.exr")});
  EXPECT_EQ(still.code, 2);
  EXPECT_TRUE(is_one_line(still.err)) << still.err;
  EXPECT_NE(still.err.find("no film is given"), std::string::npos) << still.err;
  EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
}

TEST_F(SplatOptions, EdgeSamplesAndLeakTest) {
  const test::Run run = splat({"--edge-samples", "3", "--leak-test", "ray", "-o", path("e.exr"), "--stats",
                               path("e.json"), "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string stats = slurp(path("e.json"));
  EXPECT_NE(stats.find("edge pixels"), std::string::npos);
  EXPECT_NE(stats.find("seconds.lookups with leak test"), std::string::npos);
  for (const char* direct : {"traced", "interleaved", "shadow-map"}) {
    for (const char* threads : {"1", "3"})
      ASSERT_EQ(splat({"--edge-samples", "9", "--direct", direct, "--threads", threads, "-o",
                       path(std::string(threads) + ".exr"), "--quiet"})
                    .code,
                0);
    EXPECT_EQ(slurp(path("1.exr")), slurp(path("3.exr"))) << direct;
  }
  const test::Run unfiltered = splat({"--shadow-map-filter", "16", "-o", path("no.exr")});
  EXPECT_EQ(unfiltered.code, 2);
  EXPECT_TRUE(is_one_line(unfiltered.err)) << unfiltered.err;
}

}  // namespace
}  // namespace phos::test
