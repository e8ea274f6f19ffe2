// --gl as a user meets it: pictures and records by EGL beside those by OSMesa, and machines without EGL.
#include <gtest/gtest.h>

#include <cmath>

#include "file/container.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/script.h"

namespace phos::test {
namespace {

const std::string kInstead = "; OSMesa draws instead\n";

class SplatGl : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::string(scratch("cli-splat-gl"));
    must({"photons", scene(), "--photons", "20000", "-o", path("a.photons")});
    must({"irradiance", scene(), path("a.photons"), "-o", path("a.irradiance")});
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
  }
  static std::string scene() { return data("cornell-measured.glb"); }
  static std::string path(const std::string& name) { return *folder_ + "/" + name; }
  static test::Run must(std::vector<std::string> arguments) {
    arguments.push_back("--quiet");
    const test::Run run = run_tool(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return run;
  }
  /// A small picture, drawn by OpenGL.
  static std::vector<std::string> picture(const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"splat",   scene(), path("a.irradiance"), "--splat", "gl",
                                 "--width", "64",    "--pixel-samples",    "1",       "-o",
                                 path(out)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// The same on a machine with these settings.
  static test::Run with(const std::string& setting, std::vector<std::string> arguments) {
    arguments[0] = std::string(PHOS_TOOLS) + "/phos-" + arguments[0];
    arguments.insert(arguments.begin(), {"/usr/bin/env", setting});
    return run_shell(arguments, *folder_);
  }
  static std::string* folder_;
};
std::string* SplatGl::folder_ = nullptr;

TEST_F(SplatGl, PictureByEglIsThatByOsmesa) {
  const test::Run egl = must(picture("egl.exr", {"--gl", "egl", "--direct", "shadow-map"}));
  if (egl.err.ends_with(kInstead)) GTEST_SKIP() << egl.err;
  EXPECT_EQ(egl.err, "");
  must(picture("osmesa.exr", {"--direct", "shadow-map"}));
  const Image a = read_image(path("egl.exr")), b = read_image(path("osmesa.exr"));
  for (const char* channel : {"R", "G", "B", "direct.G", "indirect.G", "illuminance.Y", "weight.Y"}) {
    double off = 0, light = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < b.channel(channel).size(); ++i) {
      const double is = static_cast<double>(a.channel(channel)[i]),
                   should = static_cast<double>(b.channel(channel)[i]);
      beyond += std::fabs(is - should) > 1e-3 * std::fabs(should);
      off += is - should, light += should;
    }
    EXPECT_LE(beyond, b.channel(channel).size() / 50) << channel << ": only pixels on edges";
    EXPECT_GT(light, 0) << channel;
    EXPECT_LT(std::fabs(off), 1e-3 * light) << channel;
  }
  const auto recorded = [](const Image& image) {
    return parse_json(image.attributes.at("phos.parameters"), "parameters");
  };
  EXPECT_EQ(recorded(b).find("gl"), nullptr);
  ASSERT_NE(recorded(a).find("gl"), nullptr);
}

TEST_F(SplatGl, SaysWhatDraws) {
  const test::Run run = run_tool(picture("says.exr", {"--gl", "egl"}));
  if (run.err.find(kInstead) != run.err.npos) GTEST_SKIP() << run.err;
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.err.rfind("phos-splat: OpenGL by EGL: ", 0), 0u) << run.err;
  const test::Run again = run_tool(picture("says.exr", {"--gl", "egl", "--reuse"}));
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
}

TEST_F(SplatGl, RecordsThatEglDraws) {
  const auto drawn = [](const std::string& out, const std::string& gl) {
    return must({"irradiance", scene(), path("a.photons"), "--estimate", "raster", "--raster-side", "16",
                 "--place", "view", "--width", "24", "--gl", gl, "-o", path(out)});
  };
  const test::Run egl = drawn("egl.irradiance", "egl");
  if (egl.err.ends_with(kInstead)) GTEST_SKIP() << egl.err;
  drawn("osmesa.irradiance", "osmesa");
  const Container a = Container::open(path("egl.irradiance"), FileKind::irradiance),
                  b = Container::open(path("osmesa.irradiance"), FileKind::irradiance);
  const auto light = [](const Container& file) {
    double sum = 0;
    for (const Vec3& e : file.vectors("irradiance")) sum += static_cast<double>(e.x + e.y + e.z);
    return sum / static_cast<double>(file.vectors("irradiance").size());
  };
  EXPECT_GT(light(b), 0);
  EXPECT_NEAR(light(a) / light(b), 1, 0.01) << "another pixel on an edge moves a record's radius";
  EXPECT_EQ(b.provenance().parameters.find("gl"), nullptr);
  ASSERT_NE(a.provenance().parameters.find("gl"), nullptr);
  EXPECT_EQ(a.provenance().parameters.find("gl")->as_string(), "egl");
}

/// OSMesa stands in, with a word, and the file is the one that it makes.
TEST_F(SplatGl, WithoutEgl) {
  must(picture("without.exr"));
  const std::string empty = scratch("cli-splat-gl-empty");
  spill(empty + "/libEGL.so.1", "no library");
  for (const std::string& setting : {"LD_LIBRARY_PATH=" + empty, "__EGL_VENDOR_LIBRARY_DIRS=" + empty}) {
    const test::Run run = with(setting, picture("instead.exr", {"--gl", "egl", "--quiet"}));
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_EQ(run.err.rfind("phos-splat: warning: --gl egl: ", 0), 0u) << run.err;
    EXPECT_TRUE(run.err.ends_with(kInstead)) << run.err;
    EXPECT_EQ(slurp(path("instead.exr")), slurp(path("without.exr"))) << setting;
  }
}

TEST_F(SplatGl, AnotherWord) {
  const test::Run run = run_tool(picture("no.exr", {"--gl", "glx"}));
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_NE(run.err.find("is not one of: osmesa, egl"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
}

}  // namespace
}  // namespace phos::test
