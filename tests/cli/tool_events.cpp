// A numerical event beyond its stated frequency ends the tool with exit code 5 and one line that names it,
// how often it came, how often it may, and what to do; nothing is written.
#include <gtest/gtest.h>

#include "support/run.h"

namespace phos::test {
namespace {

/// The empty Cornell box with a lamp of 3e38 cd/m2: floats hold its flux, but not the light next to it.
std::string too_bright(const std::string& folder) {
  std::string bytes = slurp(data("cornell-empty.glb"));
  const std::string key = "\"emissiveStrength\":";
  const std::size_t at = bytes.find(key) + key.size();
  const std::size_t end = bytes.find_first_of(",}", at);
  EXPECT_LT(at, end);
  std::string strength = "3e38";
  EXPECT_GE(end - at, strength.size());
  strength.resize(end - at, ' ');  // the length of the JSON chunk stays
  bytes.replace(at, end - at, strength);
  const std::string path = folder + "/bright.glb";
  spill(path, bytes);
  return path;
}

void expect_told(const Run& run, const std::string& tool, const std::string& event) {
  EXPECT_EQ(run.code, 5) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_EQ(run.err.rfind("phos-" + tool + ": " + event + ": ", 0), 0u) << run.err;
  for (const char* part : {" in 4096 samples", "at most 1 are allowed (a share of 1e-06); ", "phos-scene"})
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

TEST(Events, NonFiniteSamplesEndTheTool) {
  const std::string folder = scratch("events"), scene = too_bright(folder), out = folder + "/o.csv";
  spill(folder + "/p.csv", "x,y,z,nx,ny,nz\n0.278,0.5478,0.28,0,1,0\n");  // 1 mm below the lamp
  const std::vector<std::string> measure{"--points", folder + "/p.csv", "--samples", "4096", "--quiet", "-o",
                                         out};
  for (const std::string tool : {"reference", "sense"}) {
    std::vector<std::string> words{tool, scene};
    if (tool == "sense") words.push_back("--exact");
    words.insert(words.end(), measure.begin(), measure.end());
    expect_told(run_tool(words), tool, "non-finite sample");
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

// What is far from the lamp is finite, and right up to there.
TEST(Events, NoneInTheSameSceneFurtherOff) {
  const std::string folder = scratch("events-far"), scene = too_bright(folder), out = folder + "/o.csv";
  spill(folder + "/p.csv", "x,y,z,nx,ny,nz\n0.278,0.001,0.28,0,1,0\n");
  const test::Run run = run_tool(
      {"reference", scene, "--points", folder + "/p.csv", "--samples", "4096", "--quiet", "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(slurp(out).find(",nan"), std::string::npos);
  EXPECT_EQ(slurp(out).find(",inf"), std::string::npos);
}

}  // namespace
}  // namespace phos::test
