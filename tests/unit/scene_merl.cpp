// Measured reflection: analytic models written in MERL's layout come back, whole, reciprocal and counted.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "scene/load.h"
#include "scene/material/bsdf.h"
#include "scene/report/describe.h"
#include "scene/report/lint.h"
#include "support/gltf.h"
#include "support/merl_bytes.h"
#include "support/one_material.h"
#include "support/run.h"

using namespace phos;
using namespace phos::test;

namespace {

Vec3 random_direction(RandomStream& random, float least_cosine) {
  return direction(least_cosine + (1 - least_cosine) * random.uniform(), 6.2831853f * random.uniform());
}

/// Largest error of the table against the model, relative to the model's largest value over random pairs.
template <class F>
double largest_error(const MerlBrdf& table, const F& model, float least_cosine) {
  double worst = 0, largest = 0;
  for (int k = 0; k < 20000; ++k) {
    RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
    const Vec3 o = random_direction(random, least_cosine), i = random_direction(random, least_cosine);
    const Rgb expected = model(o, i);
    largest = std::max(largest, static_cast<double>(max_component(expected)));
    worst = std::max(worst, static_cast<double>(max_component(glm::abs(table.evaluate(o, i) - expected))));
  }
  return worst / largest;
}

Json merl_material(const std::string& file) {
  Json m;
  m["name"] = "sample";
  m["extras"]["phos"]["brdf"] = "merl";
  m["extras"]["phos"]["file"] = file;
  return m;
}

const std::string& folder() {
  static const std::string path = scratch("scene_merl");
  return path;
}

Scene load(const Gltf& gltf) {
  spill(folder() + "/scene.glb", gltf.bytes());
  return load_scene(folder() + "/scene.glb");
}

}  // namespace

TEST(Merl, LambertComesBackAndNothingIsGlossy) {
  const MerlBrdf& table = *measured_tables()[kMeasuredLambert];
  const Rgb kd(0.8f, 0.5f, 0.2f);
  EXPECT_LT(largest_error(table, HalfLobe{kd}, 0), 1e-6);
  EXPECT_LT(max_component(glm::abs(table.lambert() - kd)), 1e-6f);
  EXPECT_FALSE(table.glossy());
  EXPECT_LT(max_component(glm::abs(table.mean_albedo() - kd)), 1e-5f);
  EXPECT_GT(table.empty_cells(), 100000u);  // the half of the table that no light reaches
  EXPECT_EQ(table.empty_reachable_cells(), 0u);
  EXPECT_EQ(table.energy_gain(), "");
}

TEST(Merl, LobesComeBack) {
  const HalfLobe half{Rgb(0.5f, 0.3f, 0.1f), Rgb(0.2f, 0.25f, 0.3f), 60};
  const MerlBrdf& of_half = *measured_tables()[kMeasuredHalfLobe];
  EXPECT_LT(largest_error(of_half, half, 0), 2e-3);
  EXPECT_LT(max_component(glm::abs(of_half.lambert() - half.kd)), 1e-3f);
  EXPECT_TRUE(of_half.glossy());
  // Blinn's cos^n is about GGX of alpha = sqrt(2 / (n + 2)).
  EXPECT_NEAR(of_half.alpha(), std::sqrt(2.f / 62), 0.06f);

  const MirrorLobe mirror{Rgb(0.4f), Rgb(0.5f, 0.4f, 0.3f), 15};
  const MerlBrdf& of_mirror = *measured_tables()[kMeasuredMirrorLobe];
  // The neighbours of a cell at the edge of what light reaches stand in for it.
  EXPECT_LT(largest_error(of_mirror, mirror, 0.1f), 5e-3);
  EXPECT_LT(largest_error(of_mirror, mirror, 0), 0.15);
  EXPECT_LT(max_component(glm::abs(of_mirror.lambert() - mirror.kd)), 5e-3f);
}

TEST(Merl, AlbedosAreTheIntegrals) {
  const MirrorLobe model{Rgb(0.4f), Rgb(0.5f, 0.4f, 0.3f), 15};
  const MerlBrdf& table = *measured_tables()[kMeasuredMirrorLobe];
  // Along the normal the lobe's albedo is ks (n + 2) / (2 pi) 2 pi / (n + 2) = ks.
  EXPECT_NEAR(table.albedo(1).x, 0.9f, 0.01f);
  for (const float cosine : {0.2f, 0.5f, 0.8f}) {
    const Vec3 o = direction(cosine, 0);
    constexpr int kRows = 300, kColumns = 600;
    glm::dvec3 sum(0);
    for (int r = 0; r < kRows; ++r) {
      const double z = (r + 0.5) / kRows;
      for (int c = 0; c < kColumns; ++c) {
        const auto phi = static_cast<float>(2 * M_PI * (c + 0.5) / kColumns);
        sum +=
            glm::dvec3(model(o, direction(static_cast<float>(z), phi))) * (z * 2 * M_PI / kRows / kColumns);
      }
    }
    EXPECT_NEAR(table.albedo(cosine).x, sum.x, 0.01) << cosine;
    EXPECT_NEAR(table.albedo(cosine).z, sum.z, 0.01) << cosine;
  }
}

TEST(Merl, IsContinuousAndReciprocalEverywhere) {
  const MerlBrdf& table = *measured_tables()[kMeasuredMirrorLobe];
  const Vec3 up(0, 0, 1);
  std::vector<std::pair<Vec3, Vec3>> pairs = {{up, up},
                                              {direction(0.5f, 1), direction(0.5f, 1)},
                                              {direction(0.5f, 1), direction(0.5f, 1 + kPi)},
                                              {direction(1e-6f, 0), direction(1e-6f, kPi)},
                                              {direction(1e-6f, 0), up}};
  for (int k = 0; k < 2000; ++k) {
    RandomStream random(2, Stage::test, static_cast<std::uint64_t>(k));
    const Vec3 o = random_direction(random, 0), i = random_direction(random, 0);
    pairs.emplace_back(o, i);
  }
  for (const auto& [o, i] : pairs) {
    const Rgb f = table.evaluate(o, i);
    EXPECT_TRUE(is_finite(f));
    EXPECT_GE(std::min({f.x, f.y, f.z}), 0);
    EXPECT_LE(max_component(glm::abs(f - table.evaluate(i, o))), 1e-3f * max_component(f));
    const Vec3 near = glm::normalize(i + Vec3(1e-4f, -1e-4f, 1e-4f));
    EXPECT_LE(max_component(glm::abs(f - table.evaluate(o, near))), 0.02f);
  }
}

TEST(Merl, HolesTakeTheNearestValue) {
  // No data beyond 60 degrees of the half vector's angle, nor in one stray cell; the rest grows with theta_d.
  const auto model = [](const Vec3& o, const Vec3& i) {
    const Vec3 h = glm::normalize(o + i);
    return h.z < 0.5f ? Rgb(-1) : Rgb(1 - glm::dot(h, i));
  };
  const MerlBrdf table(merl_bytes(model), "holes");
  EXPECT_GT(table.empty_reachable_cells(), 0u);
  EXPECT_LT(table.empty_reachable_cells(), table.empty_cells());
  // The half vector leans by 70 degrees: as at 60, for the same angle from it.
  const Vec3 h = direction(std::cos(1.2217305f), 0);
  const Vec3 across(0, 1, 0);
  const Vec3 o = glm::normalize(h + 0.3f * across), i = glm::normalize(h - 0.3f * across);
  EXPECT_NEAR(table.evaluate(o, i).x, 1 - glm::dot(h, i), 2e-3f);
}

TEST(Merl, ScenesNameAndHashTheirTables) {
  spill(folder() + "/paint.binary", merl_bytes(HalfLobe{Rgb(0.5f, 0.3f, 0.1f), Rgb(0.2f), 60}));
  Gltf g;
  g.square_node(merl_material("paint.binary"));
  g.square_node(merl_material("./paint.binary"));
  g.square_node(merl_material("paint.binary"));
  const Scene scene = load(g);
  EXPECT_LE(scene.measured.size(), 2u);
  EXPECT_EQ(scene.material[0].measured, scene.material[2].measured);
  EXPECT_EQ(scene.material[0].model, Model::measured);
  EXPECT_NEAR(scene.material[0].kd.y, 0.3f, 1e-3f);
  const std::vector<std::string> files = scene_files(folder() + "/scene.glb");
  EXPECT_EQ(std::count(files.begin(), files.end(), folder() + "/paint.binary"), 1);
  const std::vector<MaterialSummary> materials = summarize_materials(scene);
  EXPECT_TRUE(materials[0].diffuse && materials[0].glossy && !materials[0].specular);
  EXPECT_NEAR(materials[0].reflectance, luminance(scene.measured[0]->mean_albedo()), 1e-6);

  spill(folder() + "/paint.binary", merl_bytes(HalfLobe{Rgb(0.5f, 0.3f, 0.1f), Rgb(0.21f), 60}));
  const Scene other = load(g);
  EXPECT_NE(other.hash, scene.hash);
  EXPECT_NE(other.parts.find("materials")->as_string(), scene.parts.find("materials")->as_string());
  EXPECT_EQ(other.parts.find("geometry")->as_string(), scene.parts.find("geometry")->as_string());
}

TEST(Merl, DataThatGainEnergyAreCountedAndSaid) {
  spill(folder() + "/bright.binary", merl_bytes(HalfLobe{Rgb(1.3f, 0.5f, 0.2f)}));
  Gltf g;
  g.square_node(merl_material("bright.binary"));
  const Scene scene = load(g);
  EXPECT_NEAR(scene.measured[0]->largest_albedo(), 1.3f, 1e-4f);
  EXPECT_EQ(scene.events.at("measured angles that reflect more than they get"),
            scene.measured[0]->gaining_angles());
  EXPECT_GT(scene.measured[0]->gaining_angles(), 0u);
  int said = 0;
  for (const Finding& f : lint_scene(scene)) {
    if (f.message.find("gains energy") == std::string::npos) continue;
    ++said;
    EXPECT_EQ(f.code, "gains-energy");
    EXPECT_EQ(f.level, Finding::Level::warning);
    EXPECT_NE(f.message.find("\"sample\""), std::string::npos);
    EXPECT_NE(f.message.find("1.3"), std::string::npos);
  }
  EXPECT_EQ(said, 1);
  // Not scaled.
  EXPECT_NEAR(Bsdf(scene, 0).evaluate(direction(0.6f, 0), direction(0.5f, 1)).x, 1.3f / kPi, 1e-5f);
}
