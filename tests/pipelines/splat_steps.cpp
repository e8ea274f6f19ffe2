// The tools typed one after another: what one leaves is what the next needs, and the picture is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/metrics.h"
#include "support/run.h"

namespace phos::test {
namespace {

class Steps : public testing::Test {
 protected:
  static void SetUpTestSuite() { folder_ = new std::string(scratch("pipelines-steps")); }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
  }
  static std::string path(const std::string& name) { return *folder_ + "/" + name; }
  static void must(std::vector<std::string> arguments) {
    arguments.push_back("--quiet");
    const test::Run run = run_tool(arguments);
    ASSERT_EQ(run.code, 0) << arguments[0] << ": " << run.err;
  }
  /// Splats and fills what is missing until nothing is; the number of passes, or -1.
  static int fill(const std::string& scene, const std::string& photons, const std::string& cache,
                  std::vector<std::string> view) {
    for (int pass = 1; pass <= 5; ++pass) {
      std::vector<std::string> splat = {"splat",       scene,      cache,           "--pixel-samples",
                                        "1",           "--direct", "none",          "--misses",
                                        path("m.csv"), "-o",       path("pass.exr")};
      splat.insert(splat.end(), view.begin(), view.end());
      must(splat);
      const std::string csv = slurp(path("m.csv"));
      if (std::count(csv.begin(), csv.end(), '\n') == 1) return pass;
      must({"irradiance", scene, photons, "--at", path("m.csv"), "--add-to", cache, "-o", cache});
    }
    return -1;
  }
  /// name.exr and name.ref.exr, 32 pixels wide.
  static void make_picture_and_reference(const std::string& scene, const std::string& name,
                                         const char* samples = "512") {
    const std::string photons = path(name + ".photons"), cache = path(name + ".irradiance");
    must({"photons", scene, "--photons", "200000", "-o", photons});
    must({"irradiance", scene, photons, "-o", cache});
    ASSERT_GT(fill(scene, photons, cache, {"--width", "32", "--pixel-samples", "16"}), 0);
    must({"splat", scene, cache, "--width", "32", "--pixel-samples", "16", "--light-samples", "64", "-o",
          path(name + ".exr")});
    must({"reference", scene, "--width", "32", "--samples", samples, "-o", path(name + ".ref.exr")});
  }
  static LayerMetrics compare_layer(const Image& image, const Image& reference, const std::string& layer) {
    const auto metrics = compare_images(image, reference, {{layer}, false});
    EXPECT_EQ(metrics[0].non_finite, 0u);
    return metrics[0];
  }
  /// Relative RMSE of scattered light beyond the reference's own noise: sqrt(mean(d2 - stderr2)) / mean.
  static double error_beyond_noise(const Image& image, const Image& reference) {
    const std::vector<Rgb> light = image.rgb("indirect"), truth = reference.rgb("indirect"),
                           noise = reference.rgb("indirect_stderr");
    double sum = 0, mean = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      const DVec3 d(light[i] - truth[i]), e(noise[i]);
      sum += glm::dot(d, d) - glm::dot(e, e);
      mean += static_cast<double>(truth[i].x + truth[i].y + truth[i].z);
    }
    const auto n = static_cast<double>(3 * light.size());
    return std::sqrt(std::max(sum / n, 0.0)) / (mean / n);
  }
  static std::string* folder_;
};
std::string* Steps::folder_ = nullptr;

TEST_F(Steps, ShardsMergeToTheWholeAndGiveTheSameCache) {
  const std::string scene = data("cornell-measured.glb");
  must({"photons", scene, "--photons", "20000", "-o", path("whole.photons")});
  for (const char* shard : {"3", "1", "2"})
    must({"photons", scene, "--photons", "20000", "--shard", std::string(shard) + "/3", "-o",
          path(std::string("part") + shard)});
  must({"merge", path("part2"), path("part3"), path("part1"), "-o", path("merged.photons")});
  EXPECT_EQ(slurp(path("merged.photons")), slurp(path("whole.photons")));
  must({"irradiance", scene, path("whole.photons"), "--threads", "1", "-o", path("whole.irradiance")});
  must({"irradiance", scene, path("merged.photons"), "--threads", "2", "-o", path("merged.irradiance")});
  EXPECT_EQ(slurp(path("merged.irradiance")), slurp(path("whole.irradiance")));
}

TEST_F(Steps, AnotherCameraUsesAndExtendsTheSameCache) {
  const std::string scene = data("cornell-measured.glb");
  const std::vector<std::string> left = {"--camera", "left-view", "--width", "48", "--pixel-samples", "1"};
  must({"photons", scene, "--photons", "20000", "-o", path("c.photons")});
  must({"irradiance", scene, path("c.photons"), "-o", path("c.irradiance")});
  const std::string before = slurp(path("c.irradiance"));
  ASSERT_GT(fill(scene, path("c.photons"), path("c.irradiance"), {"--width", "48", "--pixel-samples", "1"}),
            0);
  must({"splat", scene, path("c.irradiance"), "--width", "48", "--pixel-samples", "1", "-o",
        path("front.exr")});
  const int passes = fill(scene, path("c.photons"), path("c.irradiance"), left);
  ASSERT_GT(passes, 0);
  // What the first camera saw is as it was, to within what new neighbours add: earlier records are kept.
  must({"splat", scene, path("c.irradiance"), "--width", "48", "--pixel-samples", "1", "-o",
        path("again.exr")});
  const LayerMetrics m =
      compare_layer(read_image(path("again.exr")), read_image(path("front.exr")), "indirect");
  EXPECT_LT(m.relative_rmse, 0.1);
  EXPECT_LT(std::fabs(m.relative_bias), 0.01);
}

/// Indirect light of the Cornell box against path tracing. 200,000 paths leave records an error of 5 to 10 %,
/// more in corners; on average they are right.
TEST_F(Steps, CornellIndirectLightAgreesWithTheReference) {
  make_picture_and_reference(data("cornell-measured.glb"), "r");
  const Image image = read_image(path("r.exr")), reference = read_image(path("r.ref.exr"));
  EXPECT_FALSE(image.has_layer("glossy"));
  const LayerMetrics indirect = compare_layer(image, reference, "indirect");
  EXPECT_LT(std::fabs(indirect.relative_bias), 0.03);
  EXPECT_LT(error_beyond_noise(image, reference), 0.15);
  const LayerMetrics direct = compare_layer(image, reference, "direct");
  EXPECT_LT(std::fabs(direct.relative_bias), 0.01);
  EXPECT_LT(direct.relative_rmse, 0.12);
  const test::Run verdict =
      run_tool({"compare", path("r.exr"), path("r.ref.exr"), "--layer", "indirect", "--max-bias", "0.03"});
  EXPECT_EQ(verdict.code, 0) << verdict.err;
}

/// A Phong back wall (exponent 22): direct light shared between shadow rays and gloss rays, and what it
/// reflects of its surroundings.
TEST_F(Steps, GlossyCornellAgreesWithTheReference) {
  make_picture_and_reference(data("cornell-glossy22.glb"), "g");
  const Image image = read_image(path("g.exr")), reference = read_image(path("g.ref.exr"));
  ASSERT_TRUE(image.has_layer("glossy"));
  const LayerMetrics direct = compare_layer(image, reference, "direct");
  EXPECT_LT(std::fabs(direct.relative_bias), 0.01);
  EXPECT_LT(direct.relative_rmse, 0.25);  // a highlight, cut by the block before it
  const LayerMetrics indirect = compare_layer(image, reference, "indirect");
  EXPECT_LT(std::fabs(indirect.relative_bias), 0.03);
  EXPECT_LT(error_beyond_noise(image, reference), 0.2);
  const LayerMetrics glossy = compare_layer(image, reference, "glossy");
  EXPECT_LT(std::fabs(glossy.relative_bias), 0.05);
}

/// A mirror ball and a glass ball. The reference finds the light focused below the glass by chance alone, so
/// that it is noisy: means, and typical pixels.
TEST_F(Steps, MirrorAndGlassAgreeWithTheReference) {
  const std::string scene = shared("scenes/mcguire-cornellbox-sphere.glb");
  if (scene.empty()) GTEST_SKIP() << "the scene collection is not beside the project";
  make_picture_and_reference(scene, "s", "4096");
  const Image image = read_image(path("s.exr")), reference = read_image(path("s.ref.exr"));
  ASSERT_TRUE(image.has_layer("specular"));
  const LayerMetrics specular = compare_layer(image, reference, "specular");
  EXPECT_LT(std::fabs(specular.relative_bias), 0.05);
  EXPECT_LT(specular.mean_relative_error, 0.1);
  const LayerMetrics direct = compare_layer(image, reference, "direct");
  EXPECT_LT(std::fabs(direct.relative_bias), 0.01);
  const LayerMetrics indirect = compare_layer(image, reference, "indirect");
  EXPECT_LT(std::fabs(indirect.relative_bias), 0.05);
}

}  // namespace
}  // namespace phos::test
