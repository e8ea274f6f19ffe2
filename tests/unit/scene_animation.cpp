// Keyframes by the formulas of glTF 2.0, and nodes and lights at a time.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/load.h"
#include "scene/motion/animation.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

using test::Gltf;

Keyframes ramp(Interpolation interpolation) {
  Keyframes k;
  k.time_s = {1, 3};
  k.width = 1;
  k.interpolation = interpolation;
  k.value = interpolation == Interpolation::cubic_spline ? std::vector<float>{0, 10, 2, 4, 20, 0}
                                                         : std::vector<float>{10, 20};
  return k;
}

TEST(Keyframes, HoldOutsideTheKeys) {
  for (const auto i : {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
    EXPECT_EQ(sample_keyframes(ramp(i), -5)[0], 10.0f);
    EXPECT_EQ(sample_keyframes(ramp(i), 1)[0], 10.0f);
    EXPECT_EQ(sample_keyframes(ramp(i), 3)[0], 20.0f);
    EXPECT_EQ(sample_keyframes(ramp(i), 99)[0], 20.0f);
  }
}

TEST(Keyframes, Between) {
  EXPECT_EQ(sample_keyframes(ramp(Interpolation::step), 2.9)[0], 10.0f);
  EXPECT_FLOAT_EQ(sample_keyframes(ramp(Interpolation::linear), 1.5)[0], 12.5f);
  // Hermite at t = 1/2 over 2 s: (10 + 20) / 2 + 2 s (out-tangent 2 - in-tangent 4) / 8.
  EXPECT_FLOAT_EQ(sample_keyframes(ramp(Interpolation::cubic_spline), 2)[0], 14.5f);
}

TEST(Keyframes, RotationsSlerpTheShortWay) {
  Keyframes k;
  k.time_s = {0, 1};
  k.width = 4;
  k.rotation = true;
  const float h = std::sqrt(0.5f);
  k.value = {0, 0, 0, 1, 0, 0, -h, -h};  // a quarter turn about z, written with the other sign
  const std::vector<float> q = sample_keyframes(k, 0.5);
  const double angle = 2 * std::atan2(std::abs(q[2]), std::abs(q[3]));
  EXPECT_NEAR(angle, M_PI / 4, 1e-6);
  EXPECT_GT(q[2] * q[3], 0);
}

struct Moving {
  Gltf g;
  Moving() {
    g.square_node();
    Json light;
    light["type"] = "point";
    light["intensity"] = 1;
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{light};
    Json n;
    n["name"] = "lamp";
    n["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const int lamp = g.node(n);
    Json move, dim, to_lamp, to_intensity, animation;
    move["input"] = g.scalars({0, 2});
    move["output"] = g.vec3({0, 0, 1, 4, 0, 1});
    dim["input"] = g.scalars({0, 2});
    dim["output"] = g.scalars({100, 300});
    to_lamp["sampler"] = 0;
    to_lamp["target"]["node"] = lamp;
    to_lamp["target"]["path"] = "translation";
    to_intensity["sampler"] = 1;
    to_intensity["target"]["path"] = "pointer";
    to_intensity["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
        "/extensions/KHR_lights_punctual/lights/0/intensity";
    animation["samplers"] = Json::Array{move, dim};
    animation["channels"] = Json::Array{to_lamp, to_intensity};
    g.json["animations"] = Json::Array{animation};
    Json scene = g.json.find("scenes")->as_array()[0];
    scene["extras"]["animation"]["fps"] = 10;
    scene["extras"]["animation"]["frames"] = 20;
    g.json["scenes"] = Json::Array{scene};
    path = test::scratch("scene_animation") + "/moving.glb";
    test::spill(path, g.bytes());
  }
  Scene at(std::optional<double> time_s, std::optional<double> frame = {}) const {
    SceneOptions options;
    options.time_s = time_s;
    options.frame = frame;
    return load_scene(path, options);
  }
  std::string path;
};

TEST(Animation, LampMovesAndBrightens) {
  const Moving m;
  const Scene start = m.at({}), middle = m.at(1.0), frame = m.at({}, 10);
  EXPECT_EQ(start.light[0].position, Vec3(0, 0, 1));
  EXPECT_EQ(start.light[0].intensity, Rgb(100));
  EXPECT_EQ(middle.light[0].position, Vec3(2, 0, 1));
  EXPECT_EQ(middle.light[0].intensity, Rgb(200));
  EXPECT_EQ(frame.hash, middle.hash);
  EXPECT_NE(start.hash, middle.hash);
  EXPECT_EQ(start.frames, 20);
  EXPECT_EQ(start.frames_per_s, 10);
  ASSERT_EQ(start.animation.size(), 1u);
  EXPECT_EQ(start.animation[0].targets[0], "node lamp translation");
  EXPECT_EQ(start.animation[0].end_s, 2);
}

TEST(Animation, PartsSayWhatMoved) {
  const Moving m;
  const Scene a = m.at(0.0), b = m.at(1.0);
  EXPECT_EQ(*a.parts.find("geometry"), *b.parts.find("geometry"));
  EXPECT_NE(*a.parts.find("lights"), *b.parts.find("lights"));
  EXPECT_EQ(*a.parts.find("nodes")->find("square"), *b.parts.find("nodes")->find("square"));
  EXPECT_NE(*a.parts.find("nodes")->find("lamp"), *b.parts.find("nodes")->find("lamp"));
}

TEST(Animation, TimeAndFrameTogetherAreAUsageError) {
  const Moving m;
  try {
    m.at(1.0, 2.0);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
  }
}

TEST(Animation, ShippedSceneMoves) {
  SceneOptions later;
  later.frame = 200;
  const Scene a = load_scene(test::data("moving-light.glb")),
              b = load_scene(test::data("moving-light.glb"), later);
  EXPECT_EQ(a.frames, 400);
  EXPECT_EQ(a.frames_per_s, 25);
  EXPECT_NE(a.light[0].position, b.light[0].position);
  EXPECT_NEAR(luminance(a.light[0].flux_lm), 1.2 * 179 * 4 * M_PI * (0.2126 + 0.7152 * 0.93 + 0.0722 * 0.8),
              0.5);
}

}  // namespace
}  // namespace phos
