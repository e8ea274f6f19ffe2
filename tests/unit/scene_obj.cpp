// OBJ, MTL, and the lights and cameras beside them.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/load.h"
#include "support/run.h"

namespace phos {
namespace {

constexpr const char* kSquare =
    "mtllib room.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "g floor\nusemtl paint\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
    "g lamp\nusemtl lamp\nf 1 5 2\n";
constexpr const char* kMaterials =
    "newmtl paint\nKd 0.4 0.5 0.6\nKs 0.1 0.2 0.3\nNs 25\nillum 2\n"
    "newmtl lamp\nKd 0 0 0\nKe 100 200 300\n";
constexpr const char* kLights = R"({
  "lights": [{"name": "spot", "kind": "spot", "position": [0, 0, 3], "direction": [0, 0, -2], "intensity": 50,
              "inner_deg": 10, "outer_deg": 30},
             {"name": "sun", "kind": "directional", "direction": [0, -1, 0], "intensity": [1, 2, 3]}],
  "cameras": [{"name": "front", "eye": [0, 0, 5], "target": [0, 0, 0], "yfov_deg": 40}]})";

class Obj : public ::testing::Test {
 protected:
  std::string folder = test::scratch("scene_obj");
  Scene load(const std::string& obj, const std::string& mtl = kMaterials, const std::string& lights = "") {
    test::spill(folder + "/room.obj", obj);
    if (!mtl.empty()) test::spill(folder + "/room.mtl", mtl);
    if (!lights.empty()) test::spill(folder + "/room.lights.json", lights);
    return load_scene(folder + "/room.obj");
  }
  std::string error_of(const std::string& obj, const std::string& mtl = kMaterials,
                       const std::string& lights = "") {
    try {
      load(obj, mtl, lights);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      return e.what();
    }
    return "";
  }
};

TEST_F(Obj, GeometryMaterialsAndLights) {
  const Scene s = load(kSquare, kMaterials, kLights);
  ASSERT_EQ(s.instance.size(), 2u);
  EXPECT_EQ(s.instance[0].node, "floor");
  EXPECT_EQ(s.instance[0].triangle_count, 2u);
  EXPECT_EQ(s.uv0[0], Vec2(0, 1));  // OBJ's rows count from below
  const Material& paint = s.material[s.instance[0].material];
  EXPECT_EQ(paint.model, Model::phong);
  EXPECT_EQ(paint.kd, Rgb(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(paint.exponent, 25.0f);
  ASSERT_EQ(s.light.size(), 3u);
  for (const Light& l : s.light) {
    if (l.kind == Light::Kind::area) {
      EXPECT_NEAR(l.flux_lm.y, kPi * 200 * 0.5f, 1e-3);
    }
    if (l.kind == Light::Kind::spot) {
      EXPECT_EQ(l.direction, Vec3(0, 0, -1));
    }
    if (l.kind == Light::Kind::directional) {
      EXPECT_EQ(l.intensity, Rgb(1, 2, 3));
    }
  }
  ASSERT_EQ(s.camera.size(), 1u);
  EXPECT_EQ(s.camera[0].to_world,
            Mat4(Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 0, 5, 1)));
  const std::vector<std::string> files = scene_files(folder + "/room.obj");
  EXPECT_EQ(files, (std::vector<std::string>{folder + "/room.obj", folder + "/room.lights.json",
                                             folder + "/room.mtl"}));
}

/// kLights with a cone of these half angles.
std::string with_cone(const std::string& inner, const std::string& outer) {
  std::string lights = kLights;
  const std::string cone = R"("inner_deg": 10, "outer_deg": 30)";
  return lights.replace(lights.find(cone), cone.size(),
                        "\"inner_deg\": " + inner + ", \"outer_deg\": " + outer);
}

TEST_F(Obj, ConesWithHardEdgesAndOfHalfTheSphere) {
  for (const auto& [angle, cosine] : {std::pair{"60", 0.5}, {"90", 0.0}, {"90.00001", 0.0}}) {
    for (const Light& l : load(kSquare, kMaterials, with_cone(angle, angle)).light) {
      if (l.kind == Light::Kind::spot) {
        EXPECT_NEAR(l.flux_lm.x, 50 * 2 * M_PI * (1 - cosine), 1e-4) << angle;
      }
    }
  }
  for (const auto& [inner, outer] : {std::pair{"40", "30"}, {"0", "0"}, {"10", "95"}, {"-1", "30"}})
    EXPECT_NE(error_of(kSquare, kMaterials, with_cone(inner, outer)).find("\"inner_deg\" <= \"outer_deg\""),
              std::string::npos)
        << inner << " " << outer;
}

TEST_F(Obj, SmoothingGroupsShareNormals) {
  // A roof: two faces over one ridge (vertices 1 and 2).
  const std::string roof = "v 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 0 -1\nv 1 0 -1\n";
  const std::string faces = "f 1 3 4 2\nf 2 6 5 1\n";
  const Scene smooth = load(roof + "s 1\n" + faces, ""), flat = load(roof + "s off\n" + faces, "");
  EXPECT_EQ(smooth.position.size(), 6u);
  EXPECT_NEAR(smooth.normal[0].y, 1, 1e-6);
  EXPECT_EQ(flat.position.size(), 12u);
  EXPECT_NEAR(flat.normal[0].y, std::sqrt(0.5), 1e-6);
}

TEST_F(Obj, MissingMaterialFileIsAWarning) {
  const Scene s = load("mtllib nowhere.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n", "");
  EXPECT_EQ(s.material[0].kd, Rgb(0.5f));
  EXPECT_EQ(s.warnings[0].line(), "material file not found: nowhere.mtl");
}

TEST_F(Obj, BadInputIsOneLine) {
  for (const char* obj : {"hello, this is a letter\n", "v 0 0 0\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
                          "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"}) {
    const std::string message = error_of(obj);
    EXPECT_NE(message, "") << obj;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(Obj, BadLightsAreNamed) {
  for (const char* lights :
       {"[]", "{\"lights\": 3}", "{\"lights\": [{\"kind\": \"laser\", \"intensity\": 1}]}",
        "{\"lights\": [{\"kind\": \"point\", \"intensity\": -1, \"position\": [0,0,0]}]}",
        "{\"lights\": [{\"kind\": \"point\", \"intensity\": 1, \"position\": [0,0]}]}",
        "{\"cameras\": [{\"eye\": [0,0,0], \"target\": [0,0,0]}]}", "{\"lights\": [{\"kind\": 7}]}", "{"}) {
    EXPECT_NE(error_of(kSquare, kMaterials, lights), "") << lights;
  }
}

}  // namespace
}  // namespace phos
