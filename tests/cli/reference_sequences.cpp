// phos-reference --frames: a file for each frame, the one that --frame makes.
#include <gtest/gtest.h>

#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kFilm = data("moving-light.glb");  // 400 frames, 25 a second

std::vector<std::string> command(const std::vector<std::string>& more) {
  std::vector<std::string> all{"reference", kFilm, "--width", "24", "--samples", "2", "--quiet"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(ReferenceSequences, FilesAreThoseOfSingleFrames) {
  const std::string folder = scratch("reference-sequences");
  ASSERT_EQ(run_tool(command({"--frames", "30:32", "-o", folder + "/%04d.exr"})).code, 0);
  ASSERT_EQ(run_tool(command({"--frame", "31", "--threads", "1", "-o", folder + "/one.exr"})).code, 0);
  EXPECT_EQ(slurp(folder + "/0031.exr"), slurp(folder + "/one.exr"));
  EXPECT_NE(slurp(folder + "/0031.exr"), slurp(folder + "/0032.exr"));
  EXPECT_EQ(frames_per_s(read_image(folder + "/0030.exr")), 25.0);
  // Another range, as another machine would make it.
  ASSERT_EQ(run_tool(command({"--frames", "32:33", "-o", folder + "/%d.exr"})).code, 0);
  EXPECT_EQ(slurp(folder + "/0032.exr"), slurp(folder + "/32.exr"));
  std::filesystem::remove_all(folder);
}

TEST(ReferenceSequences, ReuseGoesOnAfterAnInterrupt) {
  const std::string folder = scratch("reference-sequences-interrupt"), out = folder + "/%04d.exr";
  const Process process(
      {"reference", kFilm, "--width", "24", "--samples", "2", "--frames", "0:399", "-o", out});
  while (!std::filesystem::exists(folder + "/0002.exr"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  process.signal(SIGINT);
  const test::Run run = process.wait();
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_NE(run.err.find("are done, --reuse goes on from there"), std::string::npos) << run.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_EQ(read_image(entry.path().string()).width(), 24) << "whole";
  const auto first = std::filesystem::last_write_time(folder + "/0000.exr");
  std::filesystem::remove(folder + "/0001.exr");
  EXPECT_EQ(run_tool(command({"--frames", "0:2", "--reuse", "-o", out})).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/0001.exr"));
  EXPECT_EQ(std::filesystem::last_write_time(folder + "/0000.exr"), first);
  std::filesystem::remove_all(folder);
}

TEST(ReferenceSequences, PointsOfEachFrame) {
  const std::string folder = scratch("reference-sequences-points");
  spill(folder + "/p.csv", "x,y,z,nx,ny,nz\n0.5,0.001,0.5,0,1,0\n");
  const std::vector<std::string> points{"--points", folder + "/p.csv", "--frames", "0:1"};
  std::vector<std::string> to_files = command(points);
  to_files.insert(to_files.end(), {"-o", folder + "/%d.csv"});
  const test::Run run = run_tool(to_files);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(slurp(folder + "/1.csv").find("x,y,z"), 0u);
  const test::Run nowhere = run_tool(command(points));
  EXPECT_EQ(nowhere.code, 2) << "frames cannot share stdout";
  EXPECT_NE(nowhere.err.find("film/%04d.exr"), std::string::npos) << nowhere.err;
  std::filesystem::remove_all(folder);
}

TEST(ReferenceSequences, Refuses) {
  const std::string folder = scratch("reference-sequences-refused"), out = folder + "/%04d.exr";
  expect_refused("reference", {kFilm, "--frames", "0:2", "-o", folder + "/x.exr"}, 2, "x-%04d.exr");
  expect_refused("reference", {kFilm, "--frames", "0:2", "--frame", "1", "-o", out}, 2, "--frame");
  expect_refused("reference", {kFilm, "--frames", "0:2", "--time", "1", "-o", out}, 2, "--time");
  expect_refused("reference", {kFilm, "--frames", "2:0", "-o", out}, 2, "0:2");
  expect_refused("reference", {kFilm, "--frames", "398:400", "-o", out}, 2, "0:399");
  expect_refused("reference", {kFilm, "--frames", "0:2", "-o", folder + "/no/%d.exr"}, 3,
                 "make the folder first");
  expect_refused("reference", {kFilm, "--frames", "5:6", "--camera", "none", "-o", out}, 2, "none");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

}  // namespace
