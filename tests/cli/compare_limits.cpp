// phos-compare from a shell: exit codes, one line of reason, results on stdout.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/json.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/run.h"

namespace phos {
namespace {

using test::run_tool;

class Compare : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch("compare");
    Image image(24, 16);
    image.set_rgb("", std::vector<Rgb>(384, Rgb(10)));
    image.set_rgb("indirect", std::vector<Rgb>(384, Rgb(4)));
    image.set_rgb("emission", std::vector<Rgb>(384, Rgb(0)));
    image.channel("emission.G")[7] = 1;
    write_exr(path("reference.exr"), image);
    for (const char* c : {"R", "G", "B"})
      for (float& v : image.channel(c)) v = 10.5f;
    image.channel("R")[7] = 900;
    write_exr(path("image.exr"), image);
    image.channel("B")[100] = NAN;
    write_exr(path("nan.exr"), image);
    write_exr(path("small.exr"), [] {
      Image small(2, 2);
      small.channel("R"), small.channel("G"), small.channel("B");
      return small;
    }());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string folder_;
};

TEST_F(Compare, EqualImagesPassEveryLimit) {
  const auto run = run_tool({"compare",
                             path("image.exr"),
                             path("image.exr"),
                             "--max-rmse",
                             "0",
                             "--max-relative-rmse",
                             "0",
                             "--max-relative-mse",
                             "0",
                             "--max-relative-error",
                             "0",
                             "--max-bias",
                             "0",
                             "--max-absolute-bias",
                             "0",
                             "--max-p99",
                             "0",
                             "--max-difference",
                             "0",
                             "--min-pu-psnr",
                             "200",
                             "--min-pu-ssim",
                             "1"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("indirect"), std::string::npos);
}

TEST_F(Compare, EachLimitFailsByItself) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--max-rmse", "0.4"},
                                                        {"--max-relative-rmse", "0.04"},
                                                        {"--max-relative-mse", "0.001"},
                                                        {"--max-relative-error", "0.04"},
                                                        {"--max-bias", "0.04"},
                                                        {"--max-absolute-bias", "0.4"},
                                                        {"--max-p99", "0.4"},
                                                        {"--max-difference", "0.4"},
                                                        {"--min-pu-psnr", "60"},
                                                        {"--min-pu-ssim", "1"}}) {
    const auto run = run_tool({"compare", path("image.exr"), path("reference.exr"), "--layer", "beauty",
                               "--ignore-emission", option, value});
    EXPECT_EQ(run.code, 1) << option << run.err;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(option.substr(6)), std::string::npos) << run.err;
    const auto loose = run_tool({"compare", path("image.exr"), path("reference.exr"), "--layer", "beauty",
                                 "--ignore-emission", option, option.starts_with("--min") ? "0.5" : "0.6"});
    EXPECT_EQ(loose.code, 0) << option << loose.err;
  }
}

TEST_F(Compare, JsonHoldsTheFigures) {
  const auto run = run_tool({"compare", path("image.exr"), path("reference.exr"), "--json",
                             "--ignore-emission", "--layer", "beauty,indirect"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json result = parse_json(run.out, "stdout");
  EXPECT_TRUE(result.find("passed")->as_bool());
  const Json::Array& layers = result.find("layers")->as_array();
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].find("layer")->as_string(), "beauty");
  EXPECT_DOUBLE_EQ(layers[0].find("bias")->as_number(), 0.5);
  EXPECT_EQ(layers[0].find("ignored")->as_integer(), 1);
  EXPECT_DOUBLE_EQ(layers[1].find("rmse")->as_number(), 0);
}

TEST_F(Compare, NonFinitePixelsAlwaysFail) {
  for (const auto& order : {std::pair{"nan.exr", "reference.exr"}, std::pair{"reference.exr", "nan.exr"}}) {
    const auto run = run_tool({"compare", path(order.first), path(order.second)});
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("1 pixels are not finite"), std::string::npos) << run.err;
  }
}

TEST_F(Compare, WhatDoesNotBelongTogetherIsFour) {
  EXPECT_EQ(run_tool({"compare", path("image.exr"), path("small.exr")}).code, 4);
  EXPECT_EQ(run_tool({"compare", path("image.exr"), path("reference.exr"), "--layer", "specular"}).code, 4);
  EXPECT_EQ(run_tool({"compare", path("small.exr"), path("small.exr"), "--ignore-emission"}).code, 4);
}

TEST_F(Compare, BadInputIsThreeAndUsageTwo) {
  test::spill(path("text.exr"), "not an image");
  const std::string whole = test::slurp(path("image.exr"));
  test::spill(path("cut.exr"), whole.substr(0, whole.size() / 2));
  for (const char* name : {"text.exr", "cut.exr", "missing.exr"}) {
    const auto run = run_tool({"compare", path(name), path("image.exr")});
    EXPECT_EQ(run.code, 3) << name;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
  }
  EXPECT_EQ(run_tool({"compare", path("image.exr")}).code, 2);
  EXPECT_EQ(run_tool({"compare", path("image.exr"), path("image.exr"), "--max-rmse", "-1"}).code, 2);
  EXPECT_EQ(run_tool({"compare", path("image.exr"), path("image.exr"), "--difference", "x.jpg"}).code, 2);
}

TEST_F(Compare, DifferencePictures) {
  const auto png =
      run_tool({"compare", path("image.exr"), path("reference.exr"), "--difference", path("d.png")});
  EXPECT_EQ(png.code, 0) << png.err;
  const Picture p = read_png(path("d.png"));
  EXPECT_GT(p.width, 24);
  EXPECT_GT(p.rgb[0], p.rgb[2]);  // the image is brighter: red
  const auto exr =
      run_tool({"compare", path("image.exr"), path("reference.exr"), "--difference", path("d.exr")});
  EXPECT_EQ(exr.code, 0) << exr.err;
  EXPECT_EQ(read_image(path("d.exr")).rgb("")[0], Rgb(0.5f));
  EXPECT_EQ(read_image(path("d.exr")).rgb("indirect")[0], Rgb(0));
  const auto nowhere =
      run_tool({"compare", path("image.exr"), path("reference.exr"), "--difference", path("no/d.png")});
  EXPECT_EQ(nowhere.code, 3);
}

}  // namespace
}  // namespace phos
