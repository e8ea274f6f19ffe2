// --environment-mode from the command line.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

class Harmonics : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratch("splat-harmonics");
    write_scene("open", 8);
    run({"photons", path("open.obj"), "--photons", "20000", "-o", path("a.photons")});
    run({"irradiance", path("open.obj"), path("a.photons"), "-o", path("a.irradiance")});
    run({"brdf", path("open.obj"), "--error", "0.001", "--max-order", "16", "-o", path("a.brdf")});
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  /// A glossy sheet in the open.
  void write_scene(const std::string& name, int exponent) const {
    spill(path(name + ".obj"),
          "mtllib " + name +
              ".mtl\nusemtl glossy\no ground\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n");
    spill(path(name + ".mtl"),
          text("newmtl glossy\nKd 0.2 0.3 0.4\nKs 0.5 0.5 0.5\nNs ", exponent, "\nillum 2\n"));
    spill(path(name + ".lights.json"),
          R"({"cameras": [{"name": "eye", "eye": [0, 1.5, 1.5], "target": [0, 0, 0], "yfov_deg": 30}]})");
  }
  void run(std::vector<std::string> words) const {
    words.insert(words.end(), {"--environment", data("sky.hdr")});
    const test::Run done = run_tool(words);
    EXPECT_EQ(done.code, 0) << done.err;
  }
  void splat(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"splat",
                                      path("open.obj"),
                                      path("a.irradiance"),
                                      path("a.brdf"),
                                      "--pixel-samples",
                                      "1",
                                      "--width",
                                      "24",
                                      "-o",
                                      path(name)};
    words.insert(words.end(), more.begin(), more.end());
    run(words);
  }
  /// Mean |difference| of the direct light over its mean.
  double error(const std::string& name, const std::string& truth) const {
    const std::vector<Rgb> a = read_image(path(name)).rgb("direct"),
                           b = read_image(path(truth)).rgb("direct");
    double off = 0, sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      off += static_cast<double>(std::fabs(a[i].y - b[i].y)), sum += static_cast<double>(b[i].y);
    return off / sum;
  }
  std::string folder_;
};

/// The sky of data/ has small lights: they ask for more bands than a lobe of this breadth has energy in.
TEST_F(Harmonics, AgreeWithTheReference) {
  splat("hsh.exr", {"--environment-mode", "hsh", "--environment-order", "16"});
  splat("coarse.exr", {"--environment-mode", "sh", "--environment-order", "4"});
  splat("traced.exr", {"--light-samples", "1024", "--gloss-samples", "256"});
  run({"reference", path("open.obj"), "--width", "24", "--samples", "1024", "-o", path("r.exr")});
  const double hsh = error("hsh.exr", "r.exr"), traced = error("traced.exr", "r.exr");
  RecordProperty("hsh", std::to_string(hsh));
  RecordProperty("traced", std::to_string(traced));
  EXPECT_LT(hsh, 0.03);
  EXPECT_LT(traced, 0.03);
  EXPECT_GT(error("coarse.exr", "r.exr"), 2 * hsh);
}

TEST_F(Harmonics, SameBytesOnAnyNumberOfThreads) {
  splat("1.exr", {"--environment-mode", "hsh", "--splat", "cpu", "--threads", "1"});
  splat("3.exr", {"--environment-mode", "hsh", "--splat", "cpu", "--threads", "3"});
  EXPECT_EQ(slurp(path("1.exr")), slurp(path("3.exr")));
}

TEST_F(Harmonics, RefuseWhatDoesNotFit) {
  const std::string sky = data("sky.hdr");
  const auto refused = [&](std::vector<std::string> more, int code, const std::string& word) {
    more.insert(more.end(), {"--environment-mode", "hsh", "-o", path("no.exr"), "--width", "8"});
    expect_refused("splat", more, code, word);
    EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
  };
  const std::string scene = path("open.obj"), cache = path("a.irradiance");
  refused({scene, cache, "--environment", sky, "--environment-order", "0"}, 2, "--environment-order");
  refused({scene, cache, "--environment", sky, "--environment-order", "200"}, 2, "--environment-order");
  refused({scene, cache, "--environment", sky, "--direct", "interleaved"}, 2, "--direct traced");
  refused({scene, path("a.brdf"), "--environment", sky}, 3, "not an irradiance cache");
  refused({scene, path("a.photons"), "--environment", sky}, 3, "photons");
  // Tables of another material.
  write_scene("other", 9);
  run({"brdf", path("other.obj"), "-o", path("other.brdf")});
  refused({scene, cache, path("other.brdf"), "--environment", sky}, 4, "other.brdf");
  // No environment: neither has the cache's scene one, with --allow-mismatch.
  refused({scene, cache, "--allow-mismatch"}, 2, "no environment");
}

}  // namespace
