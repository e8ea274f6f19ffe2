// The energy-preserving Oren-Nayar model: its limits, its energy, its parts.
#include "scene/material/oren_nayar.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "scene/material/models.h"
#include "scene/report/describe.h"
#include "support/one_material.h"

using namespace phos;
using namespace phos::test;

namespace {

constexpr float kSigmas[] = {0.01f, 0.1f, 0.3f, 0.7f, 1.5f, 10.f};

/// Integral of value(o, i) cos over the hemisphere, by midpoints in the cosine and the azimuth from o.
double integrated(const OrenNayar& surface, float cosine) {
  constexpr int kRows = 2000, kColumns = 400;
  const Vec3 o = direction(cosine, 0);
  double sum = 0;
  for (int r = 0; r < kRows; ++r) {
    const double t = (r + 0.5) / kRows, z = t * t, dz = 2 * t / kRows;
    for (int c = 0; c < kColumns; ++c) {
      const Vec3 i = direction(static_cast<float>(z), static_cast<float>(M_PI * (c + 0.5) / kColumns));
      sum += static_cast<double>(surface.value(o, i).y) * z * dz * 2 * M_PI / kColumns;
    }
  }
  return sum;
}

Vec3 any_direction(RandomStream& random) {
  return direction(0.001f + 0.998f * random.uniform(), 6.2f * random.uniform());
}

}  // namespace

TEST(OrenNayar, WithoutRoughnessIsLambertToTheBit) {
  const Rgb kd(0.7f, 0.4f, 0.1f);
  const Scene matt = scene_of(oren_nayar(kd, 0)), flat = scene_of(make_material(Model::lambert, kd, Rgb(0)));
  const Bsdf a(matt, flat_point()), b(flat, flat_point());
  EXPECT_TRUE(matt.material[0].diffuse_alone());
  EXPECT_FALSE(a.has_gloss());
  EXPECT_EQ(a.diffuse_reflectance(), b.diffuse_reflectance());
  for (int k = 0; k < 100; ++k) {
    RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
    const Vec3 wo = any_direction(random), wi = any_direction(random);
    EXPECT_EQ(a.evaluate(wo, wi), b.evaluate(wo, wi));
    EXPECT_EQ(a.density(wo, wi), b.density(wo, wi));
    const Vec2 u = random.uniform2();
    BsdfSample one, other;
    ASSERT_TRUE(a.sample(wo, 0.5f, u, one));
    ASSERT_TRUE(b.sample(wo, 0.5f, u, other));
    EXPECT_EQ(one.direction, other.direction);
    EXPECT_EQ(one.weight, other.weight);
  }
}

TEST(OrenNayar, TendsToLambertAsRoughnessFalls) {
  const OrenNayar surface(Rgb(0.6f), 1e-4f);
  for (float z = 0.05f; z < 1; z += 0.1f)
    EXPECT_NEAR(surface.value(direction(z, 0), direction(1 - z, 2)).x, 0.6f / kPi, 1e-6f);
}

TEST(OrenNayar, AWhiteSurfaceReturnsAllLight) {
  for (const float sigma : kSigmas) {
    const OrenNayar surface(Rgb(1), sigma);
    EXPECT_NEAR(surface.mean_albedo().x, 1, 2e-6f);
    for (float z = 0; z <= 1; z += 0.05f) EXPECT_NEAR(surface.albedo(z).x, 1, 3e-6f) << sigma << " " << z;
    for (const float z : {1.f, 0.7f, 0.3f, 0.05f})
      EXPECT_NEAR(integrated(surface, z), 1, 2e-4) << sigma << " " << z;
  }
}

TEST(OrenNayar, AlbedoIsTheIntegralAndNeverAboveKd) {
  for (const float sigma : kSigmas)
    for (const float kd : {0.2f, 0.5f, 0.9f}) {
      const OrenNayar surface(Rgb(kd), sigma);
      double mean = 0;
      constexpr int kSteps = 2000;
      for (int k = 0; k < kSteps; ++k) {
        const auto cosine = static_cast<float>(std::sqrt((k + 0.5) / kSteps));
        const float albedo = surface.albedo(cosine).y;
        EXPECT_LE(albedo, kd * (1 + 1e-6f));
        EXPECT_GT(albedo, 0.3f * kd);
        mean += static_cast<double>(albedo) / kSteps;
      }
      EXPECT_NEAR(surface.mean_albedo().y, mean, 1e-5);
      for (const float z : {1.f, 0.6f, 0.1f}) EXPECT_NEAR(integrated(surface, z), surface.albedo(z).y, 2e-4);
    }
}

TEST(OrenNayar, IsReciprocalAndNeverNegative) {
  for (const float sigma : kSigmas) {
    const OrenNayar surface(Rgb(0.9f, 0.5f, 0.1f), sigma);
    for (int k = 0; k < 2000; ++k) {
      RandomStream random(2, Stage::test, static_cast<std::uint64_t>(k));
      const Vec3 a = any_direction(random), b = any_direction(random);
      EXPECT_EQ(surface.value(a, b), surface.value(b, a));
      EXPECT_GE(surface.value(a, b).z, 0);
    }
    const Vec3 grazing(std::sqrt(1 - 1e-12f), 0, 1e-20f);
    EXPECT_TRUE(is_finite(surface.value(grazing, grazing)));
    EXPECT_GE(surface.value(grazing, Vec3(-1, 0, 1e-20f)).x, 0);
  }
}

TEST(OrenNayar, HasTheContrastOfTheQualitativeModel) {
  // Oren and Nayar 1994, eq. 30, at sigma 0.5, without interreflection: A + B cos(phi) sin(alpha) tan(beta).
  const double s2 = 0.25, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  const OrenNayar dark(Rgb(1e-6f), 0.5f);  // multiple reflection is of the second order in kd
  const double sine = std::sqrt(0.75), cosine = 0.5;
  const Vec3 o = direction(0.5f, 0);
  const double back = static_cast<double>(dark.value(o, o).x),
               up = static_cast<double>(dark.value(o, {0, 0, 1}).x);
  EXPECT_NEAR(back / up, (a + b * sine * sine / cosine) / a, 1e-4);
}

TEST(OrenNayar, SeenFromOneSideTheLambertPartIsTheAlbedoThere) {
  const Scene scene = scene_of(oren_nayar(Rgb(0.8f, 0.5f, 0.2f), 0.6f));
  const OrenNayar surface(Rgb(0.8f, 0.5f, 0.2f), 0.6f);
  for (const float z : {0.9f, 0.4f, 0.1f}) {
    Bsdf bsdf(scene, flat_point());
    EXPECT_EQ(bsdf.diffuse_reflectance(), surface.mean_albedo());
    const Vec3 wo = direction(z, 0.3f);
    bsdf.look_from(wo);
    EXPECT_LT(max_component(glm::abs(bsdf.diffuse_reflectance() - surface.albedo(z))), 1e-6f);
    for (const float i : {0.9f, 0.3f}) {
      const Vec3 wi = direction(i, 2);
      const Rgb sum = bsdf.evaluate_gloss(wo, wi) + bsdf.diffuse_reflectance() / kPi;
      EXPECT_LT(max_component(glm::abs(sum - bsdf.evaluate(wo, wi))), 1e-6f);
    }
  }
}

TEST(OrenNayar, BlendedIsAsStrongAsItsShare) {
  Material m = oren_nayar(Rgb(0.8f), 0.6f);
  const Scene whole = scene_of(m);
  m.alpha_mode = Material::Alpha::blend, m.alpha = 0.25f;
  const Scene part = scene_of(m);
  const Vec3 wo = direction(0.4f, 0), wi = direction(0.6f, 1);
  EXPECT_NEAR(Bsdf(part, flat_point()).evaluate(wo, wi).x,
              0.25f * Bsdf(whole, flat_point()).evaluate(wo, wi).x, 1e-7f);
}

TEST(OrenNayar, IsDescribedByItsAlbedoAndItsSigma) {
  Scene scene = scene_of(oren_nayar(Rgb(0.8f, 0.5f, 0.2f), 0.6f));
  const std::vector<MaterialSummary> all = summarize_materials(scene);
  EXPECT_NEAR(all[0].reflectance, luminance(OrenNayar(Rgb(0.8f, 0.5f, 0.2f), 0.6f).mean_albedo()), 1e-6);
  EXPECT_TRUE(all[0].diffuse && all[0].glossy && !all[0].specular);
  scene.material[0].sigma_rad = 0;
  EXPECT_FALSE(summarize_materials(scene)[0].glossy);
}
