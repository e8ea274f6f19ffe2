// Broken scenes through every program that reads one: one line, exit code 3 (a camera that is not there: 2),
// nothing written.
#include <gtest/gtest.h>

#include <cmath>

#include "support/gltf.h"
#include "support/run.h"

namespace phos::test {
namespace {

/// A square of white Lambert, and beside it an emitting square of the given side.
Gltf lit_square(float light_side) {
  Gltf g;
  Json light;
  light["emissiveFactor"] = Json::Array{1, 1, 1};
  light["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1000;
  g.json["materials"].push_back(light);
  g.json["extensionsUsed"].push_back("KHR_materials_emissive_strength");
  Json floor_node, light_node;
  floor_node["mesh"] = g.mesh(g.square());
  g.node(floor_node);
  Json primitive = g.square();
  const float s = light_side;
  primitive["attributes"]["POSITION"] = g.vec3({0, 0, 1, s, 0, 1, s, s, 1, 0, s, 1});
  primitive["material"] = 0;
  light_node["mesh"] = g.mesh(primitive);
  g.node(light_node);
  return g;
}

class Broken : public testing::Test {
 protected:
  Broken() : folder_(scratch("cli-broken")), out_(folder_ + "/out") {}
  ~Broken() override { std::filesystem::remove_all(folder_); }

  /// `says` in the one line of each program that gets to read the scene.
  void expect_refused(const std::string& bytes, const std::string& says) {
    const std::string scene = folder_ + "/scene.glb";
    spill(scene, bytes);
    for (const char* tool : {"photons", "reference"}) {
      const auto run = run_tool({tool, scene, "-o", out_});
      EXPECT_EQ(run.code, 3) << tool << ": " << run.err;
      EXPECT_TRUE(is_one_line(run.err)) << run.err;
      EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
      EXPECT_FALSE(std::filesystem::exists(out_)) << tool;
    }
  }
  std::string folder_, out_;
};

TEST_F(Broken, TruncatedAtAnyPlace) {
  const std::string whole = slurp(data("cornell-measured.glb"));
  for (const std::size_t length : {0ul, 3ul, 12ul, 19ul, 20ul, 500ul, whole.size() / 2, whole.size() - 1})
    expect_refused(whole.substr(0, length), "scene.glb");
}

TEST_F(Broken, TextNamedGlb) { expect_refused("Hello, light.\n", "neither glTF nor OBJ"); }

TEST_F(Broken, UnknownRequiredExtensionIsNamed) {
  Gltf g = lit_square(1);
  g.json["extensionsUsed"].push_back("EXT_moonlight");
  g.json["extensionsRequired"].push_back("EXT_moonlight");
  expect_refused(g.bytes(), "EXT_moonlight");
}

TEST_F(Broken, VertexThatIsNoNumber) {
  Gltf g = lit_square(1);
  Json p = g.square(), n;
  p["attributes"]["POSITION"] = g.vec3({0, 0, 0, 1, 0, 0, 1, NAN, 0, 0, 1, 0});
  n["mesh"] = g.mesh(p);
  g.node(n);
  expect_refused(g.bytes(), "vertex 2");
}

TEST_F(Broken, IndexOutOfRange) {
  Gltf g = lit_square(1);
  g.json["nodes"].push_back(Json(Json::Object{{"mesh", 77}}));
  g.json["scenes"] = Json::Array{Json(Json::Object{{"nodes", Json::Array{0, 1, 2}}})};
  expect_refused(g.bytes(), "77");
}

TEST_F(Broken, LightWithoutAreaIsNoLight) {
  const std::string scene = folder_ + "/flat.glb";
  spill(scene, lit_square(0).bytes());
  const auto run = run_tool({"photons", scene, "-o", out_});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("no light"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(Broken, CameraThatIsNotThereAndNoCamera) {
  const std::string scene = folder_ + "/blind.glb";
  spill(scene, lit_square(1).bytes());
  const auto blind = run_tool({"reference", scene, "-o", out_});
  EXPECT_EQ(blind.code, 3);
  EXPECT_NE(blind.err.find("no camera"), std::string::npos) << blind.err;
  const auto lost = run_tool({"reference", data("cornell-measured.glb"), "--camera", "roof", "-o", out_});
  EXPECT_EQ(lost.code, 2);
  EXPECT_NE(lost.err.find("left-view"), std::string::npos) << lost.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace phos::test
