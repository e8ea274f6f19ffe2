// phos-brdf --figure: its pictures against closed forms, and the command lines that it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/json.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/refused.h"

namespace phos::test {
namespace {

constexpr double kKd = 0.5, kPi64 = std::numbers::pi;

/// A Lambert floor y = 0 under a camera that looks down on the square |x| <= 1, |z| <= 1 by parallel rays.
const char* const kFloor =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],)"
    R"("nodes":[{"mesh":0,"scale":[10,10,10],"translation":[-3,0,3]},)"
    R"({"camera":0,"name":"above","rotation":[-0.70710678,0,0,0.70710678],"translation":[0,2,0]}],)"
    R"("cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.01,"zfar":10}}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
    R"("materials":[{"name":"matt","extras":{"phos":{"brdf":"lambert","kd":[0.5,0.5,0.5]}}}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-1],"max":[1,0,0]}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
    R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}]})";

class LampFigureCli : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratch("brdf_lamp_figure"), figure_ = folder_ + "/lit.exr", out_ = folder_ + "/out.brdf";
    floor_ = folder_ + "/floor.gltf";
    spill(floor_, kFloor);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::vector<std::string> drawn(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"brdf", floor_, "--figure", figure_, "--quiet", "-o", out_};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string folder_, figure_, out_, floor_;
};

TEST_F(LampFigureCli, NearLamp) {
  const test::Run run =
      run_tool(drawn({"--figure-lamp", "-0.4,0.7,0.3", "--figure-intensity", "200", "--width", "24",
                      "--pixel-samples", "1", "--figure-orders", "3,1", "--stats", folder_ + "/s.json"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const Image image = read_image(figure_);
  ASSERT_EQ(image.width(), 48);
  ASSERT_EQ(image.height(), 72);
  const std::vector<Rgb> pixel = image.rgb("");
  const auto at = [&](int column, int row, int i, int j) {
    return static_cast<double>(pixel[static_cast<std::size_t>((24 * row + j) * 48 + 24 * column + i)].y);
  };
  for (int j = 0; j < 24; j += 5)
    for (int i = 0; i < 24; i += 3) {
      const double x = (2 * (i + 0.5) / 24 - 1) + 0.4, z = (2 * (j + 0.5) / 24 - 1) - 0.3, y = 0.7;
      const double d2 = x * x + y * y + z * z, cosine = y / std::sqrt(d2), lx = 200 / d2;
      const double exact = kKd / kPi64 * lx * cosine;
      // HSH hold the cosine in two bands, one band its mean; SH of three bands have 1/4 + z/2 + 5/16 P_2(z).
      const double p2 = 0.5 * (3 * cosine * cosine - 1);
      EXPECT_NEAR(at(0, 0, i, j) / exact, 1, 1e-4) << i << " " << j;
      EXPECT_NEAR(at(1, 0, i, j), at(0, 0, i, j), 0);
      EXPECT_NEAR(at(0, 1, i, j) / exact, 1, 1e-4) << i << " " << j;
      EXPECT_NEAR(at(1, 1, i, j), kKd / kPi64 * lx / 2, 1e-4 * exact + 1e-4 * lx);
      EXPECT_NEAR(at(0, 2, i, j), kKd / kPi64 * lx * (0.25 + cosine / 2 + 5 / 16. * p2), 1e-4 * lx);
      EXPECT_NEAR(at(1, 2, i, j), kKd / kPi64 * lx / 4, 1e-4 * lx);
    }
  const Json stats = parse_json(slurp(folder_ + "/s.json"), "stats");
  const Json::Array& errors = stats.find("figure")->as_array();
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_EQ(errors[0].find("basis")->as_string(), "hsh");
  EXPECT_EQ(errors[0].find("order")->as_integer(), 3);
  EXPECT_LT(errors[0].find("relative_rmse")->as_number(), 1e-4);
  EXPECT_NEAR(errors[0].find("mean_cd_m2")->as_number(), errors[1].find("mean_cd_m2")->as_number(), 0);
  EXPECT_EQ(errors[0].find("samples")->as_integer(), 24 * 24);
  EXPECT_GT(errors[3].find("relative_rmse")->as_number(), 0.2);
}

TEST_F(LampFigureCli, FarLamp) {
  // Of any length: the cosine is 4/5.
  ASSERT_EQ(
      run_tool(drawn({"--figure-lamp-from", "-30,40,0", "--figure-illuminance", "500", "--width", "8"})).code,
      0);
  const std::vector<Rgb> pixel = read_image(figure_).rgb("");
  ASSERT_EQ(pixel.size(), 8u * 24u);
  for (std::size_t i = 0; i < 8 * 16; ++i) EXPECT_NEAR(pixel[i].x, kKd / kPi64 * 500 * 0.8, 0.01) << i;
  // From below the floor nothing comes, through any harmonics.
  const test::Run below = run_tool(
      {"brdf", floor_, "--figure", figure_, "--figure-lamp-from", "0,-1,0.1", "--width", "8", "-o", out_});
  EXPECT_NE(below.err.find("\"matt\": the lamp does not light this material"), std::string::npos) << below.err;
  ASSERT_EQ(below.code, 0);
  for (const Rgb& c : read_image(figure_).rgb("")) EXPECT_EQ(c, Rgb(0));
}

TEST_F(LampFigureCli, LeavesTheTablesAsTheyAre) {
  // Reflects more than arrives, which is counted.
  std::string scene = kFloor;
  const std::string lambert = R"("brdf":"lambert","kd":[0.5,0.5,0.5])";
  scene.replace(scene.find(lambert), lambert.size(),
                R"("brdf":"phong","kd":[0.5,0.5,0.5],"ks":[0.7,0.7,0.7],"exponent":20)");
  spill(floor_, scene);
  const std::string plain = folder_ + "/plain.brdf";
  ASSERT_EQ(run_tool({"brdf", floor_, "-o", plain, "--quiet", "--resolution", "8"}).code, 0);
  ASSERT_EQ(run_tool(drawn({"--figure-lamp", "0,1,0", "--width", "4", "--resolution", "8"})).code, 0);
  const Container with = Container::open(out_, FileKind::brdf),
                  without = Container::open(plain, FileKind::brdf);
  EXPECT_GT(without.provenance().counters.counts().size(), 0u);
  EXPECT_EQ(with.provenance().counters.counts(), without.provenance().counters.counts());
  ASSERT_EQ(with.tensors().size(), without.tensors().size());
  for (const auto& [name, tensor] : without.tensors())
    EXPECT_TRUE(std::ranges::equal(with.tensors().at(name).bytes, tensor.bytes)) << name;
}

TEST_F(LampFigureCli, SameBytesOnAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"1", "3"}) {
    ASSERT_EQ(run_tool(drawn({"--figure-lamp", "0,1,0", "--width", "16", "--figure-rotation", "zero-fill",
                              "--threads", threads}))
                  .code,
              0);
    if (first.empty()) first = slurp(figure_);
    EXPECT_EQ(slurp(figure_), first) << threads;
  }
}

TEST_F(LampFigureCli, RefusesWhatItCannotDraw) {
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& word) {
    std::vector<std::string> words = drawn(more);
    words.erase(words.begin());
    expect_refused("brdf", words, code, word);
    EXPECT_FALSE(std::filesystem::exists(figure_)) << word;
    EXPECT_FALSE(std::filesystem::exists(out_)) << word;
  };
  refused({}, 2, "needs a lamp");
  refused({"--figure-lamp", "1,2"}, 2, "not three numbers");
  refused({"--figure-lamp", "1,2,high"}, 2, "\"high\" is not a number");
  refused({"--figure-lamp", "1,2,3", "--figure-lamp-from", "0,1,0"}, 2, "leave one out");
  refused({"--figure-lamp-from", "0,0,0"}, 2, "no direction");
  refused({"--figure-lamp", "1,2,3", "--figure-illuminance", "5"}, 2, "--figure-intensity");
  refused({"--figure-lamp-from", "0,1,0", "--figure-intensity", "5"}, 2, "--figure-illuminance");
  refused({"--figure-lamp", "1,2,3", "--figure-intensity", "0"}, 2, "above 0");
  refused({"--figure-lamp", "1,2,3", "--figure-orders", "7,31"}, 2, "31 is out of range");
  refused({"--figure-lamp", "1,2,3", "--figure-rotation", "constant-fil"}, 2,
          "did you mean \"constant-fill\"?");
  refused({"--figure-lamp", "1,2,3", "--figure-weight", "cosin"}, 2, "did you mean \"cosine\"?");
  refused({"--figure-lamp", "1,2,3", "--camera", "desk"}, 2, "above");
  refused({"--figure-lamp", "1,2,3", "--reuse"}, 2, "leave out --reuse");
  refused({"--figure-lamp", "1,2,3", "--width", "65536"}, 2, "too many");
  // Pixel 4, 4 of 9: the middle of the floor, where the lamp lies.
  refused({"--figure-lamp", "0,0,0", "--width", "9", "--pixel-samples", "1"}, 5, "--figure-lamp");
  refused({"--figure-lamp-from", "0,1,0", "--figure-illuminance", "1e300", "--width", "4"}, 5, "too strong");
  expect_refused("brdf", {floor_, "--figure-lamp", "1,2,3", "-o", out_}, 2, "give --figure FILE.exr");
  expect_refused("brdf", {floor_, "--figure", folder_ + "/lit.png", "--figure-lamp", "1,2,3", "-o", out_}, 2,
                 "must end in .exr");
  expect_refused("brdf", {data("lobes.gltf"), "--figure", figure_, "--figure-lamp", "1,2,3", "-o", out_}, 3,
                 "camera");
}

}  // namespace
}  // namespace phos::test
