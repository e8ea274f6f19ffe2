// Names of the scene that options give, with commas and "=" in them, or unlike by case only.
#include <gtest/gtest.h>

#include "scene/load.h"
#include "scene/opening/find_portals.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

/// Point lights of these names above the unit square.
Scene lit_by(const std::vector<std::string>& names, const std::vector<std::string>& luminaires) {
  test::Gltf g;
  g.square_node();
  Json light;
  light["type"] = "point";
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
  for (const std::string& name : names) {
    Json node;
    node["name"] = name, node["translation"] = Json::Array{0, 0, 2};
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    g.node(node);
  }
  const std::string path = test::scratch("scene_names") + "/scene.glb";
  test::spill(path, g.bytes());
  SceneOptions options;
  options.luminaires.of_lights = luminaires, options.luminaires.as = LuminairesAs::points;
  return load_scene(path, options);
}

/// Names of the lights that measured distributions were given to.
std::set<std::string> measured(const Scene& scene) {
  std::set<std::string> names;
  for (const Light& light : scene.light)
    if (light.kind == Light::Kind::measured) names.insert(light.name);
  return names;
}

using Names = std::set<std::string>;

TEST(NamesOfLights, AreTakenToTheLetter) {
  const std::string file = test::data("luminaires/flood.ies");
  const std::vector<std::string> all = {"Lamp 3,5", "Lamp 3", "lamp 3,5", "Lamp 3,5=a", "Lamp"};
  EXPECT_EQ(measured(lit_by(all, {"Lamp 3,5=" + file})), Names{"Lamp 3,5"});
  EXPECT_EQ(measured(lit_by(all, {"lamp 3,5=" + file})), Names{"lamp 3,5"});
  EXPECT_EQ(measured(lit_by(all, {"Lamp 3=" + file})), Names{"Lamp 3"});
  EXPECT_EQ(measured(lit_by(all, {"Lamp 3,5=a=" + file})), Names{"Lamp 3,5=a"});
  EXPECT_EQ(measured(lit_by(all, {R"(Lamp 3\,5\=a=)" + file})), Names{"Lamp 3,5=a"});
  EXPECT_EQ(measured(lit_by(all, {"Lamp 3,5=" + file + ",lamp 3,5=" + file})),
            (Names{"Lamp 3,5", "lamp 3,5"}));
  const auto twice = [&] { lit_by(all, {"Lamp 3,5=" + file, R"(Lamp 3\,5=)" + file}); };
  EXPECT_NE(test::complaint_of(twice, ExitCode::usage).find("given twice"), std::string::npos);
}

TEST(NamesOfPortals, MayHoldCommas) {
  test::Gltf g;
  for (const char* name : {"Window 1,2", "window 1,2", "Window 1"}) {
    Json m;
    m["name"] = std::string(name) + " glass";
    Json p = g.square(), n;
    p["material"] = g.material(m);
    n["mesh"] = g.mesh(p), n["name"] = name;
    g.node(n);
  }
  const std::string path = test::scratch("scene_names") + "/scene.glb";
  test::spill(path, g.bytes());
  const Scene scene = load_scene(path);
  for (const auto& [names, windows] : {std::pair{"Window 1,2", 1},
                                       {R"(Window 1\,2)", 1},
                                       {"Window 1", 1},
                                       {"Window 1,Window 1,2", 2},
                                       {"window 1,2 glass,Window 1", 2}})
    EXPECT_EQ(named_portals(scene, names).size(), 2u * static_cast<unsigned>(windows)) << names;
  const std::string why = test::complaint_of([&] { named_portals(scene, "Window 1,3"); }, ExitCode::usage);
  EXPECT_NE(why.find("there is no node or material \"3\""), std::string::npos) << why;
}

}  // namespace
}  // namespace phos
