// Along what an anisotropic material is stretched: the tangents of the file, else growing u, else horizontal;
// and KHR_materials_anisotropy's rotation and map.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/load.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"
#include "scene/report/lint.h"
#include "scene/shading_frame.h"
#include "support/gltf.h"
#include "support/run.h"

using namespace phos;
using namespace phos::test;

namespace {

Scene load(const Gltf& gltf) {
  const std::string path = scratch("scene_bsdf_tangents") + "/scene.glb";
  spill(path, gltf.bytes());
  return load_scene(path);
}

Json ward() {
  Json m;
  m["name"] = "brushed";
  m["extras"]["phos"]["brdf"] = "ward";
  m["extras"]["phos"]["ks"] = 0.5;
  m["extras"]["phos"]["ax"] = 0.1;
  m["extras"]["phos"]["ay"] = 0.5;
  return m;
}

Json khronos(double rotation_rad) {
  Json m;
  m["name"] = "khronos";
  m["pbrMetallicRoughness"]["roughnessFactor"] = 0.4;
  m["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 0.8;
  m["extensions"]["KHR_materials_anisotropy"]["anisotropyRotation"] = rotation_rad;
  return m;
}

/// A 24-bit BMP of one texel.
std::string one_texel(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  std::string bmp(
      "BM:\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0\0\0\0\0\x04\0\0\0"
      "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
      54);
  for (const std::uint8_t c : {b, g, r, std::uint8_t{0}}) bmp += static_cast<char>(c);
  return bmp;
}

/// The middle of the unit square of Gltf::square, seen from above (or below) it.
SurfacePoint middle(const Scene& scene, const Vec3& from = Vec3(0.5f, 0.5f, 1)) {
  SurfacePoint point;
  const Vec3 to(0.5f, 0.5f, 0);
  EXPECT_TRUE(trace(RayScene(scene), {from, glm::normalize(to - from), 0, kInfinity}, point));
  return point;
}

/// The model at `point` must be that of a frame whose x is `tangent`, and not that of one turned from it.
void expect_along(const Scene& scene, const SurfacePoint& point, const Vec3& tangent) {
  const Vec3 n = point.normal, t = glm::normalize(tangent);
  const Bsdf actual(scene, point), expected(scene, point.material, Frame{t, glm::cross(n, t), n});
  const Vec3 wo = glm::normalize(n + 0.2f * t);
  for (const float a : {0.f, 0.5f, 1.f, 1.5f, 2.f, 4.f}) {
    const Vec3 wi = glm::normalize(n + 0.7f * (std::cos(a) * t + std::sin(a) * glm::cross(n, t)));
    const float e = expected.evaluate(wo, wi).x;
    EXPECT_NEAR(actual.evaluate(wo, wi).x, e, 1e-4f * e) << a;
  }
  const Vec3 across = glm::cross(n, t);
  const float along_x = actual.evaluate(n, glm::normalize(n + 0.7f * t)).x;
  const float along_y = actual.evaluate(n, glm::normalize(n + 0.7f * across)).x;
  EXPECT_GT(std::fabs(std::log(along_x / along_y)), 0.5f);
}

}  // namespace

TEST(Tangents, OfTheFileComeFirst) {
  for (const bool back : {false, true}) {
    Gltf g;
    Json p = g.square();
    const float c = 0.8f, s = 0.6f;
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), {c, s, 0, 1});
    p["attributes"]["TANGENT"] = g.accessor(tangents, "VEC4", 4, 5126);
    p["material"] = g.material(ward());
    Json n;
    n["mesh"] = g.mesh(p);
    g.node(n);
    const Scene scene = load(g);
    expect_along(scene, middle(scene, {0.5f, 0.5f, back ? -1.f : 1.f}), {c, s, 0});
  }
}

TEST(Tangents, FollowTheNode) {
  // Turned by 30 degrees about z and mirrored in x, which turns the tangent the other way.
  Gltf g;
  g.square_node(ward());
  Json n = g.json.find("nodes")->as_array()[0];
  const double half = M_PI / 12;
  n["rotation"] = Json::Array{0, 0, std::sin(half), std::cos(half)};
  n["scale"] = Json::Array{-1, 1, 1};
  g.json["nodes"] = Json::Array{n};
  const Scene scene = load(g);
  SurfacePoint point;
  const float a = static_cast<float>(M_PI / 6);
  const Vec3 x(std::cos(a), std::sin(a), 0), y(-std::sin(a), std::cos(a), 0);
  const Vec3 to = -0.5f * x + 0.5f * y;
  ASSERT_TRUE(trace(RayScene(scene), {to + Vec3(0, 0, 1), {0, 0, -1}, 0, kInfinity}, point));
  expect_along(scene, point, -x);
}

TEST(Tangents, ElseGrowingU) {
  Gltf g;
  Json p = g.square();
  p["attributes"]["TEXCOORD_0"] = g.vec2({0, 0, 0, 1, 1, 1, 1, 0});  // u along y
  p["material"] = g.material(ward());
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  Scene scene = load(g);
  expect_along(scene, middle(scene), {0, 1, 0});
  scene.tangent.clear();  // as for scenes made without the loader
  expect_along(scene, middle(scene), {0, 1, 0});
  scene.uv0.assign(scene.uv0.size(), Vec2(0.5f));  // coordinates that tell nothing
  expect_along(scene, middle(scene), {1, 0, 0});
}

TEST(Tangents, ElseHorizontalAndTheLintSaysSo) {
  Gltf g;
  Json p = g.square();
  Json without = Json::Object{};
  for (const auto& [name, accessor] : p.find("attributes")->as_object()) {
    if (name != "TEXCOORD_0") without[name] = accessor;
  }
  p["attributes"] = without;
  p["material"] = g.material(ward());
  Json n;
  n["mesh"] = g.mesh(p);
  n["name"] = "panel";
  g.node(n);
  const Scene scene = load(g);
  expect_along(scene, middle(scene), {1, 0, 0});
  bool said = false;
  for (const Finding& f : lint_scene(scene)) said |= f.code == "anisotropic-without-tangents";
  EXPECT_TRUE(said);
  EXPECT_EQ(level_tangent(Vec3(0, 1, 0)), Vec3(1, 0, 0));
  EXPECT_EQ(level_tangent(Vec3(0, -1, 0)), Vec3(1, 0, 0));
  EXPECT_EQ(level_tangent(Vec3(1, 0, 0)).y, 0);
}

TEST(Tangents, KhronosRotationTurnsTowardsTheBitangent) {
  // v grows upwards on the square, so that up in the picture, the bitangent, is -y.
  for (const bool back : {false, true}) {
    Gltf g;
    g.square_node(khronos(M_PI / 6));
    const Scene scene = load(g);
    const float a = static_cast<float>(M_PI / 6);
    expect_along(scene, middle(scene, {0.5f, 0.5f, back ? -1.f : 1.f}), {std::cos(a), -std::sin(a), 0});
  }
}

TEST(Tangents, KhronosMapGivesDirectionAndStrength) {
  Gltf g;
  const std::string bmp = one_texel(218, 218, 51);  // right and up in the picture, a fifth of the strength
  Json image, texture;
  image["bufferView"] = g.view(std::vector<char>(bmp.begin(), bmp.end()));
  g.json["images"].push_back(image);
  texture["source"] = 0;
  g.json["textures"].push_back(texture);
  Json m = khronos(0);
  m["extensions"]["KHR_materials_anisotropy"]["anisotropyTexture"]["index"] = 0;
  m["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 1;
  g.square_node(m);
  const Scene scene = load(g);
  ASSERT_TRUE(scene.material[0].anisotropy_map.used());
  const SurfacePoint point = middle(scene);
  EXPECT_NEAR(point.tangent.x * point.tangent.y, -0.5f, 1e-4f);

  Json plain = khronos(M_PI / 4);
  plain["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 0.2;
  Gltf h;
  h.square_node(plain);
  const Scene other = load(h);
  const Bsdf a(scene, point), b(other, middle(other));
  const Vec3 wo = glm::normalize(Vec3(0.3f, 0.1f, 1)), wi = glm::normalize(Vec3(-0.5f, 0.4f, 1));
  EXPECT_NEAR(a.evaluate(wo, wi).x, b.evaluate(wo, wi).x, 1e-3f * b.evaluate(wo, wi).x);
}

TEST(Tangents, KhronosStrengthWidensAlongTheTangent) {
  Gltf g;
  g.square_node(khronos(0));
  const Scene scene = load(g);
  Material same = scene.material[0];
  same.model = Model::conductor;
  same.ks = same.kd;
  same.alpha_x = 0.16f + (1 - 0.16f) * 0.64f, same.alpha_y = 0.16f;
  Scene metal;
  metal.material = {same, scene.material[0]};
  metal.material[1].metallic = 1;
  const Bsdf a(metal, 0), b(metal, 1);
  for (const float x : {0.f, 0.4f, -0.8f}) {
    const Vec3 wo = glm::normalize(Vec3(0.2f, 0.3f, 1)), wi = glm::normalize(Vec3(x, 0.5f, 1));
    EXPECT_NEAR(a.evaluate(wo, wi).y, b.evaluate(wo, wi).y, 1e-5f * a.evaluate(wo, wi).y);
  }
}

TEST(Tangents, KhronosValuesOutOfRangeAreErrors) {
  for (const double strength : {-0.1, 1.5}) {
    Gltf g;
    Json m = khronos(0);
    m["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = strength;
    g.square_node(m);
    EXPECT_THROW(load(g), Error);
  }
}
