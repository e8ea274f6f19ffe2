// Daylight through the programs: stages agree with the reference, files know their sky, bad words are
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kRoom = data("daylight-room.obj");
using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A column of a table.
std::vector<double> column(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream names(line);
  int at = -1;
  for (int i = 0; std::getline(names, cell, ','); ++i)
    if (cell == name) at = i;
  EXPECT_GE(at, 0) << name << " in " << line;
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (int i = 0; i <= at; ++i) std::getline(cells, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

/// Photons, records and sensors against path tracing, under an overcast sky and with the sun in the room.
TEST(DaylightTools, AgreeWithTheReference) {
  const std::string f = scratch("daylight-agree");
  const std::string points = f + "/points.csv";
  spill(points,
        "x,y,z,nx,ny,nz\n2.5,0.001,4.5,0,1,0\n1.2,0.85,3,0,1,0\n4,0.85,1,0,1,0\n2.5,1.5,0.002,0,0,1\n");
  for (const Words& sky : {Words{"--sky", "overcast"}, Words{"--sky", "clear", "--sun", "160,35"}}) {
    const std::string photons = f + "/a.photons", records = f + "/a.irradiance";
    ASSERT_EQ(
        run_tool(Words{"photons", kRoom, "--photons", "400000", "--portals", "auto", "-o", photons} + sky)
            .code,
        0);
    ASSERT_EQ(run_tool(Words{"irradiance", kRoom, photons, "--place", "surface", "-o", records} + sky).code,
              0);
    const auto cached =
        run_tool(Words{"sense", kRoom, records, "--points", points, "--light-samples", "4096"} + sky);
    ASSERT_EQ(cached.code, 0) << cached.err;
    const auto traced = run_tool(Words{"sense", kRoom, "--exact", "--samples", "100000", "--points", points,
                                       "--light-samples", "4096"} +
                                 sky);
    ASSERT_EQ(traced.code, 0) << traced.err;
    const auto lx = column(cached.out, "E_lx"), truth = column(traced.out, "E_lx");
    const auto error = column(cached.out, "stderr_lx"), truth_error = column(traced.out, "stderr_lx");
    ASSERT_EQ(lx.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(lx[i], truth[i], 4 * std::hypot(error[i], truth_error[i]) + 0.05 * truth[i]) << sky[1] << i;
  }
}

TEST(DaylightTools, MeasureDaylightFactors) {
  const Words grid = {"sense",    kRoom, "--grid",           "0.5", "--height", "0.85",
                      "--margin", "0.5", "--daylight-factor"};
  const auto run = run_tool(grid + Words{"--direct-only", "--sky", "overcast"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto lx = column(run.out, "E_lx"), factor = column(run.out, "daylight_factor_percent");
  ASSERT_GT(lx.size(), 50u);
  for (std::size_t i = 0; i < lx.size(); ++i) EXPECT_NEAR(factor[i], lx[i] / 100, 1e-4 * factor[i]);
  // Rays enough: no sensor of the grid is known to less than a fifth, and few to less than a tenth.
  const auto error = column(run.out, "daylight_factor_stderr_percent");
  std::size_t poor = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    EXPECT_LT(error[i], 0.2 * factor[i]) << i;
    poor += error[i] > 0.1 * factor[i];
  }
  EXPECT_LT(poor, error.size() / 10);
  EXPECT_NE(run.err.find("daylight factor: mean "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("of 10000 lx in the open"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("norm"), std::string::npos) << run.err;
  const auto brighter =
      run_tool(grid + Words{"--direct-only", "--sky", "overcast", "--sky-illuminance", "123"});
  const auto same = column(brighter.out, "daylight_factor_percent");
  for (std::size_t i = 0; i < factor.size(); ++i) EXPECT_NEAR(same[i], factor[i], 1e-4 * factor[i]);
  const auto clear =
      run_tool(grid + Words{"--direct-only", "--sky", "clear", "--sun", "180,40", "--sun-illuminance", "0"});
  EXPECT_EQ(clear.code, 0);
  EXPECT_NE(clear.err.find("defined under an overcast sky"), std::string::npos) << clear.err;
  Words words(grid.begin() + 1, grid.end());
  expect_refused("sense", words + Words{"--direct-only", "--sky", "clear", "--sun", "180,40"}, 2,
                 "a sun shines too");
  expect_refused("sense", words + Words{"--direct-only"}, 2, "needs a sky");
}

/// Shadow rays aimed at the windows: the same light, better known, and the caches are the same scene's.
TEST(DaylightTools, AimedSensorsReadTheSame) {
  for (const Words& sky : {Words{"--sky", "overcast"}, Words{"--sky", "clear", "--sun", "160,35"}}) {
    const Words grid =
        Words{"sense", kRoom, "--direct-only", "--grid", "1", "--height", "0.85", "--light-samples", "1024"} +
        sky;
    const auto blind = run_tool(grid), aimed = run_tool(grid + Words{"--portals", "auto"});
    ASSERT_EQ(blind.code + aimed.code, 0) << blind.err << aimed.err;
    const auto lx = column(blind.out, "E_lx"), aimed_lx = column(aimed.out, "E_lx");
    const auto error = column(blind.out, "stderr_lx"), aimed_error = column(aimed.out, "stderr_lx");
    std::size_t better = 0;
    for (std::size_t i = 0; i < lx.size(); ++i) {
      EXPECT_NEAR(lx[i], aimed_lx[i], 4.5 * std::hypot(error[i], aimed_error[i]) + 0.01 * aimed_lx[i]) << i;
      better += aimed_error[i] < 0.5 * error[i];
    }
    // Where the sun shines in, most of the noise is which samples are its.
    EXPECT_GT(better, lx.size() * (sky[1] == "overcast" ? 9 : 7) / 10) << sky[1];
  }
  const auto scene = run_tool({"scene", kRoom, "--sky", "overcast", "--portals", "auto"});
  EXPECT_NE(scene.out.find("let in through openings of 6."), std::string::npos) << scene.out << scene.err;
}

TEST(DaylightTools, RefuseCachesOfAnotherSky) {
  const std::string f = scratch("daylight-other"), photons = f + "/a.photons";
  const Words sky = {"--sky", "clear", "--sun", "160,35"};
  ASSERT_EQ(run_tool(Words{"photons", kRoom, "--photons", "1000", "-o", photons} + sky).code, 0);
  const auto refused = [&](const Words& other, const char* why) {
    expect_refused("irradiance", Words{kRoom, photons, "-o", f + "/a.irradiance"} + other, 4, why);
  };
  refused({"--sky", "overcast"}, "was made with --sky clear, not overcast");
  refused({"--sky", "clear", "--sun", "160,36"}, "was made with --sun 160,35, not 160,36");
  refused({"--sun", "160,36"}, "was made with --sun 160,35, not 160,36");
  refused({"--sky", "cie:12", "--sun", "160,36"}, "was made with --sun 160,35, not 160,36");
  refused(sky + Words{"--ground-albedo", "0.3"}, "without --ground-albedo 0.3");
  refused(sky + Words{"--north", "10"}, "without --north 10");
  refused(sky + Words{"--sun-illuminance", "50000"}, "without --sun-illuminance 50000");
  refused({"--location", "52.5,13.4", "--when", "2026-06-21T12:00+02:00"},
          "was made with --sky clear --sun 160,35 and without --location 52.5,13.4");
  refused({"--environment", data("sky.hdr")}, "not an environment map");
  const std::string dark = f + "/dark.photons";
  ASSERT_EQ(run_tool({"photons", data("cornell-measured.glb"), "--photons", "1000", "-o", dark}).code, 0);
  expect_refused("irradiance", Words{data("cornell-measured.glb"), dark, "-o", f + "/a.irradiance"} + sky, 4,
                 "was made without --sky");
  // The same said otherwise.
  const Words same = {"--sky", "cie:12", "--sun", "-200,35", "--ground-albedo", "0.2"};
  EXPECT_EQ(run_tool(Words{"irradiance", kRoom, photons, "-o", f + "/a.irradiance"} + same).code, 0);
}

/// What stands in the photons need not be said again: the same bytes, of every stage.
TEST(DaylightTools, StagesTakeTheSkyFromTheirCaches) {
  const std::string f = scratch("daylight-once");
  const Words sky = {"--sky", "clear", "--sun", "160,35", "--sky-illuminance", "12000", "--portals", "auto"};
  ASSERT_EQ(run_tool(Words{"photons", kRoom, "--photons", "20000", "-o", f + "/room.photons"} + sky).code, 0);
  const auto stage = [&](const Words& command, const std::string& from, const std::string& to) {
    const auto said = run_tool(command + Words{"-o", f + "/said" + to} + sky);
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.err.find("as of"), std::string::npos) << said.err;
    const auto silent = run_tool(command + Words{"-o", f + "/silent" + to});
    EXPECT_EQ(silent.code, 0) << silent.err;
    EXPECT_NE(silent.err.find("sky clear, sky-illuminance 12000, sun 160,35, portals auto: as of " + from),
              std::string::npos)
        << silent.err;
    EXPECT_EQ(slurp(f + "/said" + to), slurp(f + "/silent" + to)) << to;
  };
  const std::string photons = f + "/room.photons", records = f + "/said.irradiance";
  stage({"irradiance", kRoom, photons, "--place", "surface"}, photons, ".irradiance");
  stage({"irradiance", kRoom, photons, "--place", "surface", "--add-to", records}, photons,
        ".more.irradiance");
  stage({"splat", kRoom, records, "--width", "24", "--splat", "cpu"}, records, ".exr");
  stage({"sense", kRoom, records, "--grid", "1", "--height", "0.8"}, records, ".csv");
  // Nothing is to be made anew.
  const auto again = run_tool({"irradiance", kRoom, photons, "--place", "surface", "--reuse", "-o", records});
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
  expect_refused("sense", {kRoom, records, "--portals", "glass", "--grid", "1", "--height", "0.8"}, 4,
                 "was made with --portals auto, not glass");
}

/// The same bytes on any number of threads, and from shards.
TEST(DaylightTools, AimedPhotonsAreTheSameOnAnyThreads) {
  const std::string f = scratch("daylight-threads");
  const Words command = {"photons", kRoom,   "--photons", "20000",     "--sky",
                         "clear",   "--sun", "160,35",    "--portals", "auto"};
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(run_tool(command + Words{"--threads", threads, "-o", f + "/" + threads}).code, 0);
  EXPECT_EQ(slurp(f + "/1"), slurp(f + "/2"));
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(run_tool(command + Words{"--shard", shard, "-o", f + "/s" + shard[0]}).code, 0);
  ASSERT_EQ(run_tool({"merge", f + "/s1", f + "/s2", "-o", f + "/m"}).code, 0);
  EXPECT_EQ(slurp(f + "/m"), slurp(f + "/1"));
}

TEST(DaylightTools, RefuseBadWords) {
  const auto refused = [](const Words& words, const char* why) {
    expect_refused("photons", Words{kRoom, "-o", scratch("daylight-bad") + "/a.photons"} + words, 2, why);
  };
  refused({"--sky", "clear"}, "brighter about the sun");
  refused({"--sky", "azure"}, "\"azure\" is not a sky");
  refused({"--sky", "clear", "--sun", "10,-20"}, "20 degrees below the horizon");
  refused({"--sky", "clear", "--location", "52.5,13.4", "--when", "2026-06-21T01:00+02:00"},
          "below the horizon");
  refused({"--sky", "clear", "--location", "52.5,13.4", "--when", "yesterday"}, "give date, time and zone");
  refused({"--sky", "clear", "--location", "52.5,13.4"}, "--when: is missing");
  refused({"--sky", "overcast", "--environment", data("sky.hdr")}, "leave one of them out");
  refused({"--sky", "perez", "--sun", "180,40", "--direct-irradiance", "500", "--diffuse-irradiance", "9000"},
          "0.01 to 0.6");
  refused({"--sky", "overcast", "--ground-albedo", "1.5"}, "--ground-albedo");
  refused({"--sky", "overcast", "--portals", "window"}, "there is no node or material \"window\"");
  refused({"--portals", "auto"}, "aims the light of a sky, and the scene has no sky");
}

/// A closed scene: said by phos-scene and by phos-photons.
TEST(DaylightTools, SayThatNothingGetsIn) {
  const std::string f = scratch("daylight-closed");
  spill(f + "/box.obj",
        "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  spill(f + "/box.lights.json", R"({"cameras":[{"eye":[0.5,0.5,0.5],"target":[1,0.5,0.5]}]})");
  const auto lint = run_tool({"scene", f + "/box.obj", "--sky", "overcast"});
  EXPECT_NE((lint.out + lint.err).find("no light of the sky reaches the view"), std::string::npos)
      << lint.out << lint.err;
  const auto photons = run_tool({"photons", f + "/box.obj", "--sky", "overcast", "--photons", "1000",
                                 "--portals", "auto", "-o", f + "/a.photons"});
  EXPECT_EQ(photons.code, 0);
  EXPECT_NE(photons.err.find("no light of the sky reaches the view"), std::string::npos) << photons.err;
  EXPECT_NE(photons.err.find("no place sees the sky from within"), std::string::npos) << photons.err;
  const auto open = run_tool({"scene", kRoom, "--sky", "overcast"});
  EXPECT_EQ((open.out + open.err).find("reaches the view"), std::string::npos) << open.out << open.err;
}

}  // namespace
