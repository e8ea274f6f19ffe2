// phos-temporal at the command line: what it makes, says and refuses, and what an interrupted film leaves.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "file/container.h"
#include "file/json_parse.h"
#include "support/animated.h"
#include "support/run.h"

namespace phos::test {
namespace {

Run temporal(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "temporal");
  return run_tool(arguments);
}
/// With few rays and photons, and a small view: fast.
std::vector<std::string> quick(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(),
                   {"--rays", "64", "--photons", "5000", "--width", "24", "--accuracy", "0.4"});
  return arguments;
}

void expect_failure(const Run& run, int code, const std::string& word) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_EQ(run.err.rfind("phos-temporal: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty());
}

/// Two grey slabs that face each other, a lamp between them, and a camera that sees both.
struct Slabs : Animated {
  Slabs() {
    slab("floor", 4, 0, 0, 0);
    slab("ceiling", 4, 0, 2, 0);
    lamp_node = lamp("lamp", "point", 100, 0, 1, 0);
    eye = camera("eye");
    animate(eye, "translation", {0, 16}, {0, 1, 3, 0, 1, 3});
  }
  int lamp_node = 0, eye = 0;
};

/// Indirect illuminance near the middle of the floor, moved by (x, z) m, lx.
double lux(const std::string& scene, const std::string& film, int frame, float x = 0, float z = 0) {
  const std::string folder = scratch("temporal-lux");
  std::ostringstream point;
  point << "x,y,z,nx,ny,nz\n" << 0.3f + x << ",0," << 0.2f + z << ",0,1,0\n";
  spill(folder + "/p.csv", point.str());
  const test::Run run = run_tool({"sense", scene, film, "--frame", std::to_string(frame), "--points",
                                  folder + "/p.csv", "--quiet", "-o", folder + "/lux.csv"});
  EXPECT_EQ(run.code, 0) << run.err;
  const std::string csv = slurp(folder + "/lux.csv");
  std::istringstream in(csv.substr(csv.rfind('\n', csv.size() - 2) + 1));
  std::string word;
  while (std::getline(in, word, ',')) {
  }  // indirect_lx is the last
  return std::atof(word.c_str());
}

TEST(Temporal, HelpVersionAndNoArguments) {
  const test::Run help = temporal({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* said :
       {"--frames", "--temporal-accuracy", "--max-life", "--lives", "--look-ahead", "--kind", "--photons"})
    EXPECT_NE(help.out.find(said), std::string::npos) << said;
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
  expect_failure(temporal({scene, "--frames", "0:3", "--look-ahead", "none", "-o", out}), 2, "--lives rate");
  expect_failure(temporal({scene, "--frames", "0:3", "--lives", "rate", "--checks", "2", "-o", out}), 2,
                 "--checks");
  expect_failure(temporal({scene, "--frames", "0:3", "--estimate", "raster", "-o", out}), 2, "--estimate");
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
    const Container file = Container::open(out, "irradiance");
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
  ASSERT_EQ(temporal(quick({scene, "--frames", "0:16", "-o", film})).code, 0);
  const double last = lux(scene, film, 16);
  ASSERT_GT(last, 0);
  for (const int frame : {0, 3, 8, 13}) {
    const double due = last * (20 + 5 * frame) / 100;
    EXPECT_NEAR(lux(scene, film, frame), due, 0.01 * due) << frame;
  }
}

TEST(Temporal, LivesAreNoLongerThanAsked) {
  const std::string scene = data("moving-light.glb"), film = scratch("temporal-lives") + "/f.irradiance";
  for (const char* lives : {"midpoint", "rate"}) {
    const test::Run run =
        temporal(quick({scene, "--frames", "100:109", "--max-life", "4", "--lives", lives, "-o", film}));
    ASSERT_EQ(run.code, 0) << run.err;
    const Container file = Container::open(film, "irradiance");
    const auto birth = file.values<std::int32_t>("birth", {0}), end = file.values<std::int32_t>("end", {0});
    ASSERT_GT(birth.size(), 0u);
    for (std::size_t i = 0; i < birth.size(); ++i) {
      EXPECT_LE(end[i] - birth[i], 4) << lives;
      EXPECT_LE(end[i], 110) << lives;
    }
  }
}

// What is done of an interrupted film is kept, and the film that goes on is that of an uninterrupted run.
TEST(Temporal, InterruptedFilmGoesOn) {
  const std::string scene = data("cube-in-a-box.glb"), folder = scratch("temporal-interrupted");
  const std::vector<std::string> asked{"temporal", scene,       "--frames", "0:24",    "--rays",
                                       "256",      "--photons", "5000",     "--width", "48",
                                       "--lives",  "rate",      "--reuse",  "-o"};
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
  if (cut.code == 0) GTEST_SKIP() << "it was done before it was interrupted";
  EXPECT_EQ(cut.code, 130) << cut.err;
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

// Records ride on what moves: where floor, ceiling and lamp go together, so does the light.
TEST(Temporal, RecordsMoveWithTheirSurfaces) {
  Slabs slabs;
  for (const int node : {0, 1, 2}) {
    const float y = node == 0 ? 0.f : node == 1 ? 2.f : 1.f;
    slabs.animate(node, "translation", {0, 16}, {0, y, 0, 0.5f, y, 0.25f});
  }
  const std::string scene = slabs.write("temporal-ride", 17),
                    film = scratch("temporal-riding") + "/f.irradiance";
  ASSERT_EQ(temporal(quick({scene, "--frames", "0:16", "-o", film})).code, 0);
  EXPECT_TRUE(Container::open(film, "irradiance").has("anchor"));
  const double first = lux(scene, film, 0);
  EXPECT_GT(first, 0);
  for (const int frame : {5, 16}) {
    const float t = static_cast<float>(frame) / 16;
    EXPECT_NEAR(lux(scene, film, frame, 0.5f * t, 0.25f * t), first, 0.01 * first) << frame;
  }
}

// What appears, teleports, or goes through where records lie: every frame is drawn, and nothing is lit by
// what is not there.
TEST(Temporal, ThingsAppearTeleportAndPassThrough) {
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
TEST(Temporal, CameraCutLosesNoRecords) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  slabs.slab("shelf", 1, 0, 1, 20);
  slabs.animate(slabs.eye, "translation", {0, 8}, {0, 1, 3, 0, 1.3f, 22}, "STEP");
  const std::string scene = slabs.write("temporal-cut", 17), folder = scratch("temporal-cut-out");
  const std::string film = folder + "/f.irradiance";
  ASSERT_EQ(temporal(quick({scene, "--frames", "0:16", "-o", film})).code, 0);
  for (const char* frame : {"7", "8", "15"}) {
    const std::string stats = folder + "/s.json";
    ASSERT_EQ(run_tool({"splat", scene, film, "--frame", frame, "--width", "24", "--stats", stats, "--quiet",
                        "-o", folder + "/p.exr"})
                  .code,
              0);
    const Json s = parse_json(slurp(stats), "stats");
    EXPECT_LT(s.find("cache misses")->as_number(), 0.03 * s.find("cache lookups")->as_number()) << frame;
  }
}

TEST(Temporal, RadianceFilmOfWhatIsGlossy) {
  Slabs slabs;
  slabs.animate(slabs.lamp_node, "translation", {0, 16}, {-0.5f, 1, 0, 0.5f, 1, 0});
  Json waxed;
  waxed["name"] = "waxed";
  waxed["extras"]["phos"]["brdf"] = "phong";
  waxed["extras"]["phos"]["kd"] = Json::Array{0.3, 0.3, 0.3};
  waxed["extras"]["phos"]["ks"] = Json::Array{0.4, 0.4, 0.4};
  waxed["extras"]["phos"]["exponent"] = 5;
  slabs.slab("tray", 1, 0, 0.2f, 0, waxed);
  const std::string scene = slabs.write("temporal-gloss", 17), folder = scratch("temporal-gloss-out");
  const test::Run radiance =
      temporal(quick({scene, "--frames", "0:8", "--kind", "radiance", "-o", folder + "/f.radiance"}));
  ASSERT_EQ(radiance.code, 0) << radiance.err;
  EXPECT_TRUE(Container::open(folder + "/f.radiance", "radiance").has("birth"));
  const test::Run rest =
      temporal(quick({scene, folder + "/f.radiance", "--frames", "0:8", "-o", folder + "/f.irradiance"}));
  ASSERT_EQ(rest.code, 0) << rest.err;
  const test::Run splat = run_tool({"splat", scene, folder + "/f.radiance", folder + "/f.irradiance",
                                    "--frames", "3:4", "--width", "24", "-o", folder + "/%02d.exr"});
  EXPECT_EQ(splat.code, 0) << splat.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/04.exr"));
}

}  // namespace
}  // namespace phos::test
