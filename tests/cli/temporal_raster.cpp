// Films of drawn hemispheres (--estimate raster): what they are beside those of gathered rays, and what is
// refused of them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "file/container.h"
#include "file/json_parse.h"
#include "support/filmed_slabs.h"

namespace phos::test {
namespace {

std::vector<std::string> drawn(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--estimate", "raster", "--raster-side", "32"});
  return quick(arguments);
}

TEST(TemporalRaster, SameBytesOnAnyNumberOfThreads) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("raster-threads");
  for (const char* lives : {"midpoint", "rate"}) {
    std::string bytes;
    for (const char* threads : {"1", "3"}) {
      const std::string out = folder + "/" + lives + threads;
      const test::Run run =
          temporal(drawn({scene, "--frames", "30:34", "--lives", lives, "--threads", threads, "-o", out}));
      ASSERT_EQ(run.code, 0) << run.err;
      if (bytes.empty()) bytes = slurp(out);
      EXPECT_EQ(slurp(out), bytes) << lives;
    }
    const Container file = Container::open(folder + "/" + lives + std::string("1"), FileKind::irradiance);
    const Json parameters = file.provenance().parameters;
    EXPECT_EQ(parameters.find("estimate")->as_string(), "raster");
    EXPECT_EQ(parameters.find("raster-side")->as_integer(), 32);
    EXPECT_EQ(parameters.find("look-ahead")->as_string(), "trace");
    EXPECT_TRUE(file.has("irradiance_change"));
  }
}

TEST(TemporalRaster, OtherFilmsSayNothingOfIt) {
  const std::string film = scratch("raster-none") + "/f.irradiance";
  const test::Run run = temporal(quick({data("cube-in-a-box.glb"), "--frames", "30:31", "-o", film}));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json parameters = Container::open(film, FileKind::irradiance).provenance().parameters;
  EXPECT_EQ(parameters.find("raster-side"), nullptr);
  EXPECT_EQ(parameters.find("raster-border"), nullptr);
  EXPECT_EQ(parameters.find("look-ahead")->as_string(), "reproject");
}

TEST(TemporalRaster, StaticSceneGetsAnOrdinaryCache) {
  const std::string folder = scratch("raster-still"), out = folder + "/o.irradiance";
  const test::Run run = temporal(drawn({data("cornell-empty.glb"), "--frames", "0:3", "-o", out}));
  ASSERT_EQ(run.code, 0) << run.err;
  const Container file = Container::open(out, FileKind::irradiance);
  EXPECT_FALSE(file.has("birth"));
  EXPECT_GT(file.vectors("position").size(), 0u);
}

/// Columns of phos-sense by name.
std::map<std::string, std::vector<double>> table(const std::string& csv) {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> names;
  std::istringstream lines(csv);
  for (std::string line, cell; std::getline(lines, line);) {
    std::istringstream cells(line);
    const bool head = names.empty();
    for (std::size_t at = 0; std::getline(cells, cell, ','); ++at)
      if (head)
        names.push_back(cell);
      else
        columns[names.at(at)].push_back(std::atof(cell.c_str()));
  }
  return columns;
}

// Beside the film of gathered rays: the mean over points and frames, and every point within four stated
// errors and what 64 pixels a side leave between them (docs/methods.md#r1).
TEST(TemporalRaster, AgreesWithGatheredRays) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("raster-gather");
  spill(folder + "/p.csv",
        "x,y,z,nx,ny,nz\n0.6,0,0.6,0,1,0\n-0.6,0,-0.5,0,1,0\n0.2,2,-0.3,0,-1,0\n-0.5,2,0.5,0,-1,0\n"
        "0.4,1,-1,0,0,1\n-0.5,1.5,-1,0,0,1\n-1,0.8,0.2,1,0,0\n1,1.2,-0.2,-1,0,0\n");
  const auto seen = [&](const std::vector<std::string>& how) {
    std::vector<std::string> words{scene,
                                   "--frames",
                                   "100:104",
                                   "--place",
                                   "view",
                                   "--width",
                                   "16",
                                   "--photons",
                                   "50000",
                                   "--accuracy",
                                   "0.4",
                                   "-o",
                                   folder + "/f.irradiance",
                                   "--seed",
                                   "3"};
    words.insert(words.end(), how.begin(), how.end());
    const test::Run made = temporal(words);
    EXPECT_EQ(made.code, 0) << made.err;
    std::vector<std::map<std::string, std::vector<double>>> frames;
    for (const char* frame : {"100", "102", "104"}) {
      const test::Run run = run_tool({"sense", scene, folder + "/f.irradiance", "--frame", frame, "--points",
                                      folder + "/p.csv", "--quiet", "-o", folder + "/lux.csv"});
      EXPECT_EQ(run.code, 0) << run.err;
      frames.push_back(table(slurp(folder + "/lux.csv")));
    }
    return frames;
  };
  const auto rays = seen({"--estimate", "gather", "--rays", "1024"});
  const auto raster = seen({"--estimate", "raster", "--raster-side", "64"});
  double sum_of_rays = 0, sum_of_raster = 0;
  for (std::size_t f = 0; f < rays.size(); ++f) {
    const std::vector<double>&a = rays[f].at("indirect_lx"), &b = raster[f].at("indirect_lx");
    const std::vector<double>&s = rays[f].at("stderr_lx"), &t = raster[f].at("stderr_lx");
    ASSERT_EQ(a.size(), 8u);
    ASSERT_EQ(b.size(), 8u);
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum_of_rays += a[i], sum_of_raster += b[i];
      EXPECT_NEAR(b[i], a[i], 4 * std::hypot(s[i], t[i]) + 0.06 * a[i]) << "frame " << f << ", point " << i;
    }
  }
  EXPECT_NEAR(sum_of_raster / sum_of_rays, 1, 0.02);
}

/// A radiance film of drawn hemispheres: same bytes on any number of threads, and read by phos-splat.
TEST(TemporalRaster, RadianceFilm) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  slabs.slab("tray", 1, 0, 0.2f, 0, waxed());
  const std::string scene = slabs.write("raster-gloss", 17), folder = scratch("raster-gloss-out");
  for (const char* lives : {"midpoint", "rate"}) {
    std::string bytes;
    for (const char* threads : {"1", "3"}) {
      const std::string out = folder + "/" + lives + threads;
      const test::Run run = temporal(drawn({scene, "--frames", "0:4", "--kind", "radiance", "--lives", lives,
                                            "--threads", threads, "-o", out}));
      ASSERT_EQ(run.code, 0) << run.err;
      if (bytes.empty()) bytes = slurp(out);
      EXPECT_EQ(slurp(out), bytes) << lives;
    }
    const Container file = Container::open(folder + "/" + lives + std::string("1"), FileKind::radiance);
    EXPECT_TRUE(file.has("birth"));
    EXPECT_EQ(file.provenance().parameters.find("estimate")->as_string(), "raster");
  }
  const test::Run splat = run_tool({"splat", scene, folder + "/midpoint1", "--frames", "2:3", "--width", "24",
                                    "-o", folder + "/%02d.exr"});
  EXPECT_EQ(splat.code, 0) << splat.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/03.exr"));
}

TEST(TemporalRaster, RefusesWhatDoesNotGoTogether) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("raster-refuses"),
                    out = folder + "/o.irradiance";
  const auto refused = [&](std::vector<std::string> more, const std::string& option,
                           const std::string& words) {
    std::vector<std::string> asked{scene, "--frames", "0:3", "--estimate", "raster", "-o", out};
    asked.insert(asked.end(), more.begin(), more.end());
    const test::Run run = temporal(asked);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_EQ(run.err.rfind("phos-temporal: " + option, 0), 0u) << run.err;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  };
  refused({"--lives", "rate", "--look-ahead", "reproject"}, "--look-ahead", "give trace or none");
  refused({"--gradients", "hybrid"}, "--gradients", "analytic, none");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace phos::test
