// glTF: geometry, nodes, materials, lights and cameras arrive as the file says.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "scene/load.h"
#include "scene/report/lint.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

using test::Gltf;

Scene load(const Gltf& gltf, const SceneOptions& options = {}) {
  const std::string path = test::scratch("scene_load") + "/scene.glb";
  test::spill(path, gltf.bytes());
  return load_scene(path, options);
}

std::string error_of(const Gltf& gltf) {
  return test::complaint_of([&] { load(gltf); });
}

Json phos_material(const std::string& brdf) {
  Json m;
  m["name"] = "m";
  m["extras"]["phos"]["brdf"] = brdf;
  return m;
}

double total_area(const Scene& s) {
  double sum = 0;
  for (std::uint32_t t = 0; t < s.triangle.size(); ++t) sum += area_m2(s, t);
  return sum;
}

TEST(Mesh, SquareArrives) {
  Gltf g;
  g.square_node();
  const Scene s = load(g);
  EXPECT_EQ(s.triangle.size(), 2u);
  EXPECT_EQ(s.position.size(), 4u);
  EXPECT_EQ(s.instance[0].node, "square");
  EXPECT_EQ(s.uv0.size(), 4u);
  EXPECT_NEAR(total_area(s), 1, 1e-6);
  EXPECT_EQ(s.normal[0], Vec3(0, 0, 1));
  EXPECT_EQ(s.hash.size(), 32u);
}

TEST(Mesh, MirroringKeepsFronts) {
  Gltf g;
  g.square_node();
  Json n = g.json.find("nodes")->as_array()[0];
  n["scale"] = Json::Array{-2, 1, 1};
  g.json["nodes"] = Json::Array{n};
  const Scene s = load(g);
  for (std::uint32_t t = 0; t < 2; ++t) EXPECT_EQ(geometric_normal(s, t), Vec3(0, 0, 1));
  EXPECT_EQ(s.normal[0], Vec3(0, 0, 1));
  EXPECT_NEAR(total_area(s), 2, 1e-6);
}

TEST(Mesh, StripsAndFansWindAlike) {
  for (const int mode : {5, 6}) {
    Gltf g;
    Json p = g.square();
    p["indices"] = mode == 5 ? g.indices({0, 1, 3, 2}) : g.indices({0, 1, 2, 3});
    p["mode"] = mode;
    Json n;
    n["mesh"] = g.mesh(p);
    g.node(n);
    const Scene s = load(g);
    ASSERT_EQ(s.triangle.size(), 2u) << mode;
    for (std::uint32_t t = 0; t < 2; ++t) EXPECT_EQ(geometric_normal(s, t), Vec3(0, 0, 1)) << mode;
    EXPECT_NEAR(total_area(s), 1, 1e-6);
  }
}

TEST(Mesh, MissingNormalsAreFlatAndCounted) {
  Gltf g;
  Json p;
  p["attributes"]["POSITION"] = g.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  p["indices"] = g.indices({0, 1, 2, 0, 2, 3});
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  const Scene s = load(g);
  EXPECT_EQ(s.position.size(), 6u);  // no shared vertices
  EXPECT_EQ(s.events.at("triangles given flat normals"), 2u);
  for (std::uint32_t t = 0; t < 2; ++t) {
    for (const std::uint32_t v : s.triangle[t].v) EXPECT_EQ(s.normal[v], geometric_normal(s, t));
  }
}

TEST(Mesh, BadNormalsAndDegenerateTrianglesAreMendedAndCounted) {
  Gltf g;
  Json p = g.square();
  p["attributes"]["NORMAL"] = g.vec3({0, 0, 0, NAN, 0, 1, 0, 0, 1, 0, 0, 3});
  p["indices"] = g.indices({0, 1, 2, 0, 2, 3, 0, 0, 1});
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  const Scene s = load(g);
  EXPECT_EQ(s.triangle.size(), 2u);
  EXPECT_EQ(s.events.at("degenerate triangles dropped"), 1u);
  EXPECT_EQ(s.events.at("normals repaired"), 2u);
  for (const Vec3& normal : s.normal) EXPECT_EQ(normal, Vec3(0, 0, 1));
}

TEST(Mesh, NormalisedIntegersSparseAndColours) {
  Gltf g;
  Json p = g.square();
  p["attributes"]["TEXCOORD_0"] =
      g.accessor(std::vector<std::uint8_t>{0, 0, 255, 0, 255, 255, 0, 51}, "VEC2", 2, 5121, true);
  p["attributes"]["COLOR_0"] = g.vec3({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  // The third corner moves out to (2, 2, 0).
  const int at = g.view(std::vector<std::uint16_t>{2}), with = g.view(std::vector<float>{2, 2, 0});
  Json a = g.json.find("accessors")->as_array()[0];
  a["sparse"]["count"] = 1;
  a["sparse"]["indices"]["bufferView"] = at;
  a["sparse"]["indices"]["componentType"] = 5123;
  a["sparse"]["values"]["bufferView"] = with;
  Json::Array list = g.json.find("accessors")->as_array();
  list[0] = a;
  g.json["accessors"] = list;
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  const Scene s = load(g);
  EXPECT_EQ(s.position[2], Vec3(2, 2, 0));
  EXPECT_NEAR(s.uv0[3].y, 0.2f, 1e-6f);
  EXPECT_EQ(s.colour[1], Vec4(0, 1, 0, 1));
}

TEST(Mesh, MorphTargetsBlendByWeight) {
  Gltf g;
  Json p = g.square();
  Json target;
  target["POSITION"] = g.vec3({0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4});
  p["targets"].push_back(target);
  Json n;
  n["mesh"] = g.mesh(p);
  n["weights"] = Json::Array{0.25};
  g.node(n);
  EXPECT_EQ(load(g).position[1], Vec3(1, 0, 1));
}

TEST(Mesh, TangentsAreMadeForNormalMaps) {
  Gltf g;
  Json image;  // one blue-grey pixel as BMP is enough for a normal map
  const std::string bmp(
      "BM:\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0\0\0\0\0\x04\0\0\0"
      "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff\x80\x80\0",
      58);
  const int view = g.view(std::vector<char>(bmp.begin(), bmp.end()));
  image["bufferView"] = view;
  g.json["images"].push_back(image);
  Json texture;
  texture["source"] = 0;
  g.json["textures"].push_back(texture);
  Json m;
  m["normalTexture"]["index"] = 0;
  g.square_node(m);
  const Scene s = load(g);
  ASSERT_EQ(s.texture.size(), 1u);
  EXPECT_NEAR(s.texture[0].texel(0).z, 1.0f, 1e-6f);
  EXPECT_NEAR(s.texture[0].texel(0).x, 128.0f / 255, 1e-6f);  // linear, not sRGB
  ASSERT_EQ(s.tangent.size(), 4u);
  for (const Vec4& t : s.tangent) EXPECT_EQ(t, Vec4(1, 0, 0, -1));  // v grows upwards: a mirrored picture
}

TEST(Nodes, TransformsComposeFromTheRoot) {
  Gltf g;
  const int child = static_cast<int>(g.square_node());
  Json n = g.json.find("nodes")->as_array()[0];
  n["translation"] = Json::Array{1, 0, 0};
  Json parent;  // a quarter turn about z, then up by 5
  parent["matrix"] = Json::Array{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1};
  parent["children"] = Json::Array{child};
  g.json["nodes"] = Json::Array{n, parent};
  Json scene;
  scene["nodes"] = Json::Array{1};
  g.json["scenes"] = Json::Array{scene};
  const Scene s = load(g);
  EXPECT_NEAR(glm::length(s.position[0] - Vec3(0, 6, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::length(s.position[1] - Vec3(0, 7, 0)), 0, 1e-6);
}

TEST(Nodes, CyclesAreAnError) {
  Gltf g;
  g.square_node();
  Json n = g.json.find("nodes")->as_array()[0];
  n["children"] = Json::Array{0};
  g.json["nodes"] = Json::Array{n};
  EXPECT_NE(error_of(g).find("its own ancestor"), std::string::npos);
}

TEST(Skin, JointsMoveVertices) {
  Gltf g;
  Json p = g.square();
  p["attributes"]["JOINTS_0"] = g.accessor(std::vector<std::uint8_t>(16, 0), "VEC4", 4, 5121);
  std::vector<float> weights;
  for (int i = 0; i < 4; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
  p["attributes"]["WEIGHTS_0"] = g.accessor(weights, "VEC4", 4, 5126);
  Json joint;
  joint["translation"] = Json::Array{0, 0, 3};
  const int j = g.node(joint);
  Json skin;
  skin["joints"] = Json::Array{j};
  g.json["skins"].push_back(skin);
  Json n;
  n["mesh"] = g.mesh(p);
  n["skin"] = 0;
  n["translation"] = Json::Array{100, 0, 0};  // glTF: the node of a skinned mesh does not move it
  g.node(n);
  EXPECT_EQ(load(g).position[0], Vec3(0, 0, 3));
}

TEST(Materials, ExactModelsComeFromExtras) {
  const auto loaded = [](Json m) {
    Gltf g;
    g.square_node(m);
    return load(g).material[0];
  };
  Json phong = phos_material("phong");
  phong["extras"]["phos"]["kd"] = Json::Array{0.1, 0.2, 0.3};
  phong["extras"]["phos"]["ks"] = Json::Array{0.4, 0.5, 0.6};
  phong["extras"]["phos"]["exponent"] = 22;
  const Material p = loaded(phong);
  EXPECT_EQ(p.model, Model::phong);
  EXPECT_EQ(p.kd, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(p.ks, Rgb(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(p.exponent, 22.0f);
  Json ward = phos_material("ward");
  ward["extras"]["phos"]["ax"] = 0.1;
  ward["extras"]["phos"]["ay"] = 0.3;
  EXPECT_EQ(loaded(ward).alpha_y, 0.3f);
  Json metal = phos_material("conductor");
  metal["extras"]["phos"]["f0"] = Json::Array{0.9, 0.8, 0.7};
  metal["extras"]["phos"]["alpha"] = 0.2;
  const Material c = loaded(metal);
  EXPECT_EQ(c.ks, Rgb(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(c.kd, Rgb(0));
  EXPECT_EQ(c.alpha_x, 0.2f);
  Json glass = phos_material("dielectric");
  glass["extras"]["phos"]["ior"] = 1.33;
  EXPECT_EQ(loaded(glass).ior, 1.33f);
  Json matt = phos_material("oren-nayar");
  matt["extras"]["phos"]["kd"] = Json::Array{0.4, 0.3, 0.2};
  matt["extras"]["phos"]["sigma"] = 0.35;
  EXPECT_EQ(loaded(matt).model, Model::oren_nayar);
  EXPECT_EQ(loaded(matt).kd, Rgb(0.4f, 0.3f, 0.2f));
  EXPECT_EQ(loaded(matt).sigma_rad, 0.35f);
  Json lambert = phos_material("lambert");
  lambert["pbrMetallicRoughness"]["baseColorFactor"] = Json::Array{0.5, 0.5, 0.5, 1};
  EXPECT_EQ(loaded(lambert).kd, Rgb(0.5f));
}

TEST(Materials, ASigmaInDegreesIsTold) {
  for (const double sigma : {1.5, 20.0}) {
    Json matt = phos_material("oren-nayar");
    matt["extras"]["phos"]["sigma"] = sigma;
    Gltf g;
    g.square_node(matt);
    const Scene scene = load(g);
    const bool told = std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const Note& note) {
      return note.message.find("radians") != std::string::npos;
    });
    EXPECT_EQ(told, sigma > 2) << sigma;
  }
}

TEST(Materials, UnknownModelIsNamed) {
  for (const char* name : {"measured", "velvet"}) {
    Gltf g;
    g.square_node(phos_material(name));
    EXPECT_NE(error_of(g).find(name), std::string::npos);
  }
}

TEST(Materials, NegativeValuesAreErrors) {
  Gltf g;
  Json m = phos_material("phong");
  m["extras"]["phos"]["ks"] = Json::Array{-1, 0, 0};
  g.square_node(m);
  EXPECT_NE(error_of(g).find("ks"), std::string::npos);
}

TEST(Materials, TransmissionIsGlassOnlyWhenSmooth) {
  const auto model = [](double roughness, bool volume) {
    Gltf g;
    Json m;
    m["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
    m["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 1;
    m["extensions"]["KHR_materials_ior"]["ior"] = 1.4;
    if (volume) m["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 0.1;
    g.square_node(m);
    return load(g).material[0].model;
  };
  EXPECT_EQ(model(0, false), Model::thin_dielectric);
  EXPECT_EQ(model(0, true), Model::thin_dielectric) << "a sheet that encloses nothing";
  EXPECT_EQ(model(0.6, false), Model::metallic_roughness);
}

TEST(Materials, MissingTextureIsAWarningAndTheFactorStays) {
  Gltf g;
  Json image;
  image["uri"] = "not-there.png";
  g.json["images"].push_back(image);
  Json texture;
  texture["source"] = 0;
  g.json["textures"].push_back(texture);
  Json m;
  m["pbrMetallicRoughness"]["metallicFactor"] = 0;
  m["pbrMetallicRoughness"]["baseColorFactor"] = Json::Array{0.3, 0.3, 0.3, 1};
  m["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  g.square_node(m);
  const Scene s = load(g);
  EXPECT_FALSE(s.material[0].base_colour.used());
  EXPECT_EQ(s.material[0].kd, Rgb(0.3f));
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_EQ(s.warnings[0].line().rfind("texture not found: not-there.png", 0), 0u) << s.warnings[0].line();
}

TEST(Lights, FluxOfEveryKind) {
  Gltf g;
  Json m;
  m["emissiveFactor"] = Json::Array{1, 0.5, 0.25};
  m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 100;
  g.square_node(m);
  const auto light = [&](const char* type, double intensity) {
    Json l;
    l["type"] = type;
    l["intensity"] = intensity;
    if (std::string(type) == "spot") {
      l["spot"]["innerConeAngle"] = 0.2;
      l["spot"]["outerConeAngle"] = 0.7;
    }
    Json list = g.json["extensions"]["KHR_lights_punctual"]["lights"];
    list.push_back(l);
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = list;
    Json n;
    n["name"] = type;
    n["extensions"]["KHR_lights_punctual"]["light"] = list.as_array().size() - 1;
    n["translation"] = Json::Array{0, 0, 2};
    g.node(n);
  };
  light("point", 10);
  light("spot", 10);
  light("directional", 5);
  const Scene s = load(g);
  ASSERT_EQ(s.light.size(), 4u);
  for (const Light& l : s.light) {
    switch (l.kind) {
      case Light::Kind::environment:
      case Light::Kind::measured:
        ADD_FAILURE() << "there is none in the file";
        break;
      case Light::Kind::area:
        EXPECT_NEAR(l.flux_lm.x, 100 * kPi, 1e-3);
        EXPECT_NEAR(l.flux_lm.z, 25 * kPi, 1e-3);
        EXPECT_NEAR(l.area_m2, 1, 1e-6);
        break;
      case Light::Kind::point:
        EXPECT_NEAR(l.flux_lm.x, 40 * kPi, 1e-3);
        break;
      case Light::Kind::spot: {
        // Simpson's rule over the falloff of KHR_lights_punctual.
        const double ci = std::cos(0.2), co = std::cos(0.7);
        const int n = 2000;
        double sum = 0;
        for (int i = 0; i <= n; ++i) {
          const double c = co + (1 - co) * i / n;
          const double t = std::clamp((c - co) / (ci - co), 0.0, 1.0);
          sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * t * t;
        }
        EXPECT_NEAR(l.flux_lm.x, 10 * 2 * M_PI * sum * (1 - co) / n / 3, 1e-4);
        EXPECT_EQ(l.direction, Vec3(0, 0, -1));
        EXPECT_EQ(l.position, Vec3(0, 0, 2));
        break;
      }
      case Light::Kind::directional:
        EXPECT_NEAR(l.flux_lm.x, 5 * kPi * 0.5, 1e-4);  // the square's bounding sphere has radius^2 = 1/2
        break;
    }
  }
}

/// A spot of 10 cd over the unit square, the half angles of its cone in rad.
Gltf spot_of(double inner, double outer) {
  Gltf g;
  g.square_node();
  Json l, n;
  l["type"] = "spot";
  l["intensity"] = 10;
  l["spot"]["innerConeAngle"] = inner;
  l["spot"]["outerConeAngle"] = outer;
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(l);
  n["name"] = "spot";
  n["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.node(n);
  return g;
}

TEST(Lights, ConesWithHardEdges) {
  // A hard edge: I x 2 pi (1 - cos), and a finding that does not ask for anything.
  for (const double angle : {0.5235987901687622, 0.01, 1.2, 0.5 * M_PI, double(float(0.5 * M_PI)), 1.571}) {
    const Scene s = load(spot_of(angle, angle));
    ASSERT_EQ(s.light.size(), 1u) << angle;
    const double cosine = std::cos(std::min(angle, 0.5 * M_PI));
    EXPECT_NEAR(s.light[0].flux_lm.x, 10 * 2 * M_PI * (1 - cosine), 1e-6 * 10 * 2 * M_PI) << angle;
    for (const Note& w : s.warnings) EXPECT_EQ(w.line().find("spot"), std::string::npos) << w.line();
    bool told = false;
    for (const Finding& f : lint_scene(s)) {
      if (f.code != "hard-edge") continue;
      told = true;
      EXPECT_EQ(f.level, Finding::Level::info);
    }
    EXPECT_TRUE(told) << angle;
  }
  const Scene soft = load(spot_of(0.5235, 0.5236));
  for (const Finding& f : lint_scene(soft)) EXPECT_NE(f.code, "hard-edge");
}

TEST(Lights, ConesOfHalfTheSphere) {
  // t = cos: the integral of cos^2 over the half sphere is 2 pi / 3.
  for (const double outer : {0.5 * M_PI, double(float(0.5 * M_PI)), 1.5708}) {
    const Scene s = load(spot_of(0, outer));
    EXPECT_NEAR(s.light[0].flux_lm.x, 10 * 2 * M_PI / 3, 1e-5) << outer;
  }
}

TEST(Lights, ConesThatAreNone) {
  for (const auto& [inner, outer] :
       {std::pair{0.6, 0.5}, {0.50001, 0.5}, {-0.1, 0.5}, {0.0, 0.0}, {0.1, 1.6}, {1.6, 1.6}, {0.0, 3.2}})
    EXPECT_NE(error_of(spot_of(inner, outer)).find("0 <= inner <= outer <= pi/2"), std::string::npos)
        << inner << " " << outer;
}

TEST(Cameras, KindsAndLookup) {
  Gltf g;
  g.square_node();
  Json perspective, orthographic;
  perspective["type"] = "perspective";
  perspective["name"] = "main";
  perspective["perspective"]["yfov"] = 0.5;
  perspective["perspective"]["znear"] = 0.1;
  orthographic["type"] = "orthographic";
  orthographic["orthographic"]["xmag"] = 4;
  orthographic["orthographic"]["ymag"] = 2;
  orthographic["orthographic"]["znear"] = 0;
  orthographic["orthographic"]["zfar"] = 1;
  g.json["cameras"] = Json::Array{perspective, orthographic};
  for (int i = 0; i < 2; ++i) {
    Json n;
    n["camera"] = i;
    n["scale"] = Json::Array{3, 3, 3};
    n["name"] = i ? "plan" : "eye";
    g.node(n);
  }
  const Scene s = load(g);
  EXPECT_EQ(find_camera(s, "").name, "main");
  EXPECT_EQ(find_camera(s, "plan").aspect, 2.0f);
  EXPECT_FALSE(find_camera(s, "plan").perspective);
  EXPECT_EQ(find_camera(s, "main").to_world[0], Vec4(1, 0, 0, 0));  // without the node's scale
  try {
    find_camera(s, "nope");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_NE(std::string(e.what()).find("\"main\", \"plan\""), std::string::npos);
  }
}

TEST(Document, RequiredExtensionIsNamed) {
  Gltf g;
  g.square_node();
  g.json["extensionsRequired"] = Json::Array{"EXT_something"};
  EXPECT_NE(error_of(g).find("EXT_something"), std::string::npos);
  g.json["extensionsRequired"] = Json::Array{"KHR_mesh_quantization"};
  EXPECT_EQ(error_of(g), "");
}

TEST(Document, ExternalFilesAreListed) {
  const std::string folder = test::scratch("scene_files");
  Gltf g;
  g.square_node();
  Json buffer;
  buffer["byteLength"] = g.bin.size();
  buffer["uri"] = "my%20data.bin";
  Json json = g.json;
  json["buffers"] = Json::Array{buffer};
  test::spill(folder + "/my data.bin", g.bin);
  test::spill(folder + "/scene.gltf", json.dump());
  EXPECT_EQ(load_scene(folder + "/scene.gltf").triangle.size(), 2u);
  EXPECT_EQ(scene_files(folder + "/scene.gltf"),
            (std::vector<std::string>{folder + "/scene.gltf", folder + "/my data.bin"}));
  for (const char* uri : {"/etc/hostname", "file:///etc/hostname", "http://a/b.bin"}) {
    buffer["uri"] = uri;
    json["buffers"] = Json::Array{buffer};
    test::spill(folder + "/scene.gltf", json.dump());
    EXPECT_THROW(load_scene(folder + "/scene.gltf"), Error) << uri;
  }
}

}  // namespace
}  // namespace phos
