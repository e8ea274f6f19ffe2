// The scripts of pipelines/, at toy size.
#include <gtest/gtest.h>

#include <cmath>

#include "file/json_parse.h"
#include "image/image.h"
#include "support/script.h"

namespace phos::test {
namespace {

class Scripts : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-scripts"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  static auto written(const std::string& file) { return std::filesystem::last_write_time(file); }
  test::Run render(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {
        data("cornell-measured.glb"), "out", "--photons", "20000", "--width", "48", "--samples", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return run_script("render.sh", all, folder_);
  }
  std::string folder_;
};

TEST_F(Scripts, AreValidAndExecutable) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(PHOS_SOURCE) + "/pipelines")) {
    if (entry.path().extension() != ".sh") continue;
    ++count;
    const test::Run run = run_shell({"bash", "-n", entry.path().string()}, folder_);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(slurp(entry.path().string()).rfind("#!/usr/bin/env bash\n", 0), 0u) << entry.path();
    EXPECT_NE(std::filesystem::status(entry.path()).permissions() & std::filesystem::perms::owner_exec,
              std::filesystem::perms::none)
        << entry.path();
  }
  EXPECT_GE(count, 4);
}

TEST_F(Scripts, RenderMakesEveryFileAndReusesTheCaches) {
  const test::Run first = render();
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string base = path("out/cornell-measured");
  for (const char* kind : {".photons", ".irradiance", ".view.irradiance", ".exr", ".png", "-lux.png"})
    EXPECT_GT(std::filesystem::file_size(base + kind), 0u) << kind;
  for (const char* kind : {".pass.exr", ".misses.csv"})
    EXPECT_FALSE(std::filesystem::exists(base + kind)) << kind;
  EXPECT_NE(first.out.find("0 visible points without a record"), std::string::npos) << first.out;
  const Image image = read_image(base + ".exr");
  EXPECT_EQ(image.width(), 48);
  for (const auto& [name, values] : image.channels())
    for (const float v : values) ASSERT_TRUE(std::isfinite(v)) << name;
  float light = 0;
  for (const float v : image.channel("indirect.G")) light = std::max(light, v);
  EXPECT_GT(light, 0);

  const auto photons = written(base + ".photons"), records = written(base + ".irradiance");
  const std::string picture = slurp(base + ".exr");
  const test::Run again = render();
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(written(base + ".photons"), photons);
  EXPECT_EQ(written(base + ".irradiance"), records);
  const test::Run other = render({"--camera", "left-view"});
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_EQ(written(base + ".photons"), photons);
  EXPECT_NE(written(base + ".irradiance"), records);  // they are where the camera looks
  EXPECT_NE(slurp(base + ".exr"), picture);
}

/// Against path tracing, which shares none of the pipeline's estimators.
TEST_F(Scripts, RenderKeepsItsQuality) {
  const auto rendered = [&](const char* quality) {
    const test::Run run = run_script(
        "render.sh", {data("cornell-glossy22.glb"), quality, "--quality", quality, "--width", "64"}, folder_);
    EXPECT_EQ(run.code, 0) << run.err;
    return path(std::string(quality) + "/cornell-glossy22.exr");
  };
  const auto reference = [&](const char* seed) {
    const std::string file = path(std::string("reference") + seed + ".exr");
    EXPECT_EQ(run_tool({"reference", data("cornell-glossy22.glb"), "--width", "64", "--samples", "512",
                        "--method", "path", "--seed", seed, "--quiet", "-o", file})
                  .code,
              0);
    return file;
  };
  const std::string one = reference("1"), two = reference("2");
  for (const auto& [quality, limit] : {std::pair{"draft", 0.1}, {"good", 0.05}}) {
    const test::Run judged = run_tool({"compare", rendered(quality), one, "--second-reference", two,
                                       "--ignore-emission", "--layer", "beauty", "--json"});
    ASSERT_EQ(judged.code, 0) << judged.err;
    const Json metrics = parse_json(judged.out, "metrics").find("layers")->as_array().front();
    EXPECT_LE(metrics.find("relative_converged_rmse")->as_number(), limit) << quality;
    EXPECT_LE(std::fabs(metrics.find("relative_bias")->as_number()), 0.02) << quality;
  }
}

TEST_F(Scripts, RenderSaysHowItIsUsed) {
  test::Run run = run_script("render.sh", {}, folder_);
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("render.sh SCENE FOLDER"), std::string::npos) << run.err;
  EXPECT_EQ(render({"--nonsense", "1"}).code, 2);
  EXPECT_EQ(render({"--photons"}).code, 2);
  run = render({"--quality", "best"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("draft, good or final"), std::string::npos) << run.err;
  run = run_script("render.sh", {"no.glb", "out"}, folder_);
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("no.glb"), std::string::npos) << run.err;
}

TEST_F(Scripts, RenderStopsAtTheFirstError) {
  spill(path("text.glb"), "no scene\n");
  const test::Run run = run_script("render.sh", {"text.glb", "out", "--photons", "100"}, folder_);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("out/text.exr")));
}

}  // namespace
}  // namespace phos::test
