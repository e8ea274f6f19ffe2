// pipelines/film.sh at toy size, and what every program makes of a film.
#include <gtest/gtest.h>

#include <cmath>

#include "file/container.h"
#include "image/image.h"
#include "support/refused.h"
#include "support/script.h"

namespace phos::test {
namespace {

class Films : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-film"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string scene() { return data("cube-in-a-box.glb"); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// "" if it failed.
  std::string out_of(const std::vector<std::string>& words) const {
    const test::Run run = run_tool(words);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  }
  std::string folder_;
};

std::vector<float> indirect(const std::string& file) {
  const Image image = read_image(file);
  EXPECT_EQ(image.width(), 32);
  const auto g = image.channel("indirect.G");
  return {g.begin(), g.end()};
}

TEST_F(Films, ScriptMakesEveryFrameAndAVideo) {
  const test::Run run = run_script("film.sh",
                                   {scene(), "out", "--frames", "3:5", "--photons", "5000", "--rays", "64",
                                    "--width", "32", "--samples", "1"},
                                   folder_);
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string film = path("out/cube-in-a-box.irradiance");
  EXPECT_TRUE(Container::open(film, FileKind::irradiance).provenance().extra.find("film"));
  for (const char* name : {"0003", "0004", "0005"}) {
    const std::string frame = path("out/frames/") + name;
    EXPECT_GT(std::filesystem::file_size(frame + ".png"), 0u);
    float light = 0;
    for (const float v : indirect(frame + ".exr")) {
      ASSERT_TRUE(std::isfinite(v));
      light = std::max(light, v);
    }
    EXPECT_GT(light, 0);
  }
  EXPECT_FALSE(std::filesystem::exists(path("out/frames/0002.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("out/frames/0006.exr")));
  const bool video = run.out.find("video:") != std::string::npos;
  EXPECT_EQ(std::filesystem::exists(path("out/cube-in-a-box.mp4")), video);

  // A frame of a sequence is the picture of that frame alone; frames differ.
  out_of({"splat", scene(), film, "--frame", "5", "--width", "32", "--pixel-samples", "1", "-o",
          path("alone.exr")});
  const std::vector<float> alone = indirect(path("alone.exr"));
  EXPECT_EQ(alone, indirect(path("out/frames/0005.exr")));
  EXPECT_NE(alone, indirect(path("out/frames/0003.exr")));
}

TEST_F(Films, ScriptSaysHowItIsUsed) {
  test::Run run = run_script("film.sh", {}, folder_);
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("film.sh SCENE FOLDER"), std::string::npos) << run.err;
  EXPECT_EQ(run_script("film.sh", {scene(), "out", "--frames"}, folder_).code, 2);
  EXPECT_EQ(run_script("film.sh", {"no.glb", "out"}, folder_).code, 3);
  run = run_script("film.sh", {data("cornell-empty.glb"), "still"}, folder_);
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("not animated"), std::string::npos) << run.err;
}

TEST_F(Films, EveryProgramReadsItsFrameOrRefuses) {
  const std::string film = path("film.irradiance"), out = path("refused");
  out_of({"temporal", scene(), "--frames", "3:6", "--photons", "5000", "--rays", "64", "--width", "32", "-o",
          film});
  const auto sense = [&](const std::string& frame) {
    return out_of({"sense", scene(), film, "--frame", frame, "--grid", "0.5", "--height", "0.1"});
  };
  EXPECT_NE(sense("3"), sense("6"));
  out_of({"irradiance", scene(), film, "--frame", "5", "--place", "surface", "--estimate", "gather", "--rays",
          "16", "--accuracy", "1", "-o", path("still.irradiance")});

  expect_refused("splat", {scene(), film, "--frame", "9", "-o", out}, 4, "frames 3 to 6");
  expect_refused("splat", {scene(), film, "-o", out}, 4, "frames 3 to 6");
  expect_refused("splat", {scene(), film, "--frame", "4.5", "-o", out}, 4, "4.5");
  expect_refused("splat", {data("spheres.glb"), film, "--frame", "4", "-o", out}, 4, "another scene");
  expect_refused("sense", {scene(), film, "--frame", "2", "--grid", "0.5", "--height", "0.1", "-o", out}, 4,
                 "frames 3 to 6");
  expect_refused("irradiance",
                 {scene(), "--frame", "4", "--place", "surface", "--estimate", "gather", "--gather-bounces",
                  "1", "--add-to", film, "-o", out},
                 2, "is a film");
  expect_refused("merge", {film, film, "-o", out}, 2, "is a film");
  EXPECT_FALSE(std::filesystem::exists(out));

  const std::string told = out_of({"info", film});
  for (const char* word : {"frames (3 6)", "mean_life", "chains", "birth", "gradients interpolated"})
    EXPECT_NE(told.find(word), std::string::npos) << word << told;
  EXPECT_NE(out_of({"info", film, "--json"}).find("\"mean_life\""), std::string::npos);
  EXPECT_EQ(out_of({"info", film, "--dump", "birth,end,chain"}).rfind("birth,end,chain\n", 0), 0u);
  EXPECT_EQ(out_of({"info", film, "--points"}).rfind("ply", 0), 0u);
}

}  // namespace
}  // namespace phos::test
