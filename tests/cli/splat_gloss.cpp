// phos-splat with radiance records: files, choices, misses and what goes wrong.
#include <gtest/gtest.h>

#include "image/image.h"
#include "support/refused.h"

namespace phos::test {
namespace {

class SplatGloss : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::string(scratch("cli-splat-gloss"));
    const std::string scene = data("cornell-glossy22.glb");
    done({"photons", scene, "--photons", "5000", "-o", path("a.photons")});
    done({"irradiance", scene, path("a.photons"), "-o", path("a.irradiance")});
    done({"brdf", scene, "-o", path("a.brdf")});
    done({"brdf", scene, "--max-order", "5", "--too-sharp", "cut", "-o", path("low.brdf")});
    for (const std::string name : {"a", "low"})
      done({"radiance", scene, path("a.photons"), path(name + ".brdf"), "--rays", "256", "--accuracy", "0.4",
            "-o", path(name + ".radiance")});
    std::vector<std::string> traced =
        words({path("a.irradiance"), "--gloss-samples", "64", "-o", path("traced.exr")});
    traced.insert(traced.begin(), "splat");
    done(traced);
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
  }
  static std::string path(const std::string& name) { return *folder_ + "/" + name; }
  static void done(std::vector<std::string> words) {
    words.push_back("--quiet");
    const test::Run run = run_tool(words);
    ASSERT_EQ(run.code, 0) << words[0] << run.err;
  }
  static std::vector<std::string> words(const std::vector<std::string>& more,
                                        const std::string& scene = "cornell-glossy22.glb") {
    std::vector<std::string> all{data(scene), "--width", "48", "--pixel-samples", "1", "--splat", "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static test::Run splat(const std::vector<std::string>& more,
                         const std::string& scene = "cornell-glossy22.glb") {
    std::vector<std::string> all = words(more, scene);
    all.insert(all.begin(), "splat");
    return run_tool(all);
  }
  /// Sum of luminances.
  static double glossy_light(const std::string& name) {
    double sum = 0;
    for (const Rgb& c : read_image(path(name)).rgb("glossy")) sum += static_cast<double>(luminance(c));
    return sum;
  }
  static std::string* folder_;
};
std::string* SplatGloss::folder_ = nullptr;

TEST_F(SplatGloss, ReadsRecordsInPlaceOfRays) {
  const test::Run run = splat({path("a.irradiance"), path("a.radiance"), path("a.brdf"), "--stats",
                               path("s.json"), "-o", path("cached.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string stats = slurp(path("s.json"));
  for (const char* word : {"gloss splat", "gloss pairs", "gloss lookups", "\"why\"", "back-glossy"})
    EXPECT_NE(stats.find(word), std::string::npos) << word;
  EXPECT_GT(glossy_light("cached.exr"), 0);
  EXPECT_NEAR(glossy_light("cached.exr") / glossy_light("traced.exr"), 1, 0.15);
}

/// OpenGL draws the same.
TEST_F(SplatGloss, ByOpenGl) {
  const std::vector<std::string> all{path("a.irradiance"), path("a.radiance"), path("a.brdf"), "--quiet"};
  for (const std::string by : {"cpu", "gl"}) {
    std::vector<std::string> more = all;
    more.insert(more.end(), {"--gloss-splat", by, "-o", path(by + ".exr")});
    ASSERT_EQ(splat(more).code, 0);
  }
  EXPECT_NEAR(glossy_light("gl.exr") / glossy_light("cpu.exr"), 1, 1e-4);
}

TEST_F(SplatGloss, TellsFilesByContentInAnyOrderAndProjectsLobesItself) {
  std::filesystem::copy_file(path("a.radiance"), path("b.irradiance"));
  const test::Run run = splat({path("b.irradiance"), path("a.irradiance"), "-o", path("any.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("projected here"), std::string::npos) << run.err;
  EXPECT_GT(max_component(read_image(path("any.exr")).rgb("glossy")[16 * 48 + 24]), 0);
}

/// Records of radiance are records of irradiance too.
TEST_F(SplatGloss, RadianceAlone) {
  const test::Run run = splat({path("a.radiance"), "-o", path("alone.exr"), "--overlay", "records"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("records drawn"), std::string::npos) << run.err;
  const Image alone = read_image(path("alone.exr"));
  const std::size_t back_wall = 16 * 48 + 24;
  EXPECT_GT(max_component(alone.rgb("glossy")[back_wall]), 0);
  EXPECT_GT(max_component(alone.rgb("indirect")[back_wall]), 0);
}

TEST_F(SplatGloss, MissesAreTracedCountedAndWritten) {
  const test::Run run = splat({path("a.irradiance"), path("a.radiance"), path("a.brdf"), "--accuracy", "0.02",
                               "--gloss-misses", path("m.csv"), "-o", path("few.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("glossy points without a radiance record"), std::string::npos) << run.err;
  const std::string csv = slurp(path("m.csv"));
  EXPECT_EQ(csv.rfind("x,y,z,nx,ny,nz\n", 0), 0u);
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 100);
  ASSERT_EQ(splat({path("a.irradiance"), "--accuracy", "0.02", "--gloss-samples", "64", "-o",
                   path("none.exr"), "--quiet"})
                .code,
            0);
  EXPECT_NEAR(glossy_light("few.exr") / glossy_light("none.exr"), 1, 0.2) << "never dark";
  const test::Run warned = splat({path("a.irradiance"), path("a.radiance"), path("a.brdf"), "--accuracy",
                                  "0.02", "-o", path("few.exr")});
  EXPECT_NE(warned.err.find("--gloss-misses"), std::string::npos) << warned.err;
  done({"radiance", data("cornell-glossy22.glb"), path("a.photons"), path("a.brdf"), "--at", path("m.csv"),
        "--add-to", path("a.radiance"), "-o", path("more.radiance")});
}

TEST_F(SplatGloss, FewerBandsThanTheLobesWant) {
  expect_refused("splat", words({path("low.radiance"), path("a.brdf"), "-o", path("no.exr")}), 4,
                 "--allow-mismatch");
  EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
  const test::Run cut =
      splat({path("low.radiance"), path("a.brdf"), "--allow-mismatch", "-o", path("cut.exr"), "--quiet"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_GT(max_component(read_image(path("cut.exr")).rgb("glossy")[16 * 48 + 24]), 0);
  EXPECT_EQ(splat({path("low.radiance"), path("low.brdf"), "-o", path("low.exr"), "--quiet"}).code, 0);
}

TEST_F(SplatGloss, Refusals) {
  expect_refused("splat", words({path("a.irradiance"), "--gloss", "cached", "-o", path("no.exr")}), 2,
                 "phos-radiance");
  expect_refused("splat", words({path("a.brdf"), "-o", path("no.exr")}), 3, "phos-irradiance");
  expect_refused("splat", words({path("a.radiance"), "-o", path("no.exr")}, "cornell-measured.glb"), 4,
                 "scene");
  expect_refused("splat", words({path("a.radiance"), "--gloss", "often", "-o", path("no.exr")}), 2, "gloss");
  expect_refused(
      "splat", words({path("a.radiance"), "--gloss-misses", path("m2.csv"), "--reuse", "-o", path("no.exr")}),
      2, "--gloss-misses");
  spill(path("cut.radiance"), slurp(path("a.radiance")).substr(0, 5000));
  expect_refused("splat", words({path("cut.radiance"), "-o", path("no.exr")}), 3, "cut.radiance");
}

TEST_F(SplatGloss, NothingGlossy) {
  done({"photons", data("cornell-measured.glb"), "--photons", "5000", "-o", path("m.photons")});
  done({"irradiance", data("cornell-measured.glb"), path("m.photons"), "-o", path("m.irradiance")});
  done({"radiance", data("cornell-measured.glb"), path("m.photons"), "-o", path("m.radiance")});
  const test::Run run =
      splat({path("m.irradiance"), path("m.radiance"), "--gloss", "cached", "-o", path("matt.exr")},
            "cornell-measured.glb");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the scene has no gloss"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace phos::test
