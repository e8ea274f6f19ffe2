// phos-compare --flicker from a shell.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "file/json_parse.h"
#include "image/image.h"
#include "support/refused.h"

namespace phos {
namespace {

using test::expect_refused;
using test::run_tool;

/// Two sequences: light that grows evenly, and the same with every second frame 1 % brighter.
class CompareSequences : public testing::Test {
 protected:
  static constexpr int kFrames = 6;
  void SetUp() override {
    folder_ = test::scratch("compare-sequences");
    for (const char* name : {"film", "truth", "again"}) std::filesystem::create_directory(path(name));
    for (int t = 0; t < kFrames; ++t) {
      const float level = 100 + static_cast<float>(t);
      write("truth", t, level);
      write("again", t, level);
      write("film", t, t % 2 ? level + 1 : level);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, int frame, float level) const {
    Image image(16, 12);
    image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(level)));
    image.set_rgb("indirect", std::vector<Rgb>(image.pixels(), Rgb(1)));
    for (const char* c : {"normal.X", "normal.Y", "normal.Z"}) image.channel(c);
    write_exr(path(name + "/000" + std::to_string(frame) + ".exr"), image);
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string folder_;
};

TEST_F(CompareSequences, FiguresAsJson) {
  for (const bool folders : {true, false}) {
    const std::string names = folders ? "" : "/%04d.exr";
    const auto run = run_tool(
        {"compare", path("film") + names, path("truth") + names, "--flicker", "--frames", "0:5", "--json"});
    ASSERT_EQ(run.code, 0) << run.err;
    const Json result = parse_json(run.out, "stdout");
    const Json::Array& layers = result.find("layers")->as_array();
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].find("layer")->as_string(), "beauty");
    const double flicker = std::sqrt(2.0 / 3);  // |h| = 1
    EXPECT_NEAR(layers[0].find("flicker")->as_number(), flicker, 1e-4);
    EXPECT_NEAR(layers[0].find("relative_flicker")->as_number(), flicker / 102.5, 1e-6);
    EXPECT_NEAR(layers[0].find("bias")->as_number(), 0.5, 1e-5);
    EXPECT_NEAR(layers[0].find("rmse")->as_number(), std::sqrt(0.5), 1e-5);
    EXPECT_EQ(layers[1].find("flicker")->as_number(), 0);
    EXPECT_EQ(layers[0].find("converged_flicker"), nullptr);
  }
}

TEST_F(CompareSequences, LimitsAndTheSecondReference) {
  const std::vector<std::string> words{"compare",  path("film"), path("truth"),        "--flicker",
                                       "--frames", "0:5",        "--second-reference", path("again")};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run_tool(all);
  };
  EXPECT_EQ(with({"--max-flicker", "0.0081", "--max-relative-rmse", "0.008", "--max-bias", "0.006"}).code, 0);
  const auto over = with({"--max-flicker", "0.0079"});
  EXPECT_EQ(over.code, 1);
  EXPECT_NE(over.err.find("beauty: flicker 0.00796"), std::string::npos) << over.err;
  EXPECT_NE(over.out.find("without the references' noise"), std::string::npos) << over.out;
  EXPECT_EQ(with({"--max-flicker", "0.0079", "--layer", "indirect"}).code, 0);
  EXPECT_EQ(with({"--max-bias", "0.004"}).code, 1);
}

TEST_F(CompareSequences, PictureAndTable) {
  const auto run = run_tool({"compare", path("film"), path("truth"), "--flicker", "--frames", "0:5",
                             "--difference", path("d.exr"), "--per-frame", path("frames.csv")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(read_image(path("d.exr")).channel("Y")[3], std::sqrt(2.0 / 3), 1e-4);
  EXPECT_EQ(read_image(path("d.exr")).channel("indirect.Y")[3], 0);
  const std::string csv = test::slurp(path("frames.csv"));
  EXPECT_EQ(csv.find("frame,layer,reference_mean,rmse,"), 0u);
  EXPECT_NE(csv.find("\n5,beauty,105,1,"), std::string::npos) << csv;
  EXPECT_EQ(run_tool({"compare", path("film"), path("truth"), "--flicker", "--frames", "0:5", "--difference",
                      path("d.png")})
                .code,
            0);
  EXPECT_GT(read_png(path("d.png")).width, 16);
}

TEST_F(CompareSequences, Refuses) {
  const std::string film = path("film"), truth = path("truth");
  expect_refused("compare", {film, truth, "--flicker"}, 2, "--frames 0:47");
  expect_refused("compare", {film, truth, "--frames", "0:5"}, 2, "--flicker");
  expect_refused("compare", {film, truth, "--flicker", "--frames", "0:1"}, 2, "three frames");
  expect_refused("compare", {film, truth, "--flicker", "--frames", "0:5", "--max-p99", "1"}, 2, "--max-p99");
  expect_refused("compare", {film + "/0000.exr", truth, "--flicker", "--frames", "0:5"}, 2, "%04d");
  expect_refused("compare", {film + "/0000.exr", truth + "/0000.exr", "--max-flicker", "1"}, 2,
                 "--max-flicker");
  expect_refused("compare", {film + "/0000.exr", truth + "/0000.exr", "--per-frame", "x.csv"}, 2,
                 "--per-frame");
  expect_refused("compare", {film, truth, "--flicker", "--frames", "0:7"}, 3, "0006.exr");
  expect_refused("compare", {folder_, truth, "--flicker", "--frames", "0:5"}, 3, "no numbered images");
  Image other(4, 4);
  other.set_rgb("", std::vector<Rgb>(16));
  write_exr(film + "/0003.exr", other);
  expect_refused("compare", {film, truth, "--flicker", "--frames", "0:5"}, 4, "0003.exr");
}

}  // namespace
}  // namespace phos
