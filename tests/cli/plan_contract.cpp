// phos-plan as a user meets it: what it refuses, what it prints, that its scripts run, and that runs are
// judged.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "core/error.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/refused.h"
#include "support/script.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-empty.glb");
const std::vector<std::string> kSmall{"--width", "32", "--height", "32", "--pilot-seconds", "0.5"};

std::vector<std::string> plan_of(std::vector<std::string> more, const std::string& scene = kBox) {
  std::vector<std::string> words{"plan", scene};
  words.insert(words.end(), kSmall.begin(), kSmall.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(PlanTool, HelpSaysWhatErrorMeans) {
  const auto help = run_tool({"plan", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--error", "--seconds", "--quantity", "--sensors", "--grid", "--run", "--json",
                           "--sh", "root mean square error", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_tool({"plan", "--version"}).code, 0);
}

TEST(PlanTool, RefusesBadCommandLines) {
  EXPECT_EQ(run_tool({"plan"}).code, 2);
  expect_refused("plan", {kBox}, 2, "--error 5%");
  for (const char* none : {"0", "-5%", "200%", "five", "5%%", "nan", ""})
    expect_refused("plan", {kBox, "--error", none}, 2, "--error");
  expect_refused("plan", {kBox, "--seconds", "-1"}, 2, "seconds");
  expect_refused("plan", {kBox, "--error", "5%", "--run"}, 2, "-o");
  expect_refused("plan", {kBox, "--error", "5%", "--run", "-o", kBox}, 2, "is an input too");
  expect_refused("plan", {kBox, "--error", "5%", "--run", "-o", data("luminaires.gltf")}, 3,
                 "is not a folder");
  expect_refused("plan", {kBox, "--error", "5%", "--sh", "--json"}, 2, "--sh");
  expect_refused("plan", {kBox, "--error", "5%", "--rounds", "2"}, 2, "--run");
  expect_refused("plan", {kBox, "--error", "5%", "--quantity", "lux"}, 2, "--sensors");
  expect_refused("plan", {kBox, "--error", "5%", "--grid", "0.1"}, 2, "--quantity");
  expect_refused("plan", {kBox, "--error", "5%", "--quantity", "lux", "--grid", "0.1"}, 2, "--workplane");
  expect_refused(
      "plan",
      {kBox, "--error", "5%", "--quantity", "lux", "--grid", "0.1", "--workplane", "0.1", "--width", "9"}, 2,
      "--width");
  expect_refused("plan",
                 {kBox, "--error", "5%", "--quantity", "lux", "--grid", "0.1", "--workplane", "0.1",
                  "--footprint", "adaptive"},
                 2, "each sensor has a record of its own");
  expect_refused("plan", {kBox, "--error", "5%", "--estimate", "hull", "--footprint", "adaptive"}, 2,
                 "--estimate hull");
  expect_refused("plan", {kBox, "--error", "5%", "--camera", "nobody"}, 2, "nobody");
  expect_refused("plan", {"nowhere.glb", "--error", "5%"}, 3, "nowhere.glb");
}

TEST(PlanTool, WhatCannotBeHadIsALine) {
  const std::string folder = scratch("plan-dark");
  spill(folder + "/dark.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  expect_refused("plan", {folder + "/dark.obj", "--error", "5%"}, 3, "has no light");
  for (const auto& [goal, word] : {std::pair{std::pair{"--seconds", "0.001"}, "--seconds"},
                                   {std::pair{"--error", "0.001%"}, "out of reach"}}) {
    const auto run = run_tool(plan_of({goal.first, goal.second, "--quiet"}));
    // On a busy machine the pilot is given up, and no time is predicted that could be too long.
    if (goal.first == std::string("--seconds") && run.err.find("given up") != std::string::npos) continue;
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  }
}

TEST(PlanTool, ItsScriptMakesThePicture) {
  const std::string folder = scratch("plan-script");
  const auto plan = run_tool(plan_of({"--error", "20%"}));
  ASSERT_EQ(plan.code, 0) << plan.err;
  for (const char* part : {"#!/usr/bin/env bash", "# Asked for: image of 32 x 32, error at most 20 %",
                           "# Predicted:", "global photons", "temporal data: nothing moves",
                           "direct light in the records: not tried: few lamps take few shadow rays",
                           "phos-photons", "phos-irradiance", "phos-splat"})
    EXPECT_NE(plan.out.find(part), std::string::npos) << part << plan.out;
  spill(folder + "/plan.sh", plan.out);
  const auto run = run_shell({"bash", folder + "/plan.sh", "made"}, folder);
  ASSERT_EQ(run.code, 0) << run.err;
  const Image image = read_image(folder + "/made/image.exr");
  EXPECT_EQ(image.width(), 32);
  float light = 0;
  for (const float v : image.channel("indirect.G")) {
    ASSERT_TRUE(std::isfinite(v));
    light = std::max(light, v);
  }
  EXPECT_GT(light, 0);
}

/// A floor under four lamps, seen from beside them.
std::string four_lamps() {
  const std::string folder = scratch("plan-lamps");
  std::string obj = "mtllib a.mtl\nv -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nusemtl grey\no floor\nf 4 3 2 1\n";
  for (int k = 0; k < 4; ++k) {
    const int x = k % 2 == 0 ? -1 : 1, z = k / 2 == 0 ? -1 : 1, v = 5 + 4 * k;
    for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      obj += text("v ", x + 0.2 * dx, " 1.5 ", z + 0.2 * dz, "\n");
    obj += text("usemtl glow\no lamp", k, "\nf ", v, " ", v + 1, " ", v + 2, " ", v + 3, "\n");
  }
  spill(folder + "/a.obj", obj);
  spill(folder + "/a.mtl", "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl glow\nKd 0 0 0\nKe 1000 1000 1000\n");
  spill(folder + "/a.lights.json", R"({"cameras":[{"eye":[3,2,3],"target":[0,0,0]}]})");
  return folder + "/a.obj";
}

/// Light straight from many lamps goes into the records or not, as is cheaper by measurement.
TEST(PlanTool, WithoutAPilotGivesUsualSettings) {
  const std::string folder = scratch("plan-usual");
  const auto plan =
      run_tool({"plan", kBox, "--width", "32", "--height", "32", "--error", "10%", "--pilot-seconds", "0"});
  ASSERT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(plan.out.find("Predicted"), std::string::npos) << plan.out;
  EXPECT_NE(plan.out.find("no pilot was run"), std::string::npos) << plan.out;
  const auto json = run_tool(
      {"plan", kBox, "--width", "32", "--height", "32", "--error", "10%", "--pilot-seconds", "0", "--json"});
  ASSERT_EQ(json.code, 0) << json.err;
  const Json parsed = parse_json(json.out, "plan");
  EXPECT_FALSE(parsed.find("promised")->as_bool());
  EXPECT_GT(parsed.find("plan")->find("settings")->find("photons")->as_number(), 0);
  expect_refused("plan", {kBox, "--error", "5%", "--pilot-seconds", "0", "--run", "-o", folder + "/run"}, 2,
                 "--pilot-seconds");
  std::filesystem::remove_all(folder);
}

TEST(PlanTool, TriesDirectLightInTheRecords) {
  const std::string cached = "--direct cached --footprint adaptive", scene = four_lamps();
  const auto asked = run_tool(plan_of({"--error", "30%", "--direct", "cached"}, scene));
  ASSERT_EQ(asked.code, 0) << asked.err;
  EXPECT_NE(asked.out.find(cached), std::string::npos) << asked.out;
  const auto both = run_tool(plan_of({"--error", "30%"}, scene));
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_NE(both.out.find("direct light in the records: 4 lamps of 8 facets: "), std::string::npos)
      << both.out;
  EXPECT_NE(both.err.find("with --direct cached"), std::string::npos) << both.err;
  expect_refused("plan",
                 {scene, "--error", "30%", "--quantity", "lux", "--grid", "0.5", "--workplane", "0.1",
                  "--direct", "cached"},
                 2, "cached is for pictures");
}

/// The script of a plan, run in a folder; returns the folder.
std::string made_by(const std::string& plan, const std::string& name) {
  const std::string folder = scratch(name);
  spill(folder + "/plan.sh", plan);
  const auto run = run_shell({"bash", folder + "/plan.sh", "made"}, folder);
  EXPECT_EQ(run.code, 0) << run.err;
  return folder + "/made";
}

TEST(PlanTool, ItsScriptShowsGlossByRecords) {
  const std::string scene = data("cornell-glossy22.glb");
  const auto plan = run_tool(plan_of({"--error", "40%", "--gloss", "cached"}, scene));
  ASSERT_EQ(plan.code, 0) << plan.err;
  for (const char* part : {"radiance records: harmonics of order 10 hold the lobes of back-glossy",
                           "phos-brdf", "phos-radiance", "\"$out/light.radiance\""})
    EXPECT_NE(plan.out.find(part), std::string::npos) << part << plan.out;
  const std::string folder = made_by(plan.out, "plan-gloss");
  EXPECT_GT(Container::open(folder + "/light.radiance", FileKind::radiance).vectors("position").size(), 0u);
  const Image image = read_image(folder + "/image.exr");
  float light = 0;
  for (const float v : image.channel("glossy.G")) light = std::max(light, v);
  EXPECT_GT(light, 0);
  // Both ways are tried, and one is kept, with the reason.
  const auto both = run_tool(plan_of({"--error", "40%"}, scene));
  ASSERT_EQ(both.code, 0) << both.err;
  const bool late = both.err.find("given up") != std::string::npos;  // on a busy machine
  if (!late) {
    EXPECT_NE(both.err.find("with --gloss cached"), std::string::npos) << both.err;
    EXPECT_NE(both.out.find("by rays"), std::string::npos) << both.out;
  }
  expect_refused("plan", {scene, "--error", "30%", "--gloss", "cached", "--direct", "cached"}, 2, "--gloss");
}

TEST(PlanTool, ItsScriptMakesAdaptiveRecords) {
  const auto plan = run_tool(plan_of({"--error", "30%", "--footprint", "adaptive"}));
  ASSERT_EQ(plan.code, 0) << plan.err;
  for (const char* part : {"adaptive records: they are asked for", "--footprint adaptive", "--splat cpu",
                           "records are adaptive"})
    EXPECT_NE(plan.out.find(part), std::string::npos) << part << plan.out;
  const std::string folder = made_by(plan.out, "plan-adaptive");
  EXPECT_GT(
      Container::open(folder + "/light.irradiance", FileKind::irradiance).vectors("footprint_axis").size(),
      0u);
  const Image image = read_image(folder + "/image.exr");
  float light = 0;
  for (const float v : image.channel("indirect.G")) light = std::max(light, v);
  EXPECT_GT(light, 0);
  // One way or the other, and the reason.
  const auto both = run_tool(plan_of({"--error", "10%"}));
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_NE(both.out.find("adaptive records: "), std::string::npos) << both.out;
}

TEST(PlanTool, ItsScriptMakesAFilm) {
  const std::string scene = data("cube-in-a-box.glb");
  const auto plan = run_tool(plan_of({"--error", "40%", "--frames", "0:2"}, scene));
  ASSERT_EQ(plan.code, 0) << plan.err;
  for (const char* part : {"# Asked for: film of frames 0 to 2, image of 32 x 32", "phos-temporal",
                           "--frames 0:2", "image-%04d.exr", "temporal data: "})
    EXPECT_NE(plan.out.find(part), std::string::npos) << part << plan.out;
  EXPECT_EQ(plan.out.find("phos-photons"), std::string::npos) << plan.out;
  const std::string folder = made_by(plan.out, "plan-film");
  for (const char* name : {"0000", "0001", "0002"})
    EXPECT_EQ(read_image(folder + "/image-" + name + ".exr").width(), 32);
  for (const auto& [option, value] :
       {std::pair{"--frame", "1"}, {"--quantity", "lux"}, {"--direct", "cached"}, {"--seconds", "9"}})
    expect_refused("plan", {scene, "--error", "40%", "--frames", "0:2", option, value}, 2, "--");
  expect_refused("plan", {scene, "--error", "40%", "--frames", "2:0"}, 2, "--frames");
  expect_refused("plan", {scene, "--error", "40%", "--frames", "0:2", "--run", "-o", scratch("plan-none")}, 2,
                 "--run");
  expect_refused("plan", {kBox, "--error", "40%", "--frames", "0:2"}, 2, "not animated");
}

TEST(PlanTool, JsonForPrograms) {
  const auto plan = run_tool(plan_of({"--seconds", "5", "--json"}));
  ASSERT_EQ(plan.code, 0) << plan.err;
  const Json j = parse_json(plan.out, "plan");
  const Json& chosen = *j.find("plan");
  EXPECT_GT(chosen.find("settings")->find("photons")->as_number(), 0);
  EXPECT_LE(chosen.find("seconds")->find("high")->as_number(), 5);
  const Json& error = *chosen.find("image_error");
  EXPECT_LE(error.find("low")->as_number(), error.find("value")->as_number());
  EXPECT_LE(error.find("value")->as_number(), error.find("high")->as_number());
  EXPECT_EQ(j.find("stages")->as_array().size(), 3u);
  EXPECT_EQ(j.find("asked")->find("seconds")->as_number(), 5);
}

TEST(PlanTool, ARunIsMeasuredAndJudged) {
  const std::string folder = scratch("plan-run");
  std::vector<std::string> words =
      plan_of({"--error", "25%", "--run", "-o", folder + "/out", "--reference-seconds", "1"});
  const auto run = run_tool(words);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("met: error"), std::string::npos) << run.err;
  const Json j = parse_json(slurp(folder + "/out/plan.json"), "plan.json");
  const Json& report = *j.find("run");
  EXPECT_TRUE(report.find("met")->as_bool());
  EXPECT_LE(report.find("rounds")->as_array().back().find("error")->as_number(), 0.25);
  EXPECT_GT(report.find("reference_s")->as_number(), 0);
  // The tool that compares says the same.
  const std::string out = folder + "/out/";
  const auto compared =
      run_tool({"compare", out + "image.exr", out + "reference-0.exr", "--second-reference",
                out + "reference-1.exr", "--ignore-emission", "--layer", "beauty", "--json"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  const double measured = report.find("rounds")->as_array().back().find("error")->as_number();
  const std::string key = "\"relative_converged_rmse\": ";
  const std::size_t start = compared.out.find(key);
  ASSERT_NE(start, std::string::npos) << compared.out;
  EXPECT_NEAR(std::strtod(compared.out.c_str() + start + key.size(), nullptr), measured,
              0.03 * measured + 1e-4);
  // The script is that of the picture that is there.
  EXPECT_NE(slurp(out + "plan.sh").find("# Measured: met: error"), std::string::npos);
  const auto again = run_shell({"bash", out + "plan.sh", "again"}, folder);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(slurp(folder + "/again/image.exr") == slurp(out + "image.exr"));
}

TEST(PlanTool, AnInterruptedRunLeavesThePlan) {
  const std::string folder = scratch("plan-interrupted");
  std::vector<std::string> words =
      plan_of({"--error", "25%", "--run", "-o", folder + "/out", "--reference-seconds", "600"});
  const Process process(words);
  for (int i = 0; i < 6000 && !std::filesystem::exists(folder + "/out/plan.sh"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.signal(SIGINT);
  const auto stopped = process.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_NE(stopped.err.find("the plan as first predicted is in " + folder + "/out/plan.sh"),
            std::string::npos)
      << stopped.err;
  EXPECT_NE(slurp(folder + "/out/plan.sh").find("phos-photons"), std::string::npos);
  EXPECT_NE(parse_json(slurp(folder + "/out/plan.json"), "plan.json").find("stages"), nullptr);
}

/// References that tell nothing of what is asked for: one round, and the reason.
TEST(PlanTool, ARunEndsWhereNothingCanBeTold) {
  const std::string folder = scratch("plan-untold");
  const auto run =
      run_tool(plan_of({"--error", "4%", "--run", "-o", folder + "/out", "--reference-seconds", "0.01"}));
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.err.find("cannot be told; raise --reference-seconds"), std::string::npos) << run.err;
  const Json j = parse_json(slurp(folder + "/out/plan.json"), "plan.json");
  EXPECT_FALSE(j.find("run")->find("met")->as_bool());
  EXPECT_EQ(j.find("run")->find("rounds")->as_array().size(), 1u);
}

TEST(PlanTool, LuxOnAWorkplane) {
  const std::string folder = scratch("plan-lux");
  std::vector<std::string> words{"plan",   kBox,   "--error",     "15%", "--quantity",      "lux",
                                 "--grid", "0.15", "--workplane", "0.1", "--pilot-seconds", "0.5"};
  const auto plan = run_tool(words);
  ASSERT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(plan.out.find("phos-splat"), std::string::npos) << plan.out;
  spill(folder + "/plan.sh", plan.out);
  const auto run = run_shell({"bash", folder + "/plan.sh", "made"}, folder);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(slurp(folder + "/made/lux.csv").starts_with("id,x,y,z,nx,ny,nz,E_lx"));
}

/// Ratios of four seeds together: 1.3. A model without what few rays add made it 2.4.
TEST(PlanTool, LuxComesOutAsFirstPredicted) {
  const std::string folder = scratch("plan-lux-seeds");
  double squares = 0;
  for (const char* seed : {"1", "2", "3", "4"}) {
    const std::string out = folder + "/" + seed;
    const auto run = run_tool({"plan", kBox, "--error", "3%", "--quantity", "lux", "--grid", "0.1",
                               "--workplane", "0.1", "--seed", seed, "--run", "-o", out});
    ASSERT_EQ(run.code, 0) << run.err;
    const Json plan = parse_json(slurp(out + "/plan.json"), "plan.json");
    const Json& first = plan.find("run")->find("rounds")->as_array().front();
    const double ratio = first.find("error")->as_number() / first.find("predicted_error")->as_number();
    squares += ratio * ratio / 4;
  }
  EXPECT_LT(std::sqrt(squares), 1.7);
}

TEST(PlanTool, AnAnimatedSceneIsToldOfTemporalRecords) {
  const auto plan = run_tool(plan_of({"--error", "30%"}, data("cube-in-a-box.glb")));
  ASSERT_EQ(plan.code, 0) << plan.err;
  EXPECT_NE(plan.err.find("give --frames 0:"), std::string::npos) << plan.err;
  EXPECT_NE(plan.out.find("temporal data"), std::string::npos);
}

}  // namespace
