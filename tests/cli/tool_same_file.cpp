// Every program refuses an output that is one of its inputs, before anything is read.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/run.h"

namespace phos::test {
namespace {

struct Case {
  std::vector<std::string> words;  ///< IN: the file that is read; OUT: another name of it
  std::string option, input;       ///< that the message names
};

TEST(SameFile, EveryProgramRefusesIt) {
  const std::string folder = scratch("same-file"), in = folder + "/in", out = folder + "/link";
  spill(in, "no file of any kind");
  std::filesystem::create_symlink(in, out);
  const std::vector<Case> cases = {
      {{"scene", "IN", "--stats", "OUT"}, "--stats", "SCENE"},
      {{"photons", "IN", "-o", "OUT"}, "--output", "SCENE"},
      {{"photons", "a.glb", "--environment", "IN", "-o", "OUT"}, "--output", "--environment"},
      {{"photons", "a.glb", "--luminaire", "lamp=IN", "-o", "OUT"}, "--output", "--luminaire"},
      {{"merge", "IN", "b", "-o", "OUT"}, "--output", "SHARD"},
      {{"irradiance", "a.glb", "IN", "-o", "OUT"}, "--output", "SCENE [PHOTONS]"},
      {{"irradiance", "a.glb", "--at", "IN", "-o", "OUT"}, "--output", "--at"},
      {{"irradiance", "a.glb", "--add-to", "IN", "-o", "b", "--stats", "OUT"}, "--stats", "--add-to"},
      {{"brdf", "IN", "-o", "OUT"}, "--output", "SCENE"},
      {{"brdf", "IN", "-o", "b", "--bases", "OUT"}, "--bases", "SCENE"},
      {{"radiance", "a.glb", "IN", "-o", "OUT"}, "--output", "SCENE"},
      {{"radiance", "a.glb", "--at", "IN", "-o", "OUT"}, "--output", "--at"},
      {{"temporal", "IN", "--frames", "0:1", "-o", "OUT"}, "--output", "SCENE"},
      {{"splat", "a.glb", "IN", "-o", "OUT"}, "--output", "CACHE"},
      {{"splat", "a.glb", "IN", "--misses", "OUT", "-o", "b"}, "--misses", "CACHE"},
      {{"splat", "a.glb", "IN", "--gloss-misses", "OUT", "-o", "b"}, "--gloss-misses", "CACHE"},
      {{"sense", "a.glb", "--points", "IN", "-o", "OUT"}, "--output", "--points"},
      {{"sense", "a.glb", "--points", "IN", "--summary", "OUT"}, "--summary", "--points"},
      {{"reference", "a.glb", "--points", "IN", "-o", "OUT"}, "--output", "--points"},
      {{"bands", "IN", "b", "-o", "OUT"}, "--output", "PART"},
      {{"compare", "IN", "b", "--difference", "OUT"}, "--difference", "IMAGE"},
      {{"compare", "b", "IN", "--stats", "OUT"}, "--stats", "REFERENCE"},
      {{"compare", "b", "c", "--second-reference", "IN", "--per-frame", "OUT"},
       "--per-frame",
       "--second-reference"},
      {{"picture", "IN", "-o", "OUT"}, "--output", "INPUT"},
      {{"study", "IN", "-o", "b", "--stats", "OUT"}, "--stats", "STUDY"},
      {{"plan", "a.glb", "--sensors", "IN", "-o", "OUT"}, "--output", "--sensors"},
      {{"info", "IN", "-o", "OUT"}, "--output", "FILE"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> words = c.words;
    for (std::string& word : words) {
      if (const std::size_t at = word.find("IN"); at != std::string::npos) word.replace(at, 2, in);
      if (word == "OUT") word = out;
    }
    const auto run = run_tool(words);
    EXPECT_EQ(run.code, 2) << c.words[0] << ": " << run.err;
    EXPECT_NE(run.err.find(c.option), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(c.input), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("is an input too"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(slurp(in), "no file of any kind");
  }
}

TEST(SameFile, ATextureOfTheSceneIsRead) {
  const std::string folder = scratch("same-file-texture");
  spill(folder + "/x.obj", "mtllib x.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  spill(folder + "/x.mtl", "newmtl a\nKe 1 1 1\nmap_d leaf.png\n");
  spill(folder + "/leaf.png", "leaf");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"scene", folder + "/x.obj", "--stats"},
        {"photons", folder + "/x.obj", "-o"}}) {
    std::vector<std::string> all = words;
    all.push_back(folder + "/leaf.png");
    const auto run = run_tool(all);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_EQ(slurp(folder + "/leaf.png"), "leaf");
  }
}

}  // namespace
}  // namespace phos::test
