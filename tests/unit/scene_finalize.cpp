// finalize(), the scene hash, the lint and what a scene requires.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "scene/load.h"
#include "scene/report/describe.h"
#include "scene/report/describe_text.h"
#include "scene/report/lint.h"
#include "support/run.h"

namespace phos {
namespace {

/// A closed box of Lambert walls of side `size`, facing outwards (or inwards), that shines.
Scene box(float size, bool inside_out, float luminance_cd_m2 = 100) {
  Scene s;
  Material m;
  m.name = "m";
  m.kd = Rgb(0.5f);
  m.emission = Rgb(luminance_cd_m2);
  s.material.push_back(m);
  for (int i = 0; i < 8; ++i) s.position.push_back(size * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    s.triangle.push_back({{q[0], q[1], q[2]}});
    s.triangle.push_back({{q[0], q[2], q[3]}});
  }
  for (Triangle& t : s.triangle) {
    if (inside_out) std::swap(t.v[1], t.v[2]);
  }
  s.triangle_instance.assign(12, 0);
  Instance i;
  i.node = "box";
  i.triangle_count = 12;
  s.instance.push_back(i);
  return s;
}

Scene finished(Scene s) {
  finalize(s);
  return s;
}

bool has(const std::vector<Finding>& findings, const std::string& code) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.code == code; });
}

TEST(Finalize, MakesNormalsBoundsAndAreaLights) {
  for (const float size : {1e-6f, 1.0f, 1e6f}) {
    const Scene s = finished(box(size, false));
    EXPECT_EQ(s.position.size(), 36u);
    EXPECT_FLOAT_EQ(s.bounds.diagonal_m(), size * std::sqrt(3.0f));
    ASSERT_EQ(s.light.size(), 1u);
    EXPECT_FLOAT_EQ(s.light[0].area_m2, 6 * size * size);
    EXPECT_FLOAT_EQ(s.light[0].flux_lm.x, kPi * 100 * 6 * size * size);
    for (std::uint32_t t = 0; t < 12; ++t) {
      EXPECT_NEAR(glm::length(s.normal[s.triangle[t].v[0]]), 1, 1e-6);
      EXPECT_GT(glm::dot(s.normal[s.triangle[t].v[0]], s.position[s.triangle[t].v[0]] - Vec3(0.5f * size)),
                0);
    }
  }
}

TEST(Finalize, TwiceIsOnce) {
  Scene s = finished(box(1, false));
  const std::string hash = s.hash;
  finalize(s);
  EXPECT_EQ(s.hash, hash);
  EXPECT_EQ(s.light.size(), 1u);
}

TEST(Finalize, TwoSidedShinesTwice) {
  Scene s = box(1, false);
  s.material[0].double_sided = true;
  EXPECT_FLOAT_EQ(finished(s).light[0].flux_lm.x, 2 * kPi * 100 * 6);
}

TEST(Finalize, EmissiveTextureIsAveraged) {
  Scene s;
  Material m;
  m.emission = Rgb(10);
  m.emissive.texture = 0;
  s.material.push_back(m);
  Texture t;
  t.width = 2, t.height = 1;
  t.texels = {Vec4(0, 0, 0, 1), Vec4(1, 1, 1, 1)};
  t.nearest = true;
  s.texture.push_back(t);
  s.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  s.triangle = {{{0, 1, 2}}, {{0, 2, 3}}};
  s.triangle_instance = {0, 0};
  Instance i;
  i.triangle_count = 2;
  s.instance.push_back(i);
  EXPECT_NEAR(finished(s).light[0].flux_lm.x, kPi * 5, 0.3);
}

TEST(Finalize, RefusesWhatIsBroken) {
  const auto refuses = [](void (*breaks)(Scene&)) {
    Scene s = box(1, false);
    breaks(s);
    EXPECT_THROW(finalize(s), Error);
  };
  refuses([](Scene& s) { s.triangle[3].v[1] = 99; });
  refuses([](Scene& s) { s.position[0].x = NAN; });
  refuses([](Scene& s) { s.position[0].x = kInfinity; });
  refuses([](Scene& s) { s.triangle.clear(), s.triangle_instance.clear(); });
  refuses([](Scene& s) { s.instance[0].material = 5; });
  refuses([](Scene& s) { s.instance[0].triangle_count = 11; });
  refuses([](Scene& s) { s.instance[0].triangle_count = 13; });
  refuses([](Scene& s) { s.triangle_instance[2] = 1; });
  refuses([](Scene& s) { s.uv0.resize(3); });
  refuses([](Scene& s) { s.material[0].base_colour.texture = 0; });
}

TEST(Hash, ChangesWithLightAndNotWithNames) {
  const std::string hash = finished(box(1, false)).hash;
  Scene s = box(1, false);
  s.instance[0].node = "other", s.material[0].name = "other";
  s.camera.emplace_back();
  s.position[0] = Vec3(-0.0f);
  EXPECT_EQ(finished(s).hash, hash);
  s.material[0].kd.x = 0.51f;
  EXPECT_NE(finished(s).hash, hash);
  s = box(1, false);
  s.position[7].x += 1e-6f;
  EXPECT_NE(finished(s).hash, hash);
  s = box(1, false);
  Light l;
  l.intensity = Rgb(1);
  s.light.push_back(l);
  EXPECT_NE(finished(s).hash, hash);
}

TEST(Hash, ManyNodesAreNotListed) {
  Scene s;
  s.material.emplace_back();
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i);
    s.position.insert(s.position.end(), {Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x, 1, 0)});
    s.triangle.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
    s.triangle_instance.push_back(i);
    Instance instance;
    instance.node = "n" + std::to_string(i);
    instance.first_triangle = i;
    instance.triangle_count = 1;
    s.instance.push_back(instance);
  }
  EXPECT_EQ(finished(s).parts.find("nodes"), nullptr);
}

TEST(Lint, FindsLampsThatShineTheWrongWay) {
  EXPECT_FALSE(has(lint_scene(finished(box(1, false))), "light-inside-out"));
  EXPECT_TRUE(has(lint_scene(finished(box(1, true))), "light-inside-out"));
  Scene open = box(1, true);
  open.triangle.resize(2), open.triangle_instance.resize(2), open.instance[0].triangle_count = 2;
  for (Triangle& t : open.triangle) std::swap(t.v[1], t.v[2]);  // the bottom, facing down and away
  EXPECT_TRUE(has(lint_scene(finished(open)), "light-faces-away"));
}

TEST(Lint, AsksAboutUnits) {
  EXPECT_TRUE(has(lint_scene(finished(box(5000, false))), "too-large"));
  EXPECT_TRUE(has(lint_scene(finished(box(0.003f, false))), "too-small"));
  EXPECT_TRUE(has(lint_scene(finished(box(1, false, 0.1f))), "watts"));
  EXPECT_TRUE(has(lint_scene(finished(box(1, false, 1e6f))), "too-bright"));
  const std::vector<Finding> fine = lint_scene(finished(box(1, false, 100)));
  for (const char* code : {"too-large", "too-small", "watts", "too-bright", "no-light"})
    EXPECT_FALSE(has(fine, code));
}

TEST(Lint, FindsDarknessReflectanceAndNames) {
  Scene s = box(1, false, 0);
  s.material[0].kd = Rgb(1.2f);
  s.camera.resize(2);
  const std::vector<Finding> findings = lint_scene(finished(s));
  for (const char* code : {"no-light", "reflectance-above-one", "camera-name-twice", "normals-missing"}) {
    EXPECT_TRUE(has(findings, code)) << code;
  }
  EXPECT_EQ(findings[0].level, Finding::Level::error);
}

/// Not the powers that are asked for, but those that floats have no digits for.
TEST(Lights, PowersBelowNumbersAreRefused) {
  for (const float cd_m2 : {1e-12f, 1e-20f, 1e12f, 1e33f})
    EXPECT_NO_THROW(finished(box(1, false, cd_m2))) << cd_m2;
  const auto expect_refused = [](float size_m, float cd_m2) {
    try {
      finished(box(size_m, false, cd_m2));
      ADD_FAILURE() << size_m << " m, " << cd_m2 << " cd/m2";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(e.what()).find("too little for 32-bit numbers; give"), std::string::npos)
          << e.what();
    }
  };
  for (const float cd_m2 : {1e-37f, 1e-26f}) expect_refused(1, cd_m2);
  // The same lumens fade where they are spread too far.
  EXPECT_NO_THROW(finished(box(1e6f, false, 1e-22f)));
  expect_refused(1e9f, 1e-26f);
}

TEST(Lights, FaintOnesBesideOthersAreTold) {
  Scene s = box(1, false, 100);
  Light lamp;
  lamp.kind = Light::Kind::point, lamp.name = "spark", lamp.intensity = Rgb(1e-27f);
  s.light.push_back(lamp);
  const Scene done = finished(s);
  EXPECT_EQ(done.light.size(), 2u);
  EXPECT_TRUE(has(lint_scene(done), "light-too-faint"));
  EXPECT_FALSE(has(lint_scene(finished(box(1, false, 100))), "light-too-faint"));
}

TEST(Hash, KnowsTheParametersOfTheModel) {
  Scene s = box(1, false);
  const std::string lambert = finished(s).hash;
  s.material[0].sigma_rad = 0.3f;  // says nothing of another model
  EXPECT_EQ(finished(s).hash, lambert);
  s.material[0].model = Model::oren_nayar;
  const std::string rough = finished(s).hash;
  s.material[0].sigma_rad = 0.4f;
  EXPECT_NE(finished(s).hash, rough);
  EXPECT_NE(rough, lambert);
}

TEST(Requires, OnlyWhatTheSceneNeeds) {
  const auto names = [](const Scene& s) {
    std::string out;
    for (const Requirement& r : scene_requirements(s)) {
      EXPECT_FALSE(r.why.empty());
      out += r.what + ";";
    }
    return out;
  };
  Scene s = box(1, false);
  EXPECT_EQ(names(finished(s)), "direct light;global photons;irradiance records;");
  s.material[0].model = Model::phong, s.material[0].ks = Rgb(0.2f), s.material[0].exponent = 20;
  EXPECT_EQ(names(finished(s)), "direct light;global photons;irradiance records;gloss;");
  s.material[0].model = Model::oren_nayar, s.material[0].sigma_rad = 0.3f;
  EXPECT_EQ(names(finished(s)), "direct light;global photons;irradiance records;gloss;");
  s.material[0].sigma_rad = 0;
  EXPECT_EQ(names(finished(s)), "direct light;global photons;irradiance records;");
  s.material[0].model = Model::mirror;
  EXPECT_EQ(names(finished(s)), "specular tracing;");
}

TEST(Describe, TextAndJsonAgree) {
  const Scene s = load_scene(test::data("cornell-glossy22.glb"));
  const Json d = describe_scene(s, lint_scene(s));
  EXPECT_EQ(d.find("triangles")->as_integer(), 32);
  EXPECT_EQ(d.find("cameras")->as_array().size(), 3u);
  const std::string text = describe_text(d);
  EXPECT_NE(text.find("32 triangles"), std::string::npos);
  EXPECT_NE(text.find("irradiance records"), std::string::npos);
  EXPECT_NE(text.find(s.hash), std::string::npos);
}

}  // namespace
}  // namespace phos
