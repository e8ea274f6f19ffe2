// Identities of the reflection models: energy, reciprocity, unbiased samples, Fresnel, and no light through
// bumps.
#include <gtest/gtest.h>

#include "core/random.h"
#include "scene/material/bsdf.h"
#include "scene/material/microfacet.h"
#include "support/one_material.h"

using namespace phos;
using namespace phos::test;

namespace {

constexpr float kCosines[] = {1.f, 0.9f, 0.6f, 0.3f, 0.1f, 0.02f};

/// Integral of f(wi) cos over the upper hemisphere: midpoint rule in the 2/3 power of the cosine and the cube
/// root of the azimuth away from the mirror direction of wo, which resolves grazing lobes.
template <class F>
Rgb integrate(const Vec3& wo, const F& f, int rows = 500, int columns = 200) {
  glm::dvec3 sum(0);
  const double mirror = std::atan2(-static_cast<double>(wo.y), -static_cast<double>(wo.x));
  for (int r = 0; r < rows; ++r) {
    const double t = (r + 0.5) / rows, z = t * std::sqrt(t), dz = 1.5 * std::sqrt(t) / rows;
    for (int c = 0; c < columns; ++c) {
      const double s = -1 + 2 * (c + 0.5) / columns, phi = mirror + M_PI * s * s * s;
      const Vec3 wi = direction(static_cast<float>(z), static_cast<float>(phi));
      sum += glm::dvec3(f(wi)) * (z * dz * 3 * M_PI * s * s * 2 / columns);
    }
  }
  return Rgb(sum);
}

struct Mean {
  double value = 0, error = 0;
};

/// Mean of the red, green and blue weights' average over samples drawn with draw(random, sample).
template <class F>
Mean mean_weight(int count, const F& draw) {
  double sum = 0, squares = 0;
  for (int k = 0; k < count; ++k) {
    RandomStream random(5, Stage::test, static_cast<std::uint64_t>(k));
    BsdfSample s;
    if (!draw(random, s)) continue;
    EXPECT_TRUE(is_finite(s.weight) && is_finite(s.direction));
    const double w = static_cast<double>(s.weight.x + s.weight.y + s.weight.z) / 3;
    sum += w, squares += w * w;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

double grey(const Rgb& c) { return static_cast<double>(c.x + c.y + c.z) / 3; }

Rgb delta_weight(const Bsdf& bsdf, const Vec3& wo, TransportMode mode = TransportMode::radiance) {
  BsdfSample branches[2];
  Rgb sum(0);
  const int n = bsdf.specular_branches(wo, branches, mode);
  for (int b = 0; b < n; ++b) sum += branches[b].weight;
  return sum;
}

}  // namespace

TEST(Bsdf, WhiteFurnaceReturnsNoMoreThanItGets) {
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (const float cosine : kCosines) {
      const Vec3 wo = direction(cosine, 0.3f);
      const Rgb albedo =
          integrate(wo, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi); }) + delta_weight(bsdf, wo);
      // An anisotropic coat's transmittance is an approximation (see Bsdf).
      const float most = named.material.anisotropic() && bsdf.has_diffuse() ? 1.03f : 1.003f;
      EXPECT_LE(max_component(albedo), most) << named.name << " cosine " << cosine;
      EXPECT_GT(max_component(albedo), 0.1f) << named.name << " cosine " << cosine;
    }
  }
}

TEST(Bsdf, WhitePigmentUnderACoatLosesOnlyWhatRoughnessLoses) {
  // Smooth coat, white beneath: everything comes back, whatever the angle (the table's interpolation costs 1
  // %).
  for (const Model model : {Model::plastic, Model::metallic_roughness}) {
    Material material = make_material(model, Rgb(1), Rgb(0));
    material.roughness = 0;
    const Scene scene = scene_of(material);
    const Bsdf bsdf(scene, flat_point());
    EXPECT_TRUE(bsdf.has_specular());
    for (const float cosine : kCosines) {
      const Vec3 wo = direction(cosine, 0.3f);
      const Rgb albedo =
          integrate(wo, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi); }) + delta_weight(bsdf, wo);
      EXPECT_NEAR(albedo.x, 1.f, 0.01f) << "cosine " << cosine;
      EXPECT_LE(albedo.x, 1.002f) << "cosine " << cosine;
    }
  }
}

TEST(Bsdf, IsReciprocal) {
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (int k = 0; k < 200; ++k) {
      RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
      const Vec3 a = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const Vec3 b = direction(0.02f + 0.97f * random.uniform(), 6 * random.uniform());
      const Rgb ab = bsdf.evaluate(a, b), ba = bsdf.evaluate(b, a);
      EXPECT_LE(max_component(glm::abs(ab - ba)), 2e-4f * max_component(ab) + 1e-7f) << named.name;
    }
  }
}

TEST(Bsdf, SamplesAddUpToTheIntegral) {
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (const float cosine : {0.9f, 0.4f, 0.1f}) {
      const Vec3 wo = direction(cosine, 1.f);
      const double expected =
          grey(integrate(wo, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi); }) + delta_weight(bsdf, wo));
      const Mean mean = mean_weight(20000, [&](RandomStream& random, BsdfSample& s) {
        const float u_lobe = random.uniform();
        return bsdf.sample(wo, u_lobe, random.uniform2(), s);
      });
      EXPECT_NEAR(mean.value, expected, 4.5 * mean.error + 2e-3 * expected)
          << named.name << " cosine " << cosine;
    }
  }
}

TEST(Bsdf, LambertAndGlossAddUp) {
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    const Vec3 wo = direction(0.5f, 0.3f);
    for (float z = 0.05f; z < 1; z += 0.1f) {
      const Vec3 wi = direction(z, 3.f);
      const Rgb sum = bsdf.evaluate_gloss(wo, wi) + bsdf.diffuse_reflectance() / kPi;
      EXPECT_LT(max_component(glm::abs(sum - bsdf.evaluate(wo, wi))), 1e-5f) << named.name;
    }
    if (!bsdf.has_gloss()) {
      EXPECT_EQ(bsdf.evaluate_gloss(wo, wo), Rgb(0));
      continue;
    }
    const double expected = grey(integrate(wo, [&](const Vec3& wi) { return bsdf.evaluate_gloss(wo, wi); }));
    const Mean mean = mean_weight(20000, [&](RandomStream& random, BsdfSample& s) {
      return bsdf.sample_gloss(wo, random.uniform2(), s);
    });
    EXPECT_NEAR(mean.value, expected, 4.5 * mean.error + 2e-3) << named.name;
  }
}

TEST(Bsdf, GlossUnderACoatAddsNothingToTheMeanOfTheBase) {
  // The mean over wo (cosine-weighted) of all that leaves, less the coat's own, is the Lambert part.
  Material material = make_material(Model::plastic, Rgb(0.7f), Rgb(0), 0.0f, 0.0f);
  const Scene scene = scene_of(material);
  const Bsdf bsdf(scene, flat_point());
  double mean = 0;
  constexpr int kSteps = 40;
  for (int k = 0; k < kSteps; ++k) {
    const Vec3 wo = direction(static_cast<float>(std::sqrt((k + 0.5) / kSteps)), 0);
    mean += grey(integrate(
                wo, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi); }, 60, 40)) /
            kSteps;
  }
  EXPECT_NEAR(mean, grey(bsdf.diffuse_reflectance()), 2e-3);
}

TEST(Bsdf, PhongLobeIsNormalisedAsStated) {
  Material material = make_material(Model::phong, Rgb(0), Rgb(0.5f));
  material.exponent = 22;
  const Scene scene = scene_of(material);
  const Bsdf bsdf(scene, flat_point());
  const Vec3 up(0, 0, 1);
  EXPECT_NEAR(bsdf.evaluate(up, up).x, 0.5f * 24 / (2 * kPi), 1e-5f);
  EXPECT_NEAR(integrate(up, [&](const Vec3& wi) { return bsdf.evaluate(up, wi); }).x, 0.5f, 1e-3f);
  EXPECT_NEAR(bsdf.density(up, up), 23 / (2 * kPi), 1e-4f);
}

TEST(Bsdf, MetalAndDielectricOfGltfAtNormalIncidence) {
  Material material = make_material(Model::metallic_roughness, Rgb(0.8f, 0.4f, 0.2f), Rgb(0));
  material.roughness = 0;
  material.metallic = 1;
  const Vec3 up(0, 0, 1);
  Scene scene = scene_of(material);
  EXPECT_NEAR(delta_weight(Bsdf(scene, flat_point()), up).y, 0.4f, 1e-6f);
  EXPECT_FALSE(Bsdf(scene, flat_point()).has_diffuse());
  scene.material[0].metallic = 0;
  EXPECT_NEAR(delta_weight(Bsdf(scene, flat_point()), up).y, 0.04f, 1e-6f);
  scene.material[0].specular = 0;
  EXPECT_NEAR(delta_weight(Bsdf(scene, flat_point()), up).y, 0.f, 1e-6f);
  EXPECT_NEAR(Bsdf(scene, flat_point()).diffuse_reflectance().x, 0.8f, 1e-5f);
}

TEST(Bsdf, TexturesAndVertexColoursMultiplyTheBase) {
  Material material = make_material(Model::lambert, Rgb(0.8f), Rgb(0));
  material.base_colour.texture = 0;
  Scene scene = scene_of(material);
  Texture half;
  half.width = half.height = 1;
  half.texels = {Vec4(0.5f, 0.25f, 1, 1)};
  scene.texture = {half};
  SurfacePoint point = flat_point();
  point.colour = Vec4(1, 1, 0.5f, 1);
  EXPECT_EQ(Bsdf(scene, point).diffuse_reflectance(), Rgb(0.4f, 0.2f, 0.4f));

  scene.material[0].model = Model::metallic_roughness;
  scene.material[0].metallic_roughness.texture = 0;  // roughness from green, metallic from blue
  scene.material[0].metallic = 1, scene.material[0].roughness = 1;
  EXPECT_FALSE(Bsdf(scene, point).has_diffuse());
}

TEST(Bsdf, AwayFromASurfaceTexturesAreAtTheirMean) {
  Material material = make_material(Model::metallic_roughness, Rgb(0.8f), Rgb(0));
  material.base_colour.texture = 0, material.metallic_roughness.texture = 1;
  material.metallic = 0.5f, material.roughness = 1;
  Scene scene = scene_of(material);
  Texture colour, rough;
  colour.width = rough.width = 2, colour.height = rough.height = 1;
  colour.texels = {Vec4(1, 0.5f, 0, 1), Vec4(0, 0.5f, 1, 1)};
  rough.texels = {Vec4(1, 0.4f, 1, 1), Vec4(1, 0.8f, 1, 1)};
  scene.texture = {colour, rough};
  Material mean = material;
  mean.base_colour.texture = mean.metallic_roughness.texture = -1;
  mean.kd = Rgb(0.4f), mean.roughness = 0.6f;
  const Scene plain = scene_of(mean);
  const Bsdf a(scene, 0), b(plain, flat_point());
  for (float z = 0.1f; z < 1; z += 0.2f) {
    const Vec3 wo = direction(0.6f, 0.4f), wi = direction(z, 2);
    EXPECT_LT(max_component(glm::abs(a.evaluate_gloss(wo, wi) - b.evaluate_gloss(wo, wi))), 1e-6f);
    EXPECT_GT(max_component(a.evaluate_gloss(wo, wi)), 0);
  }
  // In a frame of its own, the same.
  const Frame frame = make_frame(direction(0.3f, 1));
  const Bsdf turned(scene, 0, frame);
  const Vec3 wo = direction(0.6f, 0.4f), wi = direction(0.5f, 2);
  EXPECT_NEAR(turned.evaluate(frame.to_world(wo), frame.to_world(wi)).x, a.evaluate(wo, wi).x, 1e-5f);
}

TEST(Dielectric, FollowsFresnelAndSnell) {
  Material material;
  material.model = Model::dielectric;
  const Scene scene = scene_of(material);
  SurfacePoint point = flat_point();
  const Bsdf outside(scene, point);
  point.front = false;
  const Bsdf inside(scene, point);
  BsdfSample b[2];
  ASSERT_EQ(outside.specular_branches(Vec3(0, 0, 1), b), 2);
  EXPECT_NEAR(b[0].weight.x, 0.04f, 1e-6f);
  EXPECT_NEAR(b[1].weight.x, 0.96f / 2.25f, 1e-6f);

  const Vec3 wo = direction(0.5f, 0.4f);
  ASSERT_EQ(outside.specular_branches(wo, b, TransportMode::flux), 2);
  EXPECT_NEAR(b[0].weight.x + b[1].weight.x, 1.f, 1e-6f);
  EXPECT_TRUE(b[1].transmitted && !b[0].transmitted);
  const float sin_t = std::sqrt(1 - b[1].direction.z * b[1].direction.z);
  EXPECT_NEAR(1.5f * sin_t, std::sqrt(0.75f), 1e-6f);
  // Back along the refracted way: the same transmittance, and the scales of luminance cancel.
  const Vec3 back(b[1].direction.x, b[1].direction.y, -b[1].direction.z);
  BsdfSample in[2], out[2];
  ASSERT_EQ(outside.specular_branches(wo, out), 2);
  ASSERT_EQ(inside.specular_branches(back, in), 2);
  EXPECT_NEAR(out[1].weight.x * 2.25f, in[1].weight.x / 2.25f, 1e-5f);
  EXPECT_NEAR(std::fabs(in[1].direction.z), wo.z, 1e-5f);
  // Beyond the critical angle, all is reflected.
  ASSERT_EQ(inside.specular_branches(direction(0.5f, 0), in), 1);
  EXPECT_EQ(in[0].weight.x, 1.f);
  EXPECT_FALSE(in[0].transmitted);
}

TEST(Dielectric, SamplesMatchBranches) {
  for (const Model model : {Model::dielectric, Model::thin_dielectric, Model::mirror}) {
    Material material = make_material(model, Rgb(0), Rgb(0.9f));
    const Scene scene = scene_of(material);
    const Bsdf bsdf(scene, flat_point());
    EXPECT_TRUE(bsdf.has_specular() && !bsdf.has_diffuse() && !bsdf.has_gloss());
    EXPECT_EQ(bsdf.evaluate(Vec3(0, 0, 1), Vec3(0, 0, 1)), Rgb(0));
    EXPECT_EQ(bsdf.density(Vec3(0, 0, 1), Vec3(0, 0, 1)), 0.f);
    for (const TransportMode mode : {TransportMode::radiance, TransportMode::flux}) {
      const Vec3 wo = direction(0.3f, 0.4f);
      const Mean mean = mean_weight(20000, [&](RandomStream& random, BsdfSample& s) {
        const bool ok = bsdf.sample(wo, random.uniform(), Vec2(0.5f), s, mode);
        return ok && s.specular && s.density == 0;
      });
      EXPECT_NEAR(mean.value, grey(delta_weight(bsdf, wo, mode)), 4.5 * mean.error + 1e-6);
    }
  }
}

TEST(Dielectric, ThinPaneReflectsTwiceAndLosesNothing) {
  Material material;
  material.model = Model::thin_dielectric;
  const Scene scene = scene_of(material);
  const Bsdf bsdf(scene, flat_point());
  BsdfSample b[2];
  ASSERT_EQ(bsdf.specular_branches(Vec3(0, 0, 1), b), 2);
  EXPECT_NEAR(b[0].weight.x, 2 * 0.04f / 1.04f, 1e-6f);
  EXPECT_NEAR(b[0].weight.x + b[1].weight.x, 1.f, 1e-6f);
  EXPECT_EQ(b[1].direction, Vec3(0, 0, -1));
}

TEST(Bsdf, NothingPassesBetweenTheHorizons) {
  // Shading normal 60 degrees off: directions between the two horizons carry no light, either way.
  SurfacePoint point = flat_point();
  point.normal = direction(0.5f, 0);
  point.tangent = make_frame(point.normal).x;
  const Scene scene = scene_of(make_material(Model::lambert, Rgb(1), Rgb(0)));
  const Bsdf bsdf(scene, point);
  const Vec3 wo = direction(0.8f, 0);
  EXPECT_EQ(bsdf.evaluate(wo, direction(0.2f, kPi)), Rgb(0));        // below the shading horizon
  EXPECT_EQ(bsdf.evaluate(wo, Vec3(0.9950f, 0, -0.0998f)), Rgb(0));  // below the surface
  EXPECT_EQ(bsdf.evaluate(Vec3(0.9950f, 0, -0.0998f), wo), Rgb(0));
  for (int k = 0; k < 2000; ++k) {
    RandomStream random(3, Stage::test, static_cast<std::uint64_t>(k));
    BsdfSample s;
    if (bsdf.sample(wo, 0, random.uniform2(), s)) {
      EXPECT_GT(s.direction.z, 0);
    }
  }
}

TEST(Bsdf, PhotonsSeeTheShadingNormalsLight) {
  // Veach 1997, section 5.3: f* |wi.Ng| = f |wi.Ns| |wo.Ns| / |wo.Ng| ... integrated over the open
  // directions.
  SurfacePoint point = flat_point();
  point.normal = direction(0.8f, 0);
  point.tangent = make_frame(point.normal).x;
  const Scene scene = scene_of(make_material(Model::lambert, Rgb(1), Rgb(0)));
  const Bsdf bsdf(scene, point);
  const Vec3 wo = direction(0.6f, 2);
  const double ratio = static_cast<double>(glm::dot(wo, point.normal) / wo.z);
  const double expected = ratio * grey(integrate(wo, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi); }));
  const Mean mean = mean_weight(100000, [&](RandomStream& random, BsdfSample& s) {
    return bsdf.sample(wo, 0, random.uniform2(), s, TransportMode::flux);
  });
  EXPECT_NEAR(mean.value, expected, 4.5 * mean.error + 1e-3);
}

TEST(Bsdf, StaysFiniteAtItsLimits) {
  std::vector<Named> all = models();
  for (const float alpha : {0.f, 1e-5f, 1e-3f, 0.01f, 5.f}) {
    for (const Model model : {Model::ward, Model::conductor, Model::plastic}) {
      all.push_back({"rough", make_material(model, Rgb(0.5f), Rgb(0.5f), alpha, alpha)});
      all.push_back({"brushed", make_material(model, Rgb(0.5f), Rgb(0.5f), alpha, 0.5f)});
    }
  }
  Material sharp = make_material(Model::phong, Rgb(0.5f), Rgb(0.5f));
  sharp.exponent = 1e6f;
  all.push_back({"phong 1e6", sharp});
  for (const float ior : {0.f, 1.f, 1e6f}) {
    for (const Model model :
         {Model::dielectric, Model::thin_dielectric, Model::plastic, Model::metallic_roughness}) {
      Material m = make_material(model, Rgb(1), Rgb(0), 0.2f, 0.2f);
      m.ior = ior;
      all.push_back({"ior", m});
    }
  }
  all.push_back({"black", make_material(Model::phong, Rgb(0), Rgb(0))});
  for (const Named& named : all) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (const float cosine : {1.f, 0.5f, 1e-2f, 1e-4f, 1e-7f, 0.f, -0.5f}) {
      const Vec3 wo = direction(cosine, 0.2f);
      for (int k = 0; k < 200; ++k) {
        RandomStream random(4, Stage::test, static_cast<std::uint64_t>(k));
        const Vec2 u = k < 2 ? Vec2(static_cast<float>(k) * 0x1.fffffep-1f) : random.uniform2();
        BsdfSample s;
        if (bsdf.sample(wo, random.uniform(), u, s)) {
          EXPECT_TRUE(is_finite(s.weight) && is_finite(s.direction)) << named.name;
          EXPECT_TRUE(s.specular || std::isfinite(s.density)) << named.name;
          EXPECT_NEAR(glm::length(s.direction), 1.f, 1e-5f);
          EXPECT_GT(cosine, 0) << named.name;
        }
        const Vec3 wi = direction(u.x, 6 * u.y);
        EXPECT_TRUE(is_finite(bsdf.evaluate(wo, wi))) << named.name;
        EXPECT_TRUE(std::isfinite(bsdf.density(wo, wi))) << named.name;
      }
    }
  }
}
