// Films of what moves, appears, vanishes and shines: what phos-temporal makes of them, seen in lux and
// pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "file/container.h"
#include "file/json_parse.h"
#include "support/filmed_slabs.h"

namespace phos::test {
namespace {

/// Share of a frame's lookups that no record answers, with so many samples a pixel.
double missing(const std::string& scene, const std::string& film, int frame, const char* samples) {
  const std::string folder = scratch("film-missing"), stats = folder + "/s.json";
  const test::Run run =
      run_tool({"splat", scene, film, "--frame", std::to_string(frame), "--width", "24", "--pixel-samples",
                samples, "--stats", stats, "--quiet", "-o", folder + "/p.exr"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Json s = parse_json(slurp(stats), "stats");
  return s.find("cache misses")->as_number() / s.find("cache lookups")->as_number();
}
/// Records are placed for the middles of pixels; four samples of one lie beside it, a few on the rims.
void expect_records(const std::string& scene, const std::string& film, int frame, double most) {
  EXPECT_EQ(missing(scene, film, frame, "1"), 0) << film << " " << frame;
  EXPECT_LT(missing(scene, film, frame, "4"), most) << film << " " << frame;
}

// Records ride on what moves: where floor, ceiling and lamp go together, so does the light.
TEST(TemporalFilm, RecordsMoveWithTheirSurfaces) {
  Slabs slabs;
  for (const int node : {0, 1, 2}) {
    const float y = node == 0 ? 0.f : node == 1 ? 2.f : 1.f;
    slabs.animate(node, "translation", {0, 16}, {0, y, 0, 0.5f, y, 0.25f});
  }
  const std::string scene = slabs.write("temporal-ride", 17),
                    film = scratch("temporal-riding") + "/f.irradiance";
  ASSERT_EQ(temporal(quick({scene, "--frames", "0:16", "-o", film})).code, 0);
  EXPECT_TRUE(Container::open(film, FileKind::irradiance).has("anchor"));
  const double first = lux(scene, film, 0);
  EXPECT_GT(first, 0);
  for (const int frame : {5, 16}) {
    const float t = static_cast<float>(frame) / 16;
    EXPECT_NEAR(lux(scene, film, frame, 0.5f * t, 0.25f * t), first, 0.01 * first) << frame;
  }
}

// What appears, teleports, or goes through where records lie: every frame is drawn, and nothing is lit by
// what is not there.
TEST(TemporalFilm, ThingsAppearTeleportAndPassThrough) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  const int grows = slabs.slab("grows", 1, 0.8f, 0.5f, 0), jumps = slabs.slab("jumps", 0.5f, -1, 0.3f, 0),
            sinks = slabs.slab("sinks", 0.5f, 0, 0.3f, -0.8f);
  slabs.animate(grows, "scale", {3, 9}, {0, 0, 0, 1, 1, 1});
  slabs.animate(jumps, "translation", {0, 6}, {-1, 0.3f, 0, 1, 0.3f, 0.5f}, "STEP");
  slabs.animate(sinks, "translation", {0, 16}, {0, 0.3f, -0.8f, 0, -0.3f, -0.8f});
  const std::string scene = slabs.write("temporal-things", 17), folder = scratch("temporal-things-out");
  const std::string film = folder + "/f.irradiance";
  for (const char* lives : {"midpoint", "rate"}) {
    const test::Run run = temporal(quick({scene, "--frames", "0:16", "--lives", lives, "-o", film}));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("jumps at frame 6"), std::string::npos) << run.err;
    const test::Run splat = run_tool(
        {"splat", scene, film, "--frames", "0:16", "--width", "24", "--quiet", "-o", folder + "/%02d.exr"});
    EXPECT_EQ(splat.code, 0) << splat.err;
    for (const int frame : {0, 3, 5, 6, 12, 16}) {
      const double light = lux(scene, film, frame);
      EXPECT_GT(light, 1) << lives << " " << frame;
      EXPECT_LT(light, 100) << lives << " " << frame;
    }
  }
}

// A camera that is elsewhere at once: what it sees after the cut has records too.
TEST(TemporalFilm, CameraCutLosesNoRecords) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  slabs.slab("shelf", 1, 0, 1, 20);
  slabs.animate(slabs.eye, "translation", {0, 8}, {0, 1, 3, 0, 1.3f, 22}, "STEP");
  const std::string scene = slabs.write("temporal-cut", 17), folder = scratch("temporal-cut-out");
  const std::string film = folder + "/f.irradiance";
  ASSERT_EQ(temporal(quick({scene, "--frames", "0:16", "-o", film})).code, 0);
  for (const int frame : {7, 8, 15}) expect_records(scene, film, frame, 0.05);
}

TEST(TemporalFilm, RadianceFilmOfWhatIsGlossy) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  slabs.slab("tray", 1, 0, 0.2f, 0, waxed());
  const std::string scene = slabs.write("temporal-gloss", 17), folder = scratch("temporal-gloss-out");
  for (const std::string footprint : {"circle", "adaptive"}) {
    const std::string film = folder + "/" + footprint;
    const test::Run radiance = temporal(quick({scene, "--frames", "0:8", "--kind", "radiance", "--footprint",
                                               footprint, "-o", film + ".radiance"}));
    ASSERT_EQ(radiance.code, 0) << radiance.err;
    const Container file = Container::open(film + ".radiance", FileKind::radiance);
    EXPECT_TRUE(file.has("birth"));
    for (const char* tensor : {"footprint_length", "footprint_length_change"})
      EXPECT_EQ(file.has(tensor), footprint == "adaptive") << tensor;
    EXPECT_EQ(run_tool({"info", file.path(), "--verify"}).code, 0);
    const test::Run rest =
        temporal(quick({scene, film + ".radiance", "--frames", "0:8", "-o", film + ".irradiance"}));
    ASSERT_EQ(rest.code, 0) << rest.err;
    const test::Run splat = run_tool({"splat", scene, film + ".radiance", film + ".irradiance", "--frames",
                                      "3:4", "--width", "24", "-o", film + "-%02d.exr"});
    EXPECT_EQ(splat.code, 0) << splat.err;
    EXPECT_TRUE(std::filesystem::exists(film + "-04.exr"));
  }
}

// The radiance film among the inputs must be of these frames and this scene.
TEST(TemporalFilm, RadianceFilmOfOtherFramesIsRefused) {
  const std::string folder = scratch("film-other"), film = folder + "/f.radiance";
  const auto with_lamp_to = [](float x, const std::string& name) {
    Slabs slabs;
    slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, x, 1, 0});
    slabs.slab("tray", 1, 0, 0.2f, 0, waxed());
    return slabs.write(name, 17);
  };
  const std::string scene = with_lamp_to(0.5f, "film-this"), other = with_lamp_to(0.4f, "film-that");
  ASSERT_EQ(temporal(quick({scene, "--frames", "2:6", "--kind", "radiance", "-o", film})).code, 0);
  for (const auto& [which, frames] : {std::pair(scene, "0:4"), {scene, "4:8"}, {other, "2:6"}}) {
    const test::Run run = temporal(quick({which, film, "--frames", frames, "-o", folder + "/f.irradiance"}));
    EXPECT_EQ(run.code, 4) << run.err;
    EXPECT_TRUE(is_one_line(test::without_warnings(run.err))) << run.err;
    EXPECT_NE(run.err.find("f.radiance"), std::string::npos) << run.err;
  }
  EXPECT_EQ(temporal(quick({scene, film, "--frames", "3:5", "-o", folder + "/f.irradiance"})).code, 0);
}

// Direct light among the records is not added once more where they are read.
TEST(TemporalFilm, LightOfAllPathsCountsOnce) {
  Slabs slabs;
  slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 16}, {20, 100});
  const std::string scene = slabs.write("film-all", 17), folder = scratch("film-all-out");
  for (const char* estimate : {"gather", "hull"}) {
    double total[2];
    for (const char* paths : {"indirect", "all"}) {
      const std::string film = folder + "/" + paths;
      const test::Run run = temporal({scene, "--frames", "0:8", "--paths", paths, "--estimate", estimate,
                                      "--rays", "64", "--photons", "40000", "--width", "24", "-o", film});
      ASSERT_EQ(run.code, 0) << run.err;
      EXPECT_EQ(Container::open(film, FileKind::irradiance).provenance().extra.find("quantity")->as_string(),
                paths);
      total[paths[0] == 'a'] = lux(scene, film, 4, 0, 0, "E_lx");
    }
    EXPECT_GT(total[0], 1) << estimate;
    EXPECT_NEAR(total[1], total[0], 0.1 * total[0]) << estimate;
  }
}

// Photons alone: a lamp that fades evenly is followed.
TEST(TemporalFilm, PhotonsAloneFollowAFadingLamp) {
  Slabs slabs;
  slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 16}, {20, 100});
  const std::string scene = slabs.write("film-hull", 17), folder = scratch("film-hull-out");
  for (const char* lives : {"midpoint", "rate"}) {
    const std::string film = folder + "/" + lives;
    const test::Run run = temporal({scene, "--frames", "0:16", "--estimate", "hull", "--lives", lives,
                                    "--photons", "20000", "--width", "24", "-o", film});
    ASSERT_EQ(run.code, 0) << run.err;
    const double last = lux(scene, film, 16);
    ASSERT_GT(last, 0);
    for (const int frame : {0, 5, 11}) {
      const double due = last * (20 + 5 * frame) / 100;
      EXPECT_NEAR(lux(scene, film, frame), due, 0.02 * due) << lives << " " << frame;
    }
  }
}

// What grows out of nothing, and shrinks to nothing, within a life has records all the time that it is there.
TEST(TemporalFilm, WhatComesAndGoesHasRecords) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  const int comes = slabs.slab("comes", 1.5f, 0, 0.4f, 0), goes = slabs.slab("goes", 1.5f, 0, 0.8f, 0);
  slabs.animate(comes, "scale", {2, 10}, {0, 0, 0, 1, 1, 1});
  slabs.animate(goes, "scale", {3, 11}, {1, 1, 1, 0, 0, 0});
  const std::string scene = slabs.write("film-growth", 17), folder = scratch("film-growth-out");
  for (const char* lives : {"midpoint", "rate"}) {
    const std::string film = folder + "/" + lives;
    const test::Run run =
        temporal(quick({scene, "--frames", "0:16", "--max-life", "16", "--lives", lives, "--min-radius",
                        "0.035", "--max-radius", "1.5", "-o", film}));  // small beside the slabs
    ASSERT_EQ(run.code, 0) << run.err;
    for (const int frame : {0, 2, 3, 4, 5, 7, 9, 10, 11, 12, 16}) expect_records(scene, film, frame, 0.06);
  }
}

}  // namespace
}  // namespace phos::test
