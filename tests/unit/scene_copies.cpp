// EXT_mesh_gpu_instancing and KHR_node_visibility.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/load.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

std::string write(const test::Gltf& g) {
  static int n = 0;
  const std::string path = test::scratch("copies" + std::to_string(n++)) + "/scene.glb";
  test::spill(path, g.bytes());
  return path;
}

Scene load(const test::Gltf& g, double time_s = 0) {
  SceneOptions options;
  options.time_s = time_s;
  return load_scene(write(g), options);
}

Json lamp_material() {
  Json m;
  m["emissiveFactor"] = Json::Array{1, 1, 1};
  return m;
}

/// A square that nothing else hides, and a square with copies.
struct Copies : test::Gltf {
  Json attributes = Json::Object{};
  explicit Copies(const Json& material = lamp_material()) {
    Json paint;
    paint["pbrMetallicRoughness"]["metallicFactor"] = 0;
    square_node(paint);
    Json p = square();
    p["material"] = this->material(material);
    copied["mesh"] = mesh(p);
    copied["name"] = "lamp";
    copied["translation"] = Json::Array{10, 0, 0};
  }
  Json copied;
  const Copies& done() {
    copied["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    node(copied);
    return *this;
  }
};

TEST(Copies, StandWhereTheAttributesSay) {
  Copies g;
  const float h = std::sqrt(0.5f);
  g.attributes["TRANSLATION"] = g.vec3({1, 0, 0, 0, 2, 0});
  g.attributes["ROTATION"] = g.accessor<float>({0, 0, 0, 1, 0, h, 0, h}, "VEC4", 4, 5126);
  g.attributes["SCALE"] = g.vec3({1, 1, 1, 2, 3, 1});
  const Scene s = load(g.done());
  ASSERT_EQ(s.instance.size(), 3u);
  EXPECT_EQ(s.instance[1].node, "lamp[0]");
  EXPECT_EQ(s.instance[2].node, "lamp[1]");
  const auto corner = [&](std::size_t i) {  // (1, 1, 0) of the square
    return s.position[s.triangle[s.instance[i].first_triangle].v[2]];
  };
  EXPECT_NEAR(glm::length(corner(1) - Vec3(12, 1, 0)), 0, 1e-5);
  EXPECT_NEAR(glm::length(corner(2) - Vec3(10, 5, -2)), 0, 1e-5) << "a quarter turn about y takes x to -z";
  ASSERT_EQ(s.light.size(), 2u);
  EXPECT_NEAR(s.light[1].area_m2, 6, 1e-4);
}

TEST(Copies, NormalizedRotations) {
  for (const bool bytes : {true, false}) {
    Copies g;
    if (bytes)
      g.attributes["ROTATION"] = g.accessor<std::int8_t>({0, 127, 0, 0}, "VEC4", 4, 5120, true);
    else
      g.attributes["ROTATION"] = g.accessor<std::int16_t>({0, 32767, 0, 0}, "VEC4", 4, 5122, true);
    const Scene s = load(g.done());
    ASSERT_EQ(s.instance.size(), 2u);
    EXPECT_NEAR(s.normal[s.triangle[s.instance[1].first_triangle].v[0]].z, -1, 1e-6);
  }
}

TEST(Copies, NoneAtAll) {
  Copies g;
  g.attributes["TRANSLATION"] = g.vec3({});
  const Scene s = load(g.done());
  EXPECT_EQ(s.instance.size(), 1u);
  EXPECT_TRUE(s.light.empty());
}

TEST(Copies, RequiredOrUsedAlike) {
  Copies g;
  g.attributes["TRANSLATION"] = g.vec3({1, 0, 0, 0, 2, 0});
  g.json["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
  g.json["extensionsRequired"].push_back("EXT_mesh_gpu_instancing");
  EXPECT_EQ(load(g.done()).instance.size(), 3u);
}

TEST(Copies, WhatIsWrongIsBadInput) {
  const auto complaint = [](const auto& fill) {
    Copies g;
    fill(g);
    const std::string path = write(g.done());
    return test::complaint_of([&] { load_scene(path); });
  };
  EXPECT_NE(complaint([](Copies& g) {
              g.attributes["TRANSLATION"] = g.vec3({1, 0, 0, 0, 2, 0});
              g.attributes["SCALE"] = g.vec3({1, 1, 1});
            }).find("has"),
            std::string::npos);
  EXPECT_NE(complaint([](Copies&) {}).find("no attributes"), std::string::npos);
  EXPECT_NE(complaint([](Copies& g) { g.attributes["TRANSLATION"] = 99; }).find("accessors"),
            std::string::npos);
  EXPECT_NE(complaint([](Copies& g) {
              g.attributes["TRANSLATION"] = g.vec2({1, 2});
            }).find("3 components"),
            std::string::npos);
  EXPECT_NE(complaint([](Copies& g) {
              g.attributes["SCALE"] = g.vec3({NAN, 1, 1});
            }).find("not finite"),
            std::string::npos);
  EXPECT_NE(complaint([](Copies& g) {
              g.attributes["ROTATION"] = g.accessor<std::int8_t>({0, 1, 0, 0}, "VEC4", 4, 5120);
            }).find("normalized"),
            std::string::npos);
}

TEST(Copies, ScalesOfZeroLeaveNothing) {
  Copies g;
  g.attributes["SCALE"] = g.vec3({0, 0, 0, 1, 1, 1});
  const Scene s = load(g.done());
  EXPECT_EQ(s.instance.size(), 2u);
  EXPECT_EQ(s.events.at("degenerate triangles dropped"), 2u);
}

test::Gltf hidden(bool visible) {
  test::Gltf g;
  Json paint;
  paint["pbrMetallicRoughness"]["metallicFactor"] = 0;
  g.square_node(paint);  // node 0
  Json light, bulb, camera, eye;
  light["type"] = "point";
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{light};
  camera["type"] = "perspective";
  camera["perspective"]["yfov"] = 1, camera["perspective"]["znear"] = 0.1;
  g.json["cameras"].push_back(camera);
  Json parent;
  parent["extensions"]["KHR_node_visibility"]["visible"] = visible;
  parent["children"] = Json::Array{2, 3, 4};
  g.node(parent);  // node 1
  Json p = g.square();
  p["material"] = g.material(lamp_material());
  Json child;
  child["mesh"] = g.mesh(p);
  bulb["extensions"]["KHR_lights_punctual"]["light"] = 0;
  eye["camera"] = 0;
  for (const Json& n : {child, bulb, eye}) g.json["nodes"].push_back(n);
  return g;
}

/// Key frames of node 1's visibility: hidden from 1 s on.
void hide_later(test::Gltf& g) {
  const int times = g.scalars({0, 1});
  const int values = g.accessor<std::uint8_t>({1, 0}, "SCALAR", 1, 5121);
  Json sampler, channel, animation;
  sampler["input"] = times, sampler["output"] = values, sampler["interpolation"] = "STEP";
  channel["sampler"] = 0;
  channel["target"]["path"] = "pointer";
  channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
      "/nodes/1/extensions/KHR_node_visibility/visible";
  animation["samplers"].push_back(sampler), animation["channels"].push_back(channel);
  g.json["animations"].push_back(animation);
}

TEST(Visibility, HidesMeshesAndLightsBelowButNotCameras) {
  const Scene shown = load(hidden(true)), gone = load(hidden(false));
  EXPECT_EQ(shown.instance.size(), 2u);
  EXPECT_EQ(shown.light.size(), 2u);
  EXPECT_EQ(gone.instance.size(), 1u);
  EXPECT_TRUE(gone.light.empty());
  EXPECT_EQ(gone.camera.size(), 1u);
  EXPECT_TRUE(losses(gone).empty());
}

TEST(Visibility, AnAnimationHides) {
  for (const bool visible : {true, false}) {  // the animation holds at every time
    test::Gltf g = hidden(visible);
    hide_later(g);
    const Scene before = load(g, 0), after = load(g, 1.5);
    EXPECT_EQ(before.light.size(), 2u);
    EXPECT_TRUE(after.light.empty());
    EXPECT_EQ(after.triangle.size(), before.triangle.size()) << "the same triangles at every time";
    EXPECT_EQ(area_m2(after, 2) + area_m2(after, 3), 0);
    EXPECT_TRUE(losses(after).empty());
    EXPECT_TRUE(is_finite(after.bounds.lo) && is_finite(after.bounds.hi));
  }
}

TEST(Visibility, MustBeTrueOrFalse) {
  test::Gltf g;
  g.square_node();
  Json n;
  n["extensions"]["KHR_node_visibility"]["visible"] = 0;
  g.node(n);
  EXPECT_THROW(load(g), Error);
}

}  // namespace
}  // namespace phos
