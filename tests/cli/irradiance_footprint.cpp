// phos-irradiance --footprint and --direct, and who reads such caches.
#include <gtest/gtest.h>

#include "file/container.h"
#include "image/image.h"
#include "support/cornell_photons.h"
#include "support/refused.h"

namespace phos::test {
namespace {

const std::string& folder() {
  static const std::string path = folder_with_photons("irradiance-footprint", "40000");
  return path;
}
std::string scene() { return data("cornell-measured.glb"); }
std::string at(const std::string& name) { return folder() + "/" + name; }

Run irradiance(const std::string& out, std::vector<std::string> more) {
  more.insert(more.begin(), {"irradiance", scene(), at("c.photons"), "--estimate", "gather", "--rays", "64",
                             "-o", at(out)});
  return run_tool(more);
}
Run view(const std::string& out, std::vector<std::string> more) {
  more.insert(more.end(), {"--place", "view", "--width", "40"});
  return irradiance(out, more);
}
std::size_t records_in(const std::string& name) {
  return Container::open(at(name)).vectors("position").size();
}
const Json* parameter(const Container& file, const char* name) {
  return file.provenance().parameters.find(name);
}

TEST(IrradianceFootprint, SameBytesOnAnyThreads) {
  ASSERT_EQ(view("a", {"--footprint", "adaptive", "--direct", "cached", "--threads", "1"}).code, 0);
  ASSERT_EQ(view("b", {"--footprint", "adaptive", "--direct", "cached", "--threads", "2"}).code, 0);
  EXPECT_EQ(slurp(at("a")), slurp(at("b")));
  const Container file = Container::open(at("a"));
  file.verify();
  EXPECT_TRUE(file.has("footprint_length"));
  EXPECT_EQ(parameter(file, "footprint")->as_string(), "adaptive");
  EXPECT_EQ(parameter(file, "paths")->as_string(), "all");
  EXPECT_EQ(file.provenance().extra.find("quantity")->as_string(), "all");
  // The option's name does not matter.
  ASSERT_EQ(view("c", {"--footprint", "adaptive", "--paths", "all"}).code, 0);
  EXPECT_EQ(slurp(at("a")), slurp(at("c")));
  const auto again = view("c", {"--footprint", "adaptive", "--paths", "all", "--reuse"});
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
  const auto info = run_tool({"info", at("a"), "--verify"});
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_NE(run_tool({"info", at("a"), "--dump", "footprint_slope"}).out.find("footprint_slope.r.7"),
            std::string::npos);
}

TEST(IrradianceFootprint, CirclesAreRecordedOnlyWhereTheyAreNotTheDefault) {
  ASSERT_EQ(view("plain", {}).code, 0);
  ASSERT_EQ(view("named", {"--footprint", "circle", "--direct", "traced"}).code, 0);
  EXPECT_EQ(slurp(at("plain")), slurp(at("named")));
  EXPECT_EQ(parameter(Container::open(at("plain")), "footprint"), nullptr);
  ASSERT_EQ(view("least", {"--footprint", "circle-min"}).code, 0);
  EXPECT_EQ(parameter(Container::open(at("least")), "footprint")->as_string(), "circle-min");
  ASSERT_EQ(view("radius", {"--radius", "least"}).code, 0);
  EXPECT_EQ(records_in("least"), records_in("radius"));
  ASSERT_EQ(view("harmonic", {"--footprint", "circle-harmonic"}).code, 0);
  EXPECT_GE(records_in("harmonic"), records_in("plain"));
}

TEST(IrradianceFootprint, AdaptiveOnesAreFew) {
  for (const std::string footprint : {"circle-min", "circle-harmonic", "adaptive"})
    ASSERT_EQ(irradiance(footprint, {"--footprint", footprint, "--place", "view", "--width", "160"}).code, 0);
  EXPECT_LT(4 * records_in("adaptive"), 3 * records_in("circle-min"));
  EXPECT_LT(4 * records_in("adaptive"), 3 * records_in("circle-harmonic"));
}

TEST(IrradianceFootprint, WhatIsAddedIsAlike) {
  ASSERT_EQ(view("first", {"--footprint", "adaptive", "--rho", "0.1"}).code, 0);
  spill(at("points.csv"), "x,y,z,nx,ny,nz\n0.2,0,0.4,0,1,0\n0.3,0,0.3,0,1,0\n0.5,0.2,0.0001,0,0,1\n");
  const auto add = [](const std::string& to, const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"irradiance", scene(), at("c.photons"), "--at", at("points.csv"), "--place",
                               "every", "--add-to", at(to), "-o", at(out)});
    return run_tool(more);
  };
  ASSERT_EQ(add("first", "second", {}).code, 0);
  ASSERT_EQ(add("second", "third", {}).code, 0);  // the second says as the first did
  EXPECT_EQ(records_in("third"), records_in("first") + 6);
  EXPECT_TRUE(Container::open(at("third")).has("footprint_length"));
  EXPECT_EQ(parameter(Container::open(at("third")), "rho")->as_number(), 0.1);
  expect_failure(add("first", "bad", {"--footprint", "circle"}), 4, "--footprint adaptive");
  expect_failure(add("first", "bad", {"--rho", "0.02"}), 4, "--rho 0.1");
  expect_failure(add("first", "bad", {"--direct", "cached"}), 4, "--paths indirect");
  ASSERT_EQ(view("round", {}).code, 0);
  expect_failure(add("round", "bad", {"--footprint", "adaptive"}), 4, "--footprint circle");
  EXPECT_FALSE(std::filesystem::exists(at("bad")));
}

TEST(IrradianceFootprint, PartsMakeTheWhole) {
  spill(at("some.csv"),
        "x,y,z,nx,ny,nz\n0.2,0,0.4,0,1,0\n0.3,0,0.3,0,1,0\n0.5,0.2,0.0001,0,0,1\n0.1,0,0.1,0,1,0\n");
  const auto make = [](const std::string& out, std::vector<std::string> more) {
    more.insert(more.end(), {"--footprint", "adaptive", "--at", at("some.csv"), "--place", "every"});
    const auto run = irradiance(out, more);
    EXPECT_EQ(run.code, 0) << run.err;
  };
  make("whole", {}), make("p1", {"--part", "1/2"}), make("p2", {"--part", "2/2"});
  ASSERT_EQ(run_tool({"merge", at("p2"), at("p1"), "-o", at("merged")}).code, 0);
  EXPECT_EQ(slurp(at("merged")), slurp(at("whole")));
}

TEST(IrradianceFootprint, AreDrawnAndReadAlike) {
  ASSERT_EQ(view("drawn", {"--footprint", "adaptive", "--direct", "cached"}).code, 0);
  const auto gl = run_tool({"splat", scene(), at("drawn"), "--width", "40", "-o", at("gl.exr")});
  ASSERT_EQ(gl.code, 0) << gl.err;
  ASSERT_EQ(run_tool({"splat", scene(), at("drawn"), "--width", "40", "--splat", "cpu", "--threads", "1",
                      "-o", at("cpu.exr")})
                .code,
            0);
  ASSERT_EQ(
      run_tool({"splat", scene(), at("drawn"), "--width", "40", "--leak-test", "ray", "-o", at("look.exr")})
          .code,
      0);
  const Image drawn = read_image(at("gl.exr")), cpu = read_image(at("cpu.exr")),
              looked = read_image(at("look.exr"));
  double sum = 0, by_other = 0, off = 0;
  for (std::size_t i = 0; i < drawn.rgb("").size(); ++i) {
    sum += static_cast<double>(luminance(drawn.rgb("")[i]));
    by_other += static_cast<double>(std::fabs(luminance(drawn.rgb("")[i] - cpu.rgb("")[i])));
    off += static_cast<double>(std::fabs(luminance(drawn.rgb("")[i] - looked.rgb("")[i])));
  }
  EXPECT_LT(by_other, 0.002 * sum);  // but for a few pixels at edges, where surfaces are seen otherwise
  EXPECT_LT(off, 0.03 * sum);        // rays keep some records out
  spill(at("sensor.csv"), "x,y,z,nx,ny,nz\n0.45,0.0001,0.15,0,1,0\n");
  const auto sensed = run_tool({"sense", scene(), at("drawn"), "--points", at("sensor.csv")});
  EXPECT_EQ(sensed.code, 0) << sensed.err;
  // Records over it by eye: the picture's mean is about that of a hull cache with traced direct light.
  ASSERT_EQ(run_tool({"irradiance", scene(), at("c.photons"), "-o", at("hull")}).code, 0);
  ASSERT_EQ(run_tool({"splat", scene(), at("hull"), "--width", "40", "-o", at("hull.exr")}).code, 0);
  double hull = 0;
  for (const Rgb& c : read_image(at("hull.exr")).rgb("")) hull += static_cast<double>(luminance(c));
  EXPECT_NEAR(sum / hull, 1, 0.05);
}

TEST(IrradianceFootprint, RefusesWhatDoesNotGoTogether) {
  const std::string out = at("refused");
  const auto refuse = [&](std::vector<std::string> more, const std::string& word) {
    more.insert(more.begin(), {"irradiance", scene(), at("c.photons"), "-o", out});
    expect_failure(run_tool(more), 2, word);
  };
  refuse({"--footprint", "adaptive"}, "--estimate gather");
  refuse({"--footprint", "adaptive", "--estimate", "raster"}, "--estimate gather");
  refuse({"--footprint", "circle-min"}, "--estimate gather");
  refuse({"--footprint", "square"}, "circle-harmonic");
  refuse({"--footprint", "adaptive", "--estimate", "gather", "--rho", "0"}, "--rho");
  refuse({"--direct", "cached", "--paths", "all"}, "give one of the two");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace phos::test
