// phos-splat --frames: a picture for each frame, the one that --frame makes.
#include <gtest/gtest.h>

#include "file/json_parse.h"
#include "support/refused.h"

namespace phos::test {
namespace {

/// A scene without animation is the same at every frame: an ordinary cache lights them all.
class SplatSequences : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::string(scratch("splat-sequences"));
    const std::string scene = data("cornell-measured.glb");
    ASSERT_EQ(run_tool({"photons", scene, "--photons", "20000", "-o", path("a.photons"), "--quiet"}).code, 0);
    ASSERT_EQ(run_tool({"irradiance", scene, path("a.photons"), "-o", path("a.irradiance"), "--quiet"}).code,
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
                                 "48",
                                 "--pixel-samples",
                                 "1",
                                 "--light-samples",
                                 "1",
                                 "--splat",
                                 "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return run_tool(all);
  }
  static std::string* folder_;
};
std::string* SplatSequences::folder_ = nullptr;

TEST_F(SplatSequences, FilesAreThoseOfSingleFrames) {
  const test::Run run = splat(
      {"--frames", "4:5", "-o", path("%03d.exr"), "--misses", path("m%d.csv"), "--stats", path("s.json")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("frame 5: "), std::string::npos) << run.err;
  ASSERT_EQ(splat({"--frame", "5", "-o", path("one.exr"), "--misses", path("m.csv"), "--threads", "1"}).code,
            0);
  EXPECT_FALSE(slurp(path("one.exr")).empty());
  EXPECT_EQ(slurp(path("005.exr")), slurp(path("one.exr")));
  EXPECT_EQ(slurp(path("m5.csv")), slurp(path("m.csv")));
  EXPECT_TRUE(std::filesystem::exists(path("m4.csv")));
  const Json stats = parse_json(slurp(path("s.json")), "stats");
  EXPECT_EQ(stats.find("frames")->as_array().size(), 2u);
  EXPECT_EQ(stats.find("frames")->as_array()[1].find("frame")->as_integer(), 5);
}

/// Stages take the frame of their photons; a sequence has its own.
TEST_F(SplatSequences, OneFrameIsThatOfTheCache) {
  const std::string scene = data("moving-light.glb");
  ASSERT_EQ(run_tool({"photons", scene, "--frame", "100", "--photons", "5000", "-o", path("f.photons")}).code,
            0);
  const auto stage = [&](std::vector<std::string> words, const std::string& to) {
    words.insert(words.end(), {"-o", path("silent" + to)});
    const test::Run silent = run_tool(words);
    ASSERT_EQ(silent.code, 0) << silent.err;
    EXPECT_NE(silent.err.find("frame 100: as of "), std::string::npos) << silent.err;
    words.back() = path("said" + to);
    words.insert(words.end(), {"--frame", "100"});
    ASSERT_EQ(run_tool(words).code, 0);
    EXPECT_EQ(slurp(path("silent" + to)), slurp(path("said" + to))) << to;
  };
  stage({"irradiance", scene, path("f.photons"), "--place", "surface"}, ".irradiance");
  const std::vector<std::string> splat{"splat",   scene, path("said.irradiance"), "--width", "16",
                                       "--splat", "cpu"};
  stage(splat, ".exr");
  std::vector<std::string> other = splat;
  other.insert(other.end(), {"--frame", "0", "-o", path("other.exr")});
  EXPECT_EQ(run_tool(other).code, 4);
  other = splat;
  other.insert(other.end(), {"--frames", "100:100", "-o", path("f%d.exr")});
  EXPECT_EQ(run_tool(other).code, 0);
  EXPECT_EQ(slurp(path("f100.exr")), slurp(path("said.exr")));
}

TEST_F(SplatSequences, Refuses) {
  const auto refused = [](const std::vector<std::string>& more, const std::string& word) {
    const test::Run run = splat(more);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  };
  refused({"--frames", "0:1", "-o", path("x.exr")}, "x-%04d.exr");
  refused({"--frames", "0:1", "-o", path("%d-x.exr"), "--misses", path("x.csv")}, "--misses");
  refused({"--frames", "0:1", "--time", "1", "-o", path("%d-x.exr")}, "--time");
  EXPECT_FALSE(std::filesystem::exists(path("0-x.exr")));
}

}  // namespace
}  // namespace phos::test
