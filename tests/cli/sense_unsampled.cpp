// Light that an estimator does not sample: a point lamp, a grey floor, and a wall of smooth steel that throws
// the lamp's light on it. What is said, what is left out, and exit codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "image/image.h"
#include "support/gltf.h"
#include "support/run.h"

namespace {

using namespace phos;
using namespace phos::test;

Json words(const Json::Array& values) { return values; }

void place(Gltf& g, int node, const Json::Array& at, const Json::Array& turn, double scale) {
  Json::Array nodes = g.json.find("nodes")->as_array();
  Json& n = nodes[static_cast<std::size_t>(node)];
  n["translation"] = words(at), n["rotation"] = words(turn), n["scale"] = words({scale, scale, scale});
  g.json["nodes"] = nodes;
}

/// The scene, photons of it, and points on its floor.
const std::string& folder() {
  static const std::string made = [] {
    const std::string f = scratch("unsampled");
    Gltf g;
    Json grey, steel, lamp, lamps, node, camera, camera_node;
    grey["name"] = "grey", grey["extras"]["phos"]["brdf"] = "lambert";
    grey["extras"]["phos"]["kd"] = words({0.5, 0.5, 0.5});
    steel["name"] = "steel", steel["extras"]["phos"]["brdf"] = "conductor";
    steel["extras"]["phos"]["ks"] = words({0.9, 0.9, 0.9});
    steel["extras"]["phos"]["ax"] = 0.01, steel["extras"]["phos"]["ay"] = 0.01;
    place(g, g.square_node(grey), {-2, 0, 2}, {-0.70710678, 0, 0, 0.70710678}, 4);
    place(g, g.square_node(steel), {-2, 0, -2}, {0, 0, 0, 1}, 4);
    lamp["type"] = "point", lamp["name"] = "bulb", lamp["intensity"] = 100;
    lamps["lights"] = words({lamp});
    g.json["extensions"]["KHR_lights_punctual"] = lamps;
    g.json["extensionsUsed"] = words({"KHR_lights_punctual"});
    node["name"] = "bulb", node["translation"] = words({0, 1.5, 0});
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    g.node(node);
    camera["type"] = "perspective", camera["perspective"]["yfov"] = 0.8, camera["perspective"]["znear"] = 0.1;
    g.json["cameras"] = words({camera});
    camera_node["camera"] = 0, camera_node["translation"] = words({0, 1.5, 4});
    g.node(camera_node);
    spill(f + "/steel.glb", g.bytes());
    Gltf matt = g;
    Json::Array materials = matt.json.find("materials")->as_array();
    materials[1]["extras"]["phos"]["ax"] = materials[1]["extras"]["phos"]["ay"] = 0.6;
    matt.json["materials"] = materials;
    spill(f + "/matt.glb", matt.bytes());
    spill(f + "/p.csv", "x,y,z,nx,ny,nz\n0.5,0,0.5,0,1,0\n-0.5,0,-0.5,0,1,0\n");
    EXPECT_EQ(run_tool({"photons", f + "/steel.glb", "--photons", "20000", "-o", f + "/l.photons"}).code, 0);
    return f;
  }();
  return made;
}

std::string file(const char* name) { return folder() + "/" + name; }

/// The cells of a column, by lines.
std::vector<std::string> column(const std::string& csv, const std::string& name) {
  std::vector<std::string> out;
  std::istringstream lines(csv);
  std::size_t at = std::string::npos;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (const char c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    if (at == std::string::npos) {
      at = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin());
      EXPECT_LT(at, cells.size()) << line;
    } else {
      out.push_back(cells.at(at));
    }
  }
  return out;
}

void expect_told(const test::Run& run) {
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("lamp \"bulb\" reaches surfaces by way of gloss of \"steel\""), std::string::npos)
      << run.err;
}

TEST(Unsampled, PathTracingStatesNoError) {
  const test::Run sense = run_tool({"sense", file("steel.glb"), "--exact", "--method", "path", "--samples",
                                    "256", "--points", file("p.csv")});
  expect_told(sense);
  for (const std::string& cell : column(sense.out, "stderr_lx")) EXPECT_EQ(cell, "");
  for (const std::string& cell : column(sense.out, "E_lx")) EXPECT_NE(cell, "");
  const test::Run reference = run_tool({"reference", file("steel.glb"), "--method", "path", "--samples",
                                        "256", "--points", file("p.csv"), "--stats", file("stats.json")});
  expect_told(reference);
  for (const std::string& cell : column(reference.out, "stderr_lx")) EXPECT_EQ(cell, "");
  EXPECT_NE(slurp(file("stats.json")).find("\"unsampled\""), std::string::npos);
}

TEST(Unsampled, StrictEndsWithoutAResult) {
  const test::Run run = run_tool({"sense", file("steel.glb"), "--exact", "--method", "path", "--samples",
                                  "256", "--points", file("p.csv"), "--strict", "-o", file("strict.csv")});
  EXPECT_EQ(run.code, 5) << run.err;
  EXPECT_FALSE(std::filesystem::exists(file("strict.csv")));
  EXPECT_EQ(run_tool({"irradiance", file("steel.glb"), "--estimate", "gather", "--gather-bounces", "1",
                      "--rays", "64", "--at", file("p.csv"), "--strict", "-o", file("s.irradiance")})
                .code,
            5);
}

TEST(Unsampled, DirectLightAloneIsAllThatIsAsked) {
  const test::Run run =
      run_tool({"sense", file("steel.glb"), "--direct-only", "--points", file("p.csv"), "--strict"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err.find("reaches surfaces"), std::string::npos) << run.err;
}

TEST(Unsampled, RecordsOfRaysPassItOn) {
  expect_told(
      run_tool({"irradiance", file("steel.glb"), "--estimate", "gather", "--gather-bounces", "1", "--rays",
                "64", "--place", "surface", "--min-radius", "0.5", "-o", file("g.irradiance")}));
  EXPECT_NE(slurp(file("g.irradiance")).find("unsampled"), std::string::npos);
  const test::Run sense =
      run_tool({"sense", file("steel.glb"), file("g.irradiance"), "--points", file("p.csv")});
  expect_told(sense);
  EXPECT_NE(sense.err.find("g.irradiance: lamp"), std::string::npos) << sense.err;
  for (const std::string& cell : column(sense.out, "stderr_lx")) EXPECT_EQ(cell, "");
  expect_told(run_tool({"splat", file("steel.glb"), file("g.irradiance"), "--splat", "cpu", "--width", "16",
                        "-o", file("g.exr")}));
  EXPECT_FALSE(read_image(file("g.exr")).has_layer("stderr"));
}

// Records that are kept beside new ones keep their note, whether or not the new ones would have one.
TEST(Unsampled, RecordsThatAreAddedToKeepTheirNote) {
  const std::vector<std::string> how{"--estimate", "gather", "--gather-bounces", "1",
                                     "--rays",     "64",     "--min-radius",     "0.5"};
  const auto make = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "irradiance"), words.insert(words.end(), how.begin(), how.end());
    return run_tool(words);
  };
  expect_told(make({file("steel.glb"), "--place", "surface", "-o", file("a.irradiance")}));
  const test::Run alone = make({file("matt.glb"), "--place", "surface", "-o", file("matt.irradiance")});
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(alone.err.find("reaches surfaces"), std::string::npos) << alone.err;
  EXPECT_EQ(slurp(file("matt.irradiance")).find("unsampled"), std::string::npos);

  const auto add = [&](const std::string& scene, const std::string& more) {
    std::vector<std::string> words{file(scene.c_str()),  "--at", file("p.csv"),        "--add-to",
                                   file("a.irradiance"), "-o",   file("b.irradiance"), "--allow-mismatch"};
    if (!more.empty()) words.push_back(more);
    return make(words);
  };
  for (const char* scene : {"steel.glb", "matt.glb"}) {
    std::filesystem::remove(file("b.irradiance"));
    const test::Run added = add(scene, "");
    expect_told(added);
    EXPECT_EQ(added.err.find("a.irradiance: lamp") != std::string::npos, scene == std::string("matt.glb"))
        << added.err;
    EXPECT_NE(slurp(file("b.irradiance")).find("unsampled"), std::string::npos) << scene;
    const test::Run sense =
        run_tool({"sense", file(scene), file("b.irradiance"), "--points", file("p.csv"), "--allow-mismatch"});
    expect_told(sense);
    for (const std::string& cell : column(sense.out, "stderr_lx")) EXPECT_EQ(cell, "");
  }
  std::filesystem::remove(file("b.irradiance"));
  EXPECT_EQ(add("matt.glb", "--strict").code, 5);
  EXPECT_FALSE(std::filesystem::exists(file("b.irradiance")));
}

TEST(Unsampled, PhotonsHoldIt) {
  const test::Run made = run_tool({"irradiance", file("steel.glb"), file("l.photons"), "--estimate", "hull",
                                   "--strict", "-o", file("h.irradiance")});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(slurp(file("h.irradiance")).find("unsampled"), std::string::npos);
  const test::Run sense =
      run_tool({"sense", file("steel.glb"), file("h.irradiance"), "--points", file("p.csv")});
  EXPECT_EQ(sense.code, 0) << sense.err;
  for (const std::string& cell : column(sense.out, "stderr_lx")) EXPECT_NE(cell, "");
  EXPECT_EQ(run_tool({"splat", file("steel.glb"), file("h.irradiance"), "--splat", "cpu", "--width", "16",
                      "--strict", "-o", file("h.exr")})
                .code,
            0);
  EXPECT_TRUE(read_image(file("h.exr")).has_layer("stderr"));
}

TEST(Unsampled, TheSceneAsksForCausticPhotons) {
  const test::Run run = run_tool({"scene", file("steel.glb")});
  EXPECT_NE(run.out.find("caustic photons"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("of lamp \"bulb\" by way of gloss of \"steel\""), std::string::npos) << run.out;
}

}  // namespace
