// What the loader lost or put in place of something is told by every program that reads the scene.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

using test::run_tool;

std::size_t count(const std::string& in, const std::string& words) {
  std::size_t n = 0;
  for (std::size_t at = in.find(words); at != std::string::npos; at = in.find(words, at + 1)) ++n;
  return n;
}

/// A lit floor whose brick is not there, seen by a camera.
struct Losses : testing::Test {
  const std::string folder = test::scratch("losses");
  std::string file(const std::string& name) const { return folder + "/" + name; }

  test::Gltf room(bool with_texture = true) const {
    test::Gltf g;
    Json material, image, texture, light, lamp, camera, eye;
    material["name"] = "brick";
    material["pbrMetallicRoughness"]["metallicFactor"] = 0;
    if (with_texture) {
      image["uri"] = "brick.png", texture["source"] = 0;
      g.json["images"].push_back(image), g.json["textures"].push_back(texture);
      material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    }
    g.square_node(material);
    light["type"] = "point", light["intensity"] = 1000;
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{light};
    lamp["translation"] = Json::Array{0.5, 0.5, 2};
    lamp["extensions"]["KHR_lights_punctual"]["light"] = 0;
    g.node(lamp);
    camera["type"] = "perspective";
    camera["perspective"]["yfov"] = 0.5, camera["perspective"]["znear"] = 0.1;
    g.json["cameras"].push_back(camera);
    eye["camera"] = 0, eye["translation"] = Json::Array{0.5, 0.5, 3};
    g.node(eye);
    return g;
  }
  void SetUp() override {
    test::spill(file("lost.glb"), room().bytes());
    test::spill(file("whole.glb"), room(false).bytes());
    test::spill(file("p.csv"), "0.5,0.5,0.1,0,0,1\n");
  }
  std::string cache_of(const std::string& scene) const {
    const std::string cache = scene + ".irradiance";
    run_tool({"irradiance", scene, "--estimate", "gather", "--gather-bounces", "1", "--rays", "16", "--at",
              file("p.csv"), "-o", cache});
    return cache;
  }
  std::vector<std::vector<std::string>> commands(const std::string& scene) const {
    const std::string cache = cache_of(scene);
    return {{"photons", scene, "--photons", "1000", "-o", file("x.photons")},
            {"irradiance", scene, "--estimate", "gather", "--gather-bounces", "1", "--rays", "16", "--at",
             file("p.csv"), "-o", file("x.irradiance")},
            {"sense", scene, "--direct-only", "--points", file("p.csv"), "-o", file("x.csv")},
            {"sense", scene, "--exact", "--samples", "16", "--points", file("p.csv"), "-o", file("x.csv")},
            {"reference", scene, "--samples", "64", "--width", "8", "-o", file("x.exr")},
            {"splat", scene, cache, "--width", "8", "-o", file("y.exr")},
            {"brdf", scene, "-o", file("x.brdf")}};
  }
};

TEST_F(Losses, AreToldOnceByEveryProgram) {
  for (const std::vector<std::string>& command : commands(file("lost.glb"))) {
    const test::Run run = run_tool(command);
    EXPECT_EQ(run.code, 0) << command[0] << run.err;
    EXPECT_EQ(count(run.err, "warning: texture not found: brick.png"), 1u) << command[0] << run.err;
  }
}

TEST_F(Losses, StrictRefusesThem) {
  for (std::vector<std::string> command : commands(file("lost.glb"))) {
    std::filesystem::remove(command.back());
    const std::string output = command.back();
    command.push_back("--strict");
    const test::Run run = run_tool(command);
    EXPECT_EQ(run.code, 3) << command[0] << run.err;
    EXPECT_FALSE(std::filesystem::exists(output)) << command[0];
  }
}

TEST_F(Losses, StrictPassesWhatIsWhole) {
  for (std::vector<std::string> command : commands(file("whole.glb"))) {
    command.push_back("--strict");
    const test::Run run = run_tool(command);
    EXPECT_EQ(run.code, 0) << command[0] << run.err;
    EXPECT_EQ(count(run.err, "not found"), 0u) << command[0] << run.err;
  }
}

TEST_F(Losses, PhosSceneHasThemAmongItsFindings) {
  const test::Run run = run_tool({"scene", file("lost.glb")});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(count(run.out, "warning [texture-not-found] texture not found: brick.png"), 1u) << run.out;
  EXPECT_EQ(run_tool({"scene", file("lost.glb"), "--strict"}).code, 3);
  EXPECT_EQ(run_tool({"scene", file("whole.glb"), "--strict"}).code, 0);
}

TEST_F(Losses, ASequenceTellsThemOnce) {
  const test::Run run = run_tool({"splat", file("lost.glb"), cache_of(file("lost.glb")), "--frames", "0:2",
                                  "--width", "8", "-o", file("f%d.exr")});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(count(run.err, "texture not found"), 1u) << run.err;
}

TEST_F(Losses, AStudyTellsThemOnce) {
  test::spill(
      file("study.toml"),
      "[study]\nscenes = [\"lost.glb\"]\nsensors = \"p.csv\"\nthreads = 1\n[photons]\nphotons = [200, 400]\n"
      "[irradiance]\n[sense]\n[reference]\nsensor_samples = 16\n");
  const test::Run strict = run_tool({"study", file("study.toml"), "-o", file("study"), "--strict"});
  EXPECT_EQ(strict.code, 3) << strict.err;
  const test::Run run = run_tool({"study", file("study.toml"), "-o", file("study"), "--list"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(count(run.err, "texture not found"), 1u) << run.err;
}

TEST_F(Losses, APlanTellsThemOnce) {
  const test::Run run = run_tool({"plan", file("lost.glb"), "--error", "20%", "--quantity", "lux",
                                  "--sensors", file("p.csv"), "--strict"});
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_EQ(count(run.err, "warning: texture not found: brick.png"), 1u) << run.err;
}

}  // namespace
}  // namespace phos
