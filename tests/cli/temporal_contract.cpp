// phos-temporal at the command line: what it makes, says and refuses, and what an interrupted film leaves.
#include <gtest/gtest.h>

#include <chrono>

#include "file/container.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/filmed_slabs.h"

namespace phos::test {
namespace {

void expect_failure(const Run& run, int code, const std::string& word) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_EQ(run.err.rfind("phos-temporal: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty());
}

TEST(Temporal, HelpVersionAndNoArguments) {
  const test::Run help = temporal({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* said : {"--frames", "--temporal-accuracy", "--max-life", "--lives", "--look-ahead",
                           "--kind", "--photons", "--raster-side"})
    EXPECT_NE(help.out.find(said), std::string::npos) << said;
  for (const char* of_no_film : {"--time", "--points"})
    EXPECT_EQ(help.out.find(of_no_film + std::string(" ")), std::string::npos) << of_no_film;
  EXPECT_EQ(temporal({"--version"}).code, 0);
  EXPECT_EQ(temporal({}).code, 2);
}

TEST(Temporal, RefusesInOneLine) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("temporal-refuses"),
                    out = folder + "/o.irradiance";
  expect_failure(temporal({scene, "-o", out}), 2, "--frames");
  expect_failure(temporal({scene, "--frames", "9:3", "-o", out}), 2, "9:3");
  expect_failure(temporal({scene, "--frames", "390:400", "-o", out}), 2, "399");
  expect_failure(temporal({scene, "--frames", "a:b", "-o", out}), 2, "a:b");
  expect_failure(temporal({scene, "--frames", "0:3", "--frame", "2", "-o", out}), 2, "--frame");
  expect_failure(temporal({scene, "--frames", "0:3", "--place", "given", "-o", out}), 2, "--place");
  expect_failure(temporal({scene, "--frames", "0:3", "--camera", "nobody", "-o", out}), 2, "nobody");
  expect_failure(temporal({scene, "--frames", "0:3", "--temporal-gradients", "extrapolated", "-o", out}), 2,
                 "--lives rate");
  expect_failure(temporal({scene, "--frames", "0:3", "--temporal-gradients", "none", "-o", out}), 2,
                 "--lives rate");
  expect_failure(temporal({scene, "--frames", "0:3", "--look-ahead", "none", "-o", out}), 2, "--lives rate");
  expect_failure(temporal({scene, "--frames", "0:3", "--lives", "rate", "--checks", "2", "-o", out}), 2,
                 "--checks");
  expect_failure(
      temporal({scene, "--frames", "0:3", "--footprint", "adaptive", "--estimate", "hull", "-o", out}), 2,
      "--estimate gather");
  expect_failure(
      temporal({scene, "--frames", "0:3", "--footprint", "circle-min", "--kind", "radiance", "-o", out}), 2,
      "--footprint");
  expect_failure(temporal({"nowhere.glb", "--frames", "0:3", "-o", out}), 3, "nowhere.glb");
  expect_failure(temporal({scene, "--frames", "0:3", "-o", folder + "/absent/o.irradiance"}), 3, "absent");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Temporal, StaticSceneGetsAnOrdinaryCache) {
  const std::string folder = scratch("temporal-still"), out = folder + "/o.irradiance";
  for (const std::string& scene : {data("cornell-empty.glb"), Slabs().write("temporal-camera-alone", 17)}) {
    const test::Run run = temporal(quick({scene, "--frames", "0:3", "-o", out}));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("no light changes"), std::string::npos) << run.err;
    const Container file = Container::open(out, FileKind::irradiance);
    EXPECT_FALSE(file.has("birth"));
    EXPECT_FALSE(file.provenance().extra.find("film"));
    EXPECT_GT(file.vectors("position").size(), 0u);
    const test::Run splat =
        run_tool({"splat", scene, out, "--frames", "2:3", "--width", "16", "-o", folder + "/%02d.exr"});
    EXPECT_EQ(splat.code, 0) << splat.err;
    EXPECT_TRUE(std::filesystem::exists(folder + "/03.exr"));
  }
}

TEST(Temporal, SameBytesOnAnyNumberOfThreads) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("temporal-threads");
  for (const char* lives : {"midpoint", "rate"}) {
    std::string bytes;
    for (const char* threads : {"1", "3"}) {
      const std::string out = folder + "/" + lives + threads;
      const test::Run run =
          temporal(quick({scene, "--frames", "30:36", "--lives", lives, "--threads", threads, "-o", out}));
      ASSERT_EQ(run.code, 0) << run.err;
      if (bytes.empty()) bytes = slurp(out);
      EXPECT_EQ(slurp(out), bytes) << lives;
    }
  }
}

// A lamp that is switched on: no light before, all of it from then on, whatever the lives.
TEST(Temporal, SwitchedLampLeavesNoGhost) {
  Slabs slabs;
  slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 8}, {0, 100}, "STEP");
  const std::string scene = slabs.write("temporal-switch", 17), folder = scratch("temporal-ghost");
  for (const char* lives : {"midpoint", "rate"}) {
    const std::string film = folder + "/" + lives + ".irradiance";
    const test::Run run = temporal(quick({scene, "--frames", "0:16", "--lives", lives, "-o", film}));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("jumps at frame 8"), std::string::npos) << run.err;
    for (const int frame : {0, 4, 7}) EXPECT_EQ(lux(scene, film, frame), 0) << lives << " " << frame;
    const double lit = lux(scene, film, 8);
    EXPECT_GT(lit, 1) << lives;
    for (const int frame : {9, 12, 16})
      EXPECT_NEAR(lux(scene, film, frame), lit, 1e-3 * lit) << lives << " " << frame;
  }
}

// A lamp that fades evenly: interpolated light follows it to a percent, from two frames or three.
TEST(Temporal, FadingLampIsFollowed) {
  Slabs slabs;
  slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 16}, {20, 100});
  const std::string scene = slabs.write("temporal-fade", 17),
                    film = scratch("temporal-fading") + "/f.irradiance";
  const test::Run run = temporal(quick({scene, "--frames", "0:16", "-o", film}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err.find("a cache for each"), std::string::npos) << run.err;
  const double last = lux(scene, film, 16);
  ASSERT_GT(last, 0);
  for (const int frame : {0, 3, 8, 13}) {
    const double due = last * (20 + 5 * frame) / 100;
    EXPECT_NEAR(lux(scene, film, frame), due, 0.01 * due) << frame;
  }
}

// Zones of eight axes: the light is followed as by discs, the bytes do not depend on threads, and both
// splatters draw the film.
TEST(Temporal, AdaptiveZonesFollowAFadingLamp) {
  Slabs slabs;
  slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 16}, {20, 100});
  const std::string scene = slabs.write("temporal-axes", 17), folder = scratch("temporal-shaped"),
                    film = folder + "/f.irradiance";
  for (const char* threads : {"1", "4"}) {
    const test::Run run = temporal(quick(
        {scene, "--frames", "0:16", "--footprint", "adaptive", "--threads", threads, "-o", film + threads}));
    ASSERT_EQ(run.code, 0) << run.err;
  }
  EXPECT_EQ(slurp(film + "1"), slurp(film + "4"));
  EXPECT_TRUE(Container::open(film + "1", FileKind::irradiance).has("footprint_slope_change"));
  const double last = lux(scene, film + "1", 16);
  ASSERT_GT(last, 0);
  for (const int frame : {0, 3, 8, 13}) {
    const double due = last * (20 + 5 * frame) / 100;
    EXPECT_NEAR(lux(scene, film + "1", frame), due, 0.01 * due) << frame;
  }
  double sum[2] = {0, 0};
  for (const int by : {0, 1}) {
    const std::string picture = folder + "/p.exr";
    const test::Run run = run_tool({"splat", scene, film + "1", "--frame", "9", "--width", "24", "--splat",
                                    by == 0 ? "cpu" : "gl", "--direct", "none", "--quiet", "-o", picture});
    ASSERT_EQ(run.code, 0) << run.err;
    for (const Rgb& c : read_image(picture).rgb("")) sum[by] += static_cast<double>(luminance(c));
  }
  EXPECT_GT(sum[0], 0);
  EXPECT_NEAR(sum[1] / sum[0], 1, 0.002);
}

TEST(Temporal, SaysWhereAFilmIsHardlyWorthIt) {
  const std::string film = scratch("temporal-restless") + "/f.irradiance";
  const test::Run run =
      temporal(quick({data("cube-in-a-box.glb"), "--frames", "100:103", "--max-life", "1", "-o", film}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("a cache for each may be as fast; raise --temporal-accuracy or --max-life"),
            std::string::npos)
      << run.err;
}

TEST(Temporal, LivesAreNoLongerThanAsked) {
  const std::string scene = data("moving-light.glb"), film = scratch("temporal-lives") + "/f.irradiance";
  for (const char* lives : {"midpoint", "rate"}) {
    const test::Run run =
        temporal(quick({scene, "--frames", "100:109", "--max-life", "4", "--lives", lives, "-o", film}));
    ASSERT_EQ(run.code, 0) << run.err;
    const Container file = Container::open(film, FileKind::irradiance);
    const auto birth = file.values<std::int32_t>("birth", {0}), end = file.values<std::int32_t>("end", {0});
    ASSERT_GT(birth.size(), 0u);
    for (std::size_t i = 0; i < birth.size(); ++i) {
      EXPECT_LE(end[i] - birth[i], 4) << lives;
      EXPECT_LE(end[i], 110) << lives;
    }
  }
}

// What is done of an interrupted film is kept, and the film that goes on is that of an uninterrupted run.
void expect_to_go_on(const std::string& footprint) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("temporal-interrupted-" + footprint);
  const std::vector<std::string> asked{"temporal",  scene,  "--frames", "0:24", "--rays",      "512",
                                       "--photons", "5000", "--width",  "48",   "--footprint", footprint,
                                       "--lives",   "rate", "--reuse",  "-o"};
  const auto into = [&](const std::string& name) {
    std::vector<std::string> words = asked;
    words.push_back(folder + "/" + name);
    return words;
  };
  ASSERT_EQ(run_tool(into("whole")).code, 0);
  const Process process(into("cut"));
  const std::string journal = folder + "/cut.journal";
  for (int i = 0; i < 2000; ++i) {
    std::error_code absent;
    const auto size = std::filesystem::file_size(journal, absent);
    if (!absent && size > 100'000) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process.signal(SIGINT);
  const test::Run cut = process.wait();
  ASSERT_EQ(cut.code, 130) << cut.err;
  EXPECT_NE(cut.err.find("with --reuse goes on"), std::string::npos) << cut.err;
  EXPECT_FALSE(std::filesystem::exists(folder + "/cut"));
  ASSERT_TRUE(std::filesystem::exists(journal));
  // Damage at its end, as a cut write leaves it, costs that entry alone.
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - 7);
  const test::Run rest = run_tool(into("cut"));
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.err.find("the film goes on"), std::string::npos) << rest.err;
  EXPECT_EQ(slurp(folder + "/cut"), slurp(folder + "/whole"));
  EXPECT_FALSE(std::filesystem::exists(journal));
  EXPECT_NE(run_tool(into("cut")).err.find("up to date"), std::string::npos);
}

TEST(Temporal, InterruptedFilmGoesOn) { expect_to_go_on("circle"); }
TEST(Temporal, InterruptedFilmOfFootprintsGoesOn) { expect_to_go_on("adaptive"); }

}  // namespace
}  // namespace phos::test
