// The diffuse transmission of a material: value, density and samples say the same, whatever it is mixed with.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/material/bsdf.h"
#include "support/opal.h"

namespace phos::test {
namespace {

Scene sheet_of(Material material) {
  Scene scene;
  scene.material.push_back(std::move(material));
  begin_instance(scene, "sheet", 0);
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  finalize(scene);
  return scene;
}

Material shade(float share, float colour) {
  Material m;
  m.model = Model::metallic_roughness;
  m.kd = Rgb(0.8f), m.roughness = 0.5f, m.alpha_x = m.alpha_y = 0.25f;
  m.diffuse_transmission = share, m.diffuse_transmission_colour = Rgb(colour);
  return m;
}

std::vector<Material> sheets() {
  Scene opal;
  add_opal(opal, 0.3f, 0.5f);
  Material film = shade(0.5f, 1);
  film.alpha_mode = Material::Alpha::blend, film.alpha = 0.6f;
  Material glass = shade(0.5f, 1);
  glass.transmission = 0.4f;
  return {opal.material[0], shade(0.25f, 0.9f), shade(1, 1), film, glass};
}

TEST(DiffuseTransmission, SamplesHaveTheValuesAndDensities) {
  for (const Material& m : sheets()) {
    const Scene scene = sheet_of(m);
    const Bsdf bsdf(scene, 0u);
    const Vec3 wo = glm::normalize(Vec3(0.5f, 0.2f, 0.9f));
    constexpr int kSamples = 100'000;
    double passed = 0, scattered = 0, certain = 0;
    for (int i = 0; i < kSamples; ++i) {
      RandomStream random(1, Stage::test, static_cast<std::uint64_t>(i));
      BsdfSample s;
      const float u = random.uniform();
      if (!bsdf.sample(wo, u, random.uniform2(), s)) continue;
      certain += s.specular;
      if (s.specular) continue;
      EXPECT_NEAR(bsdf.density(wo, s.direction) / s.density, 1, 1e-4f);
      EXPECT_EQ(s.transmitted, s.direction.z < 0);
      const Rgb value = bsdf.evaluate(wo, s.direction) * std::fabs(s.direction.z) / s.density;
      EXPECT_NEAR(value.y, s.weight.y, 1e-4f * s.weight.y);
      (s.transmitted ? passed : scattered) += static_cast<double>(s.weight.y) / kSamples;
    }
    EXPECT_NEAR(passed, static_cast<double>(bsdf.diffuse_transmittance().y), 0.01);
    EXPECT_GT(bsdf.diffuse_transmittance().y, 0);
    EXPECT_LE(passed + scattered + certain / kSamples, 1.1);
    // From the other side the same.
    Frame other;
    other.y = -other.y, other.z = -other.z;
    const Bsdf back(scene, 0u, other);
    const Vec3 through(0.1f, 0.3f, -0.9f);
    EXPECT_EQ(bsdf.evaluate(wo, through), back.evaluate(through, wo));
    EXPECT_EQ(bsdf.evaluate(wo, through), bsdf.evaluate(through, wo));
    EXPECT_EQ(bsdf.density(through, wo), back.density(through, wo));
    EXPECT_GT(bsdf.density(through, wo), 0);
    EXPECT_EQ(bsdf.other_side().diffuse_reflectance(), bsdf.diffuse_transmittance());
  }
}

/// Reflected and passed, over all directions together: at most what came.
TEST(DiffuseTransmission, ConservesEnergyInTheMean) {
  for (const Material& m : {shade(1, 1), shade(0.5f, 1)}) {
    const Scene scene = sheet_of(m);
    const Bsdf bsdf(scene, 0u);
    double sum = 0;
    constexpr int kSamples = 100'000;
    for (int i = 0; i < kSamples; ++i) {
      RandomStream random(1, Stage::test, static_cast<std::uint64_t>(i));
      const Vec3 wo = sample_cosine_hemisphere(random.uniform2());
      BsdfSample s;
      const float u = random.uniform();
      if (bsdf.sample(wo, u, random.uniform2(), s)) sum += static_cast<double>(s.weight.y) / kSamples;
    }
    EXPECT_LE(sum, 1.003);
    EXPECT_GT(sum, m.diffuse_transmission == 1 ? 0.97 : 0.85);
  }
}

}  // namespace
}  // namespace phos::test
