// What a glossy plane shows by radiance records, under light whose reflection is known in closed form or by
// quadrature of the reflection model itself.
#include <gtest/gtest.h>

#include "radiance/gloss_cache.h"
#include "scene/material/bsdf.h"
#include "support/one_material.h"
#include "support/quad.h"
#include "support/radiance_records.h"
#include "support/reflections.h"

namespace phos {
namespace {

using test::make_material;
using test::view;

Bounds unit_box() {
  Bounds b;
  b.include(Vec3(-1)), b.include(Vec3(1));
  return b;
}

/// A plane of one material, and one record on it. Lobes to a thousandth of their energy.
struct Plane {
  Plane(const Material& material, const test::WorldLight& light, const Frame& frame = {})
      : cache(unit_box(), 0.3, tables_of(material)) {
    record = test::radiance_record(light, Vec3(0), frame, cache.tables().order(0));
    cache.insert(record);
  }
  GlossTables tables_of(const Material& material) {
    scene.material = {material};
    test::add_quad(scene, 1, 1, 0, true, 0);
    BrdfTableOptions options;
    options.error = 1e-3, options.max_order = 16, options.resolution = 40;
    Counters counters;
    return {scene, {}, GlossBy::automatic, options, counters};
  }
  Rgb shown(const Vec3& wo) {
    GlossCache::Worker worker;
    const auto light = cache.outgoing(test::flat_point(), wo, worker);
    EXPECT_TRUE(light && light->weight > 0) << wo.z;
    return light ? light->radiance : Rgb(-1);
  }
  /// Integral of the light times f cos, over the hemisphere.
  Rgb truth(const Vec3& wo, const test::WorldLight& light) const {
    static const Quadrature q = hemisphere_quadrature(100, 200);
    const Bsdf bsdf(scene, test::flat_point());
    DVec3 sum(0);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Vec3 wi(DVec3(q.x[i], q.y[i], q.z[i]));
      sum += q.weight[i] * q.z[i] * DVec3(bsdf.evaluate_gloss(wo, wi) * light(wi));
    }
    return Rgb(sum);
  }
  Scene scene;
  GlossCache cache;
  RadianceRecord record;
};

Material phong(float exponent) {
  Material m = make_material(Model::phong, Rgb(0.2f), Rgb(0.8f, 0.5f, 0.2f));
  m.exponent = exponent;
  return m;
}

/// Looked at straight on, with L(w) = a + b z: ks (a + b (n+2)/(n+3)); what changes along x or y cancels.
TEST(PhongPlane, StraightOn) {
  for (const float n : {1.f, 5.f, 12.f}) {
    const auto light = [](const Vec3& w) { return Rgb(2 + 3 * w.z + 0.5f * w.x - 0.7f * w.y); };
    const Rgb shown = Plane(phong(n), light).shown({0, 0, 1});
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(shown[c], phong(n).ks[c] * (2 + 3 * (n + 2) / (n + 3)), 0.004f * shown[c]) << n;
  }
}

TEST(Plane, ConstantAndLinearLight) {
  const auto constant = [](const Vec3&) { return Rgb(3, 2, 1); };
  const auto linear = [](const Vec3& w) { return Rgb(3 + w.x, 2 - w.y, 1 + 0.5f * w.z + 0.4f * w.x); };
  Material metal = make_material(Model::metallic_roughness, Rgb(1, 0.8f, 0.5f), Rgb(0));
  metal.metallic = 1, metal.roughness = 0.65f;
  const test::Named materials[] = {
      {"phong", phong(10)},
      {"ggx", make_material(Model::conductor, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), 0.4f, 0.4f)},
      {"ggx, anisotropic", make_material(Model::conductor, Rgb(0), Rgb(0.9f), 0.6f, 0.4f)},
      {"metal", metal}};
  for (const auto& [name, material] : materials) {
    for (const bool even : {true, false}) {
      const test::WorldLight light = even ? test::WorldLight(constant) : test::WorldLight(linear);
      Plane plane(material, light, test::turned_about_z(Frame(), 1.3f));
      for (const Vec3& wo : {view(0), view(25, 30), view(50, 200)}) {
        const Rgb shown = plane.shown(wo), truth = plane.truth(wo, light);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(shown[c], truth[c], 0.01f * truth[c]) << name << ' ' << even << ' ' << wo.z;
      }
    }
  }
}

/// Under a coat the lobe is signed: where the light stands low behind the viewer, the coat takes away from
/// what the Lambert part would show, and no more than that.
TEST(Plane, CoatsTakeLightToo) {
  const Material plastic = make_material(Model::plastic, Rgb(0.9f), Rgb(0), 0.5f, 0.5f);
  const auto behind = [](const Vec3& w) {
    return Rgb(std::pow(std::max(glm::dot(w, view(85, 0)), 0.f), 20.f));
  };
  Plane plane(plastic, behind);
  const Vec3 wo = view(40, 0);
  const Rgb shown = plane.shown(wo), truth = plane.truth(wo, behind);
  ASSERT_LT(truth.x, 0);
  EXPECT_LT(shown.x, 0);
  const float e = irradiance_of(plane.record).irradiance.x;
  EXPECT_NEAR(shown.x, truth.x, 0.02f * e / kPi);
  const float diffuse = Bsdf(plane.scene, test::flat_point()).diffuse_reflectance().x;
  EXPECT_GE(shown.x + diffuse * e / kPi, 0);
}

}  // namespace
}  // namespace phos
