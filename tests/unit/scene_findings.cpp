// What a glTF file says and phos does not model is told, once for each kind.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "scene/load.h"
#include "scene/report/describe.h"
#include "scene/report/lint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

Scene load(const test::Gltf& g, const SceneOptions& options = {}) {
  static int n = 0;
  const std::string path = test::scratch("findings" + std::to_string(n++)) + "/scene.glb";
  test::spill(path, g.bytes());
  return load_scene(path, options);
}

/// A wall, not metal.
Json wall(const std::string& name = "wall") {
  Json m;
  m["name"] = name;
  m["pbrMetallicRoughness"]["metallicFactor"] = 0;
  return m;
}

void use(test::Gltf& g, const char* extension) { g.json["extensionsUsed"].push_back(extension); }

std::vector<std::string> lines(const Scene& scene) {
  std::vector<std::string> out;
  for (const Note& n : losses(scene)) out.push_back(n.line());
  return out;
}

bool has_info(const Scene& scene, const std::string& words) {
  return std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const Note& n) {
    return n.level == Note::Level::info && n.line().find(words) != std::string::npos;
  });
}

TEST(Findings, NothingIsSaidOfAPlainScene) {
  test::Gltf g;
  g.square_node(wall());
  EXPECT_TRUE(lines(load(g)).empty());
}

TEST(Findings, AnUnknownExtensionIsNamedWithItsNode) {
  test::Gltf g;
  const int node = g.square_node(wall());
  use(g, "ACME_louvre");
  Json n = g.json.find("nodes")->as_array()[static_cast<std::size_t>(node)];
  n["extensions"]["ACME_louvre"]["x"] = 1;
  g.json["nodes"] = Json::Array{n};
  EXPECT_EQ(lines(load(g)),
            std::vector<std::string>{"node \"square\": ACME_louvre is not known, and is ignored"});
}

TEST(Findings, AnUnknownExtensionThatNothingUsesIsAnInfo) {
  test::Gltf g;
  g.square_node(wall());
  use(g, "ACME_louvre");
  const Scene s = load(g);
  EXPECT_TRUE(lines(s).empty());
  EXPECT_TRUE(has_info(s, "ACME_louvre is not known, and nothing uses it"));
}

TEST(Findings, ManyOfAKindAreOneLine) {
  test::Gltf g;
  for (int i = 0; i < 500; ++i) {
    Json m = wall(text("m", i));
    m["extensions"]["KHR_materials_unlit"] = Json::Object{};
    g.square_node(m);
  }
  EXPECT_EQ(lines(load(g)),
            std::vector<std::string>{"500 materials (\"m0\", \"m1\", \"m2\" and 497 more): "
                                     "KHR_materials_unlit is ignored: it is lit like others"});
  EXPECT_LT(lint_scene(load(g)).size(), 10u);
}

TEST(Findings, ExtensionsThatChangeNothingHereAreNotTold) {
  test::Gltf g;
  Json m = wall();
  m["extensions"]["KHR_materials_iridescence"] = Json::Object{};
  m["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 0;
  m["extensions"]["KHR_materials_dispersion"]["dispersion"] = 0;
  m["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = Json::Array{0, 0, 0};
  m["extensions"]["KHR_materials_specular"]["specularFactor"] = 0.5;
  m["extensions"]["KHR_materials_ior"]["ior"] = 1.4;
  g.square_node(m);
  EXPECT_TRUE(lines(load(g)).empty());
}

TEST(Findings, LightOrGeometryThatChangesIsAWarning) {
  for (const char* extension :
       {"KHR_materials_iridescence", "KHR_materials_dispersion", "KHR_materials_sheen",
        "KHR_materials_clearcoat", "KHR_materials_pbrSpecularGlossiness", "KHR_materials_volume_scatter"}) {
    test::Gltf g;
    Json m = wall(), values;
    values["iridescenceFactor"] = 1, values["dispersion"] = 0.1, values["clearcoatFactor"] = 1;
    values["sheenColorFactor"] = Json::Array{0, 0.1, 0};
    m["extensions"][extension] = values;
    g.square_node(m);
    const std::vector<std::string> told = lines(load(g));
    ASSERT_EQ(told.size(), 1u) << extension;
    EXPECT_EQ(told[0].rfind(std::string("material \"wall\": ") + extension, 0), 0u) << told[0];
  }
}

TEST(Findings, TexturesOfSpecularAreTold) {
  test::Gltf g;
  Json m = wall();
  m["extensions"]["KHR_materials_specular"]["specularTexture"]["index"] = 0;
  g.square_node(m);
  ASSERT_EQ(lines(load(g)).size(), 1u);
}

TEST(Findings, MetadataIsAnInfo) {
  test::Gltf g;
  g.square_node(wall());
  use(g, "KHR_xmp_json_ld");
  g.json["extensionsRequired"].push_back("KHR_xmp_json_ld");
  g.json["extensions"]["KHR_xmp_json_ld"]["packets"] = Json::Array{};
  const Scene s = load(g);
  EXPECT_TRUE(lines(s).empty());
  EXPECT_TRUE(has_info(s, "KHR_xmp_json_ld"));
}

TEST(Findings, ImageBasedLightIsAWarning) {
  test::Gltf g;
  g.square_node(wall());
  g.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::Array{};
  ASSERT_EQ(lines(load(g)).size(), 1u);
}

TEST(Findings, TheRangeOfALightIsTold) {
  test::Gltf g;
  g.square_node(wall());
  Json light, n;
  light["type"] = "point", light["range"] = 5, light["name"] = "bulb";
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{light};
  n["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.node(n);
  const std::vector<std::string> told = lines(load(g));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].rfind("light \"bulb\": range is ignored", 0), 0u) << told[0];
}

TEST(Findings, AMissingTextureIsAWarning) {
  test::Gltf g;
  Json image, texture, m = wall();
  image["uri"] = "brick.png", texture["source"] = 0;
  g.json["images"].push_back(image), g.json["textures"].push_back(texture);
  m["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  g.square_node(m);
  ASSERT_EQ(lines(load(g)).size(), 1u);
  EXPECT_EQ(lines(load(g))[0].rfind("texture not found: brick.png cannot be read beside the scene", 0), 0u);
  const std::vector<Finding> findings = lint_scene(load(g));
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.code == "texture-not-found" && f.level == Finding::Level::warning;
  }));
}

TEST(Findings, AnimatedValuesThatDoNotMoveAreTold) {
  test::Gltf g;
  g.square_node(wall());
  const int times = g.scalars({0, 1}), values = g.scalars({0, 1});
  Json sampler, channel, animation;
  sampler["input"] = times, sampler["output"] = values;
  channel["sampler"] = 0;
  channel["target"]["path"] = "pointer";
  channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
      "/materials/0/pbrMetallicRoughness/roughnessFactor";
  animation["name"] = "polish";
  animation["samplers"].push_back(sampler), animation["channels"].push_back(channel);
  g.json["animations"].push_back(animation);
  ASSERT_EQ(lines(load(g)).size(), 1u);
  EXPECT_EQ(
      lines(load(g))[0],
      "animation \"polish\": /materials/0/pbrMetallicRoughness/roughnessFactor is not moved: it stays as "
      "the file states it");
}

std::size_t told_metals(const Json& material, const char* generator = nullptr) {
  test::Gltf g;
  if (generator) g.json["asset"]["generator"] = generator;
  g.square_node(material);
  const Scene s = load(g);
  return static_cast<std::size_t>(std::count_if(s.warnings.begin(), s.warnings.end(),
                                                [](const Note& n) { return n.code == kMetalByDefault; }));
}

TEST(Findings, MetalByDefault) {
  Json paint;
  paint["name"] = "Wand-001";
  paint["pbrMetallicRoughness"]["baseColorFactor"] = Json::Array{0.8, 0.8, 0.75, 1};
  EXPECT_EQ(told_metals(paint), 1u);
  EXPECT_EQ(told_metals(paint, "ConverterGLTF"), 1u);
  EXPECT_EQ(told_metals(paint, "Khronos glTF Blender I/O v4.0"), 0u) << "it leaves defaults out";
  Json other = paint;
  other["name"] = "Chrome plate";
  EXPECT_EQ(told_metals(other), 0u);
  other = paint;
  other["pbrMetallicRoughness"]["metallicFactor"] = 1;
  EXPECT_EQ(told_metals(other), 0u) << "it says so";
  other = paint;
  other["pbrMetallicRoughness"]["baseColorFactor"] = Json::Array{0, 0, 0, 1};
  EXPECT_EQ(told_metals(other), 0u) << "it reflects nothing";
  other = paint;
  other["emissiveFactor"] = Json::Array{1, 1, 1};
  EXPECT_EQ(told_metals(other), 0u) << "a lamp";
  other = paint;
  other["extras"]["phos"]["brdf"] = "lambert";
  EXPECT_EQ(told_metals(other), 0u);
}

TEST(Findings, VertexColoursCountInReflectances) {
  test::Gltf g;
  Json p = g.square();
  // One triangle of 0.25 and one of 0.5: the corners 0 and 2 are shared.
  p["attributes"]["COLOR_0"] =
      g.vec3({0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 1, 1, 1});
  p["material"] = g.material(wall());
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  const Scene scene = load(g);
  EXPECT_NEAR(summarize_materials(scene)[0].reflectance, (0.25 + (0.25 + 0.25 + 1) / 3) / 2, 1e-6);
  const std::vector<Finding> findings = lint_scene(scene);
  EXPECT_TRUE(std::none_of(findings.begin(), findings.end(),
                           [](const Finding& f) { return f.code == "absorbs-nothing"; }));
}

}  // namespace
}  // namespace phos
