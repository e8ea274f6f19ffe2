// phos-sense --frames: readings at each frame.
#include <gtest/gtest.h>

#include "support/refused.h"

namespace {

using namespace phos::test;

const std::string kFilm = data("moving-light.glb");  // 400 frames

TEST(SenseSequences, FilesAreThoseOfSingleFrames) {
  const std::string folder = scratch("sense-sequences");
  const std::vector<std::string> words{"sense", kFilm,      "--direct-only", "--grid",
                                       "0.2",   "--height", "0.1",           "--quiet"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run_tool(all);
  };
  const auto run = with({"--frames", "100:101", "-o", folder + "/%d.csv", "--summary", folder + "/%d.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto one = with({"--frame", "101"});
  EXPECT_EQ(slurp(folder + "/101.csv"), one.out);
  EXPECT_NE(slurp(folder + "/100.csv"), one.out) << "the light moves";
  EXPECT_FALSE(slurp(folder + "/100.json").empty());
  EXPECT_EQ(with({"--frames", "100:101"}).code, 2) << "stdout is one file";
  EXPECT_EQ(with({"--frames", "100:101", "-o", folder + "/%d.csv", "--summary", folder + "/s.json"}).code, 2);
  expect_refused("sense",
                 {kFilm, "--direct-only", "--points", "-", "--frames", "0:1", "-o", folder + "/%d.csv"}, 2,
                 "--points");
  std::filesystem::remove_all(folder);
}

}  // namespace
