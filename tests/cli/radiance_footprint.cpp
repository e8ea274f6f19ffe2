// phos-radiance --footprint adaptive, and who reads such caches.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "file/container.h"
#include "image/image.h"
#include "support/refused.h"
#include "support/run.h"

namespace phos::test {
namespace {

std::string scene() { return data("cornell-glossy22.glb"); }

/// A folder with photons and lobes of the Cornell box whose back wall is glossy, made once.
const std::string& folder() {
  static const std::string path = [] {
    const std::string f = scratch("radiance-footprint");
    EXPECT_EQ(run_tool({"photons", scene(), "--photons", "40000", "-o", f + "/c.photons"}).code, 0);
    EXPECT_EQ(run_tool({"brdf", scene(), "-o", f + "/c.brdf"}).code, 0);
    return f;
  }();
  return path;
}
std::string at(const std::string& name) { return folder() + "/" + name; }

Run radiance(const std::string& out, std::vector<std::string> more) {
  more.insert(more.begin(), {"radiance", scene(), at("c.photons"), at("c.brdf"), "--rays", "256", "--place",
                             "view", "--width", "60", "-o", at(out)});
  return run_tool(more);
}
std::size_t records_in(const std::string& name) {
  return Container::open(at(name)).vectors("position").size();
}
const Json* parameter(const std::string& name, const char* option) {
  static std::map<std::string, Json> all;
  all.insert_or_assign(name, Container::open(at(name)).provenance().parameters);
  return all.at(name).find(option);
}

TEST(RadianceFootprint, SameBytesOnAnyThreads) {
  ASSERT_EQ(radiance("a", {"--footprint", "adaptive", "--threads", "1"}).code, 0);
  ASSERT_EQ(radiance("b", {"--footprint", "adaptive", "--threads", "3"}).code, 0);
  EXPECT_EQ(slurp(at("a")), slurp(at("b")));
  const Container file = Container::open(at("a"));
  file.verify();
  const std::size_t n = records_in("a");
  EXPECT_GT(n, 20u);
  const std::span<const float> length = file.values<float>("footprint_length", {n, 8});
  EXPECT_NE(*std::min_element(length.begin(), length.begin() + 8),
            *std::max_element(length.begin(), length.begin() + 8));
  EXPECT_EQ(parameter("a", "footprint")->as_string(), "adaptive");
  const test::Run again = radiance("a", {"--footprint", "adaptive", "--reuse"});
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
  const test::Run info = run_tool({"info", at("a"), "--verify"});
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_NE(run_tool({"info", at("a"), "--dump", "footprint_length"}).out.find("footprint_length.7"),
            std::string::npos);
}

TEST(RadianceFootprint, CirclesAreTheDefaultAndNotRecorded) {
  ASSERT_EQ(radiance("plain", {}).code, 0);
  ASSERT_EQ(radiance("named", {"--footprint", "circle"}).code, 0);
  EXPECT_EQ(slurp(at("plain")), slurp(at("named")));
  EXPECT_EQ(parameter("plain", "footprint"), nullptr);
  EXPECT_FALSE(Container::open(at("plain")).has("footprint_length"));
}

TEST(RadianceFootprint, RecordsThatAreAddedAreAlike) {
  ASSERT_EQ(radiance("first", {"--footprint", "adaptive", "--rho", "0.5"}).code, 0);
  spill(at("points.csv"), "x,y,z,nx,ny,nz\n0.2,0.2,0.5592,0,0,-1\n0.3,0.3,0.5592,0,0,-1\n");
  const auto add = [](const std::string& to, const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"radiance", scene(), at("c.photons"), at("c.brdf"), "--at", at("points.csv"),
                               "--place", "every", "--add-to", at(to), "-o", at(out)});
    return run_tool(more);
  };
  ASSERT_EQ(add("first", "second", {}).code, 0);
  EXPECT_EQ(records_in("second"), records_in("first") + 2);
  EXPECT_TRUE(Container::open(at("second")).has("footprint_length"));
  EXPECT_EQ(parameter("second", "rho")->as_number(), 0.5);
  expect_failure(add("first", "bad", {"--footprint", "circle"}), 4, "--footprint adaptive");
  ASSERT_EQ(radiance("round", {}).code, 0);
  expect_failure(add("round", "bad", {"--footprint", "adaptive"}), 4, "--footprint circle");
  EXPECT_FALSE(std::filesystem::exists(at("bad")));
}

TEST(RadianceFootprint, AreDrawnAlike) {
  ASSERT_EQ(radiance("drawn", {"--footprint", "adaptive"}).code, 0);
  ASSERT_EQ(run_tool({"irradiance", scene(), at("c.photons"), "-o", at("matt")}).code, 0);
  const auto draw = [](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"splat", scene(), at("matt"), at("drawn"), at("c.brdf"), "--width", "60",
                               "--pixel-samples", "1", "--direct", "none", "-o", at(out)});
    const test::Run run = run_tool(more);
    EXPECT_EQ(run.code, 0) << run.err;
    return read_image(at(out)).rgb("glossy");
  };
  const std::vector<Rgb> cpu = draw("cpu.exr", {"--splat", "cpu"}), gl = draw("gl.exr", {"--splat", "gl"});
  double sum = 0, off = 0;
  for (std::size_t i = 0; i < cpu.size(); ++i) {
    sum += static_cast<double>(luminance(cpu[i]));
    off += static_cast<double>(std::fabs(luminance(cpu[i] - gl[i])));
  }
  EXPECT_GT(sum, 0);
  EXPECT_LT(off, 0.002 * sum);  // but for a few pixels at edges, where surfaces are seen otherwise
}

TEST(RadianceFootprint, RefusesWhatDoesNotGoTogether) {
  const auto refuse = [&](std::vector<std::string> more, const std::string& word) {
    expect_failure(radiance("refused", std::move(more)), 2, word);
  };
  refuse({"--footprint", "adaptive", "--estimate", "hull"}, "--estimate gather");
  refuse({"--footprint", "adaptive", "--estimate", "raster"}, "--estimate gather");
  refuse({"--footprint", "circle-min"}, "adaptive");
  refuse({"--footprint", "adaptive", "--rho", "0"}, "--rho");
  EXPECT_FALSE(std::filesystem::exists(at("refused")));
}

/// The page draws discs alone.
TEST(RadianceFootprint, ThePageRefusesThem) {
  ASSERT_EQ(radiance("shown", {"--footprint", "adaptive"}).code, 0);
  ASSERT_EQ(run_tool({"irradiance", scene(), at("c.photons"), "-o", at("beside")}).code, 0);
  expect_failure(
      run_tool({"view", scene(), at("beside"), at("shown"), at("c.brdf"), "--static", at("p.html")}), 2,
      "--footprint circle");
  EXPECT_FALSE(std::filesystem::exists(at("p.html")));
}

}  // namespace
}  // namespace phos::test
