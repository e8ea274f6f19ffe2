// Solids of glass that are odd, or that have a sensor or a camera in them: what programs say, and what they
// measure in the air about them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/gltf.h"
#include "support/refused.h"

namespace phos::test {
namespace {

struct Box {
  float centre[3], half[3];
};

/// A floor of 4 x 4 m, reflectance 0.5, a lamp of 100 cd 2 m over its middle, and boxes of glass, n = 1.5.
/// `spoilt`: each box has a triangle without area.
std::string scene_of(const std::vector<Box>& boxes, const std::string& path, Json volume = Json(),
                     bool spoilt = false, const std::vector<double>& eye = {0, 0.3, 1.8}) {
  Gltf g;
  Json floor;
  floor["name"] = "floor";
  floor["pbrMetallicRoughness"]["metallicFactor"] = 0;
  floor["extras"]["phos"]["brdf"] = "lambert";
  for (int c = 0; c < 3; ++c) floor["extras"]["phos"]["kd"].push_back(0.5);
  Json glass;
  glass["name"] = "glass";
  glass["pbrMetallicRoughness"]["metallicFactor"] = 0;
  glass["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  Json& extensions = glass["extensions"];
  extensions["KHR_materials_transmission"]["transmissionFactor"] = 1;
  extensions["KHR_materials_ior"]["ior"] = 1.5;
  volume["thicknessFactor"] = 0.2;
  extensions["KHR_materials_volume"] = volume;
  const auto add = [&](const std::vector<float>& corners, const std::vector<std::uint16_t>& indices, int m) {
    Json p, node;
    p["attributes"]["POSITION"] = g.vec3(corners);
    p["indices"] = g.indices(indices);
    p["material"] = m;
    node["mesh"] = g.mesh(p);
    g.node(node);
  };
  const int on_floor = g.material(floor), of_glass = g.material(glass);
  add({-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2}, {0, 1, 2, 0, 2, 3}, on_floor);
  for (const Box& box : boxes) {
    std::vector<float> corners;
    for (int k = 0; k < 8; ++k)
      for (int c = 0; c < 3; ++c) corners.push_back(box.centre[c] + (k >> c & 1 ? 1.f : -1.f) * box.half[c]);
    std::vector<std::uint16_t> faces{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    if (spoilt) faces.insert(faces.end(), {0, 0, 1});
    add(corners, faces, of_glass);
  }
  Json lamp, light, camera, view;
  light["type"] = "point", light["name"] = "lamp", light["intensity"] = 100;
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
  for (const double x : {0.0, 2.0, 0.0}) lamp["translation"].push_back(x);
  lamp["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.node(lamp);
  view["type"] = "perspective", view["perspective"]["yfov"] = 0.9, view["perspective"]["znear"] = 0.01;
  g.json["cameras"].push_back(view);
  for (const double x : eye) camera["translation"].push_back(x);
  camera["name"] = "eye", camera["camera"] = 0;
  g.node(camera);
  for (const char* used :
       {"KHR_lights_punctual", "KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"})
    g.json["extensionsUsed"].push_back(used);
  spill(path, g.bytes());
  return path;
}

constexpr Box kPlate{{0, 0.5f, 0}, {0.5f, 0.1f, 0.5f}};

/// Direct light on the floor under the lamp, lx, and what is said.
double under_lamp_lx(const std::string& scene, std::string* said = nullptr) {
  const std::string points = scene + ".csv";
  spill(points, "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n");
  const auto run = run_tool({"sense", scene, "--direct-only", "--points", points});
  EXPECT_EQ(run.code, 0) << run.err;
  if (said) *said = run.err;
  const std::size_t row = run.out.find("\n0,0,0,0,0,1,0,");
  return row == std::string::npos ? -1 : std::stod(run.out.substr(row + 15));
}

std::string findings(const std::string& scene) { return run_tool({"scene", scene}).out; }

void expect_found(const std::string& text, const std::string& word) {
  EXPECT_NE(text.find(word), std::string::npos) << text;
}

}  // namespace

TEST(Glass, SensorsInItAreRefused) {
  const std::string folder = scratch("sense_glass"), scene = scene_of({kPlate}, folder + "/plate.glb"),
                    points = folder + "/points.csv", out = folder + "/out.csv";
  const std::string line =
      points +
      ": the sensor at (0.1, 0.5, 0) m is inside of solid glass \"glass\", where no light is measured: "
      "move it into the air";
  // In the middle, and on the lower face, turned to the inside of the glass.
  for (const std::string at : {"0.1,0.5,0,0,1,0", "0.1,0.5,0,0,-1,0"}) {
    spill(points, "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n" + at + "\n");
    expect_refused("sense", {scene, "--exact", "--points", points, "-o", out}, 3, line);
    expect_refused("sense", {scene, "--direct-only", "--points", points, "-o", out}, 3, line);
    expect_refused("reference", {scene, "--points", points, "-o", out}, 3, line);
  }
  spill(points, "x,y,z,nx,ny,nz\n0.1,0.4,0,0,1,0\n");
  expect_refused("sense", {scene, "--direct-only", "--points", points, "-o", out}, 3,
                 "inside of solid glass");
  EXPECT_FALSE(std::filesystem::exists(out));
  // On its faces, turned to the air, and between glass and floor.
  spill(points, "x,y,z,nx,ny,nz\n0.1,0.6,0,0,1,0\n0.1,0.4,0,0,-1,0\n0.1,0.2,0,0,1,0\n");
  const auto run = run_tool({"sense", scene, "--direct-only", "--points", points, "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
}

/// A workplane whose level is that of a face of the plate, and one through it.
TEST(Glass, GridsLeaveItsInsideOut) {
  const std::string folder = scratch("sense_glass_grid"), scene = scene_of({kPlate}, folder + "/plate.glb");
  const auto left_out = [&](const std::string& height) {
    const auto run = run_tool(
        {"sense", scene, "--direct-only", "--grid", "0.25", "--height", height, "-o", folder + "/o"});
    EXPECT_EQ(run.code, 0) << run.err;
    const std::size_t at = run.err.find(" points of the grid are left out");
    if (at == std::string::npos) return 0;
    return std::stoi(run.err.substr(run.err.rfind(": ", at) + 2));
  };
  EXPECT_EQ(left_out("0.2"), 0);
  EXPECT_EQ(left_out("0.5"), 16) << "of 16 x 16 points those in 1 m2";
  EXPECT_EQ(left_out("0.4"), 16) << "its lower face, from inside";
  EXPECT_EQ(left_out("0.6"), 0) << "its upper face, from the air";
}

TEST(Glass, WithoutThicknessIsAPane) {
  const std::string folder = scratch("sense_glass_flat"),
                    flat = scene_of({{{0, 0.5f, 0}, {0.5f, 0, 0.5f}}}, folder + "/flat.glb"),
                    line = scene_of({{{0, 0.5f, 0}, {0.5f, 0, 0}}}, folder + "/line.glb"),
                    spoilt = scene_of({kPlate}, folder + "/spoilt.glb", Json(), true),
                    plate = scene_of({kPlate}, folder + "/plate.glb");
  EXPECT_NEAR(under_lamp_lx(flat), 25 * 0.92307692, 1e-3);
  expect_found(findings(flat), "1 instances of it enclose no volume; each is read as a thin pane");
  EXPECT_NEAR(under_lamp_lx(line), 25, 1e-3);
  expect_found(findings(line), "12 triangles have no area and were left out");
  // First passage through 0.2 m of glass on the axis: I (1-R)^2 / (h + d / n)^2, of all passages the flux
  // (docs/methods.md#g1-7).
  const double truth = 100 * 0.92307692 / std::pow(1.8 + 0.2 / 1.5, 2);
  EXPECT_NEAR(under_lamp_lx(plate), truth, 1e-3 * truth);
  EXPECT_EQ(under_lamp_lx(spoilt), under_lamp_lx(plate));
  expect_found(findings(spoilt), "1 triangles have no area and were left out");
  // Facing down in the plane of the pane: its back is no inside of a solid.
  spill(folder + "/points.csv", "x,y,z,nx,ny,nz\n0.1,0.5,0.1,0,-1,0\n0.1,0.5,0.1,0,1,0\n");
  const auto run = run_tool({"sense", flat, "--direct-only", "--points", folder + "/points.csv"});
  EXPECT_EQ(run.err.find("inside of solids"), std::string::npos) << run.err;
}

TEST(Glass, OfAttenuationDistanceZeroIsBlack) {
  const std::string folder = scratch("sense_glass_black");
  Json volume;
  volume["attenuationDistance"] = 0;
  for (int c = 0; c < 3; ++c) volume["attenuationColor"].push_back(0.5);
  EXPECT_EQ(under_lamp_lx(scene_of({kPlate}, folder + "/black.glb", volume)), 0);
  volume["attenuationDistance"] = -1;
  expect_refused("photons", {scene_of({kPlate}, folder + "/negative.glb", volume), "-o", folder + "/o"}, 3,
                 "attenuationDistance must not be negative");
}

TEST(Glass, WithinGlassIsTold) {
  const std::string folder = scratch("sense_glass_nested"),
                    line = "glass \"glass\" lies within glass \"glass\"";
  const Box outer{{0, 0.5f, 0}, {0.5f, 0.3f, 0.5f}}, inner{{0, 0.5f, 0}, {0.2f, 0.1f, 0.2f}};
  const std::string nested = scene_of({outer, inner}, folder + "/nested.glb");
  expect_found(findings(nested), "[nested-glass] " + line);
  std::string said;
  under_lamp_lx(nested, &said);
  expect_found(said, line);
  expect_found(run_tool({"photons", nested, "--photons", "10", "-o", folder + "/o.photons"}).err, line);
  // Beside each other, touching: none lies within the other.
  const std::string beside =
      scene_of({{{-0.2f, 0.5f, 0}, {0.2f, 0.1f, 0.2f}}, {{0.2f, 0.5f, 0}, {0.2f, 0.1f, 0.2f}}},
               folder + "/beside.glb");
  EXPECT_EQ(findings(beside).find("nested-glass"), std::string::npos);
}

TEST(Glass, WithACameraInItIsTold) {
  const std::string folder = scratch("sense_glass_camera"),
                    scene = scene_of({kPlate}, folder + "/camera.glb", Json(), false, {0, 0.5, 0});
  const std::string line = "camera \"eye\" stands inside of solid glass \"glass\": move it";
  expect_found(findings(scene), line);
  const auto run = run_tool(
      {"reference", scene, "--method", "path", "--width", "8", "--samples", "2", "-o", folder + "/o.exr"});
  EXPECT_EQ(run.code, 0) << run.err;
  expect_found(run.err, line);
}

/// Of 300 photons some are kept by the block about the lamp.
TEST(Glass, LightThatItKeepsIsTold) {
  const std::string folder = scratch("sense_glass_kept"),
                    scene = scene_of({{{0, 2, 0}, {0.5f, 0.3f, 0.5f}}}, folder + "/lamp.glb"),
                    out = folder + "/o.photons";
  const auto run = run_tool({"photons", scene, "--photons", "300", "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  expect_found(run.err, " photons ended in glass: total reflection keeps their light in it");
  expect_found(run_tool({"info", out}).out, "photon that total reflection keeps in glass ended");
}

}  // namespace phos::test
