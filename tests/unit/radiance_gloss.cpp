// Which glossy materials read radiance records, by how many bands, and what a lobe and its records say.
#include <gtest/gtest.h>

#include "core/error.h"
#include "radiance/brdf/projection.h"
#include "radiance/gloss_cache.h"
#include "radiance/tree.h"
#include "scene/material/bsdf.h"
#include "support/one_material.h"
#include "support/quad.h"
#include "support/radiance_records.h"
#include "support/reflections.h"

namespace phos {
namespace {

using test::make_material;
using test::view;

Material phong(float exponent) { return test::phong(exponent, "phong"); }
Material ggx(float alpha_x, float alpha_y) {
  return make_material(Model::conductor, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), alpha_x, alpha_y);
}

/// A square of each material, so that all are in use.
Scene scene_of(const std::vector<Material>& materials) {
  Scene scene;
  scene.material = materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    test::add_quad(scene, 1, 1, static_cast<float>(m), true, m);
  return scene;
}

GlossTables tables_of(const Scene& scene, GlossBy by = GlossBy::automatic,
                      const BrdfTableOptions& options = {}, std::span<const BrdfTable> given = {}) {
  Counters counters;
  return GlossTables(scene, given, by, options, counters);
}

SurfacePoint point_of(std::uint32_t material) {
  SurfacePoint point = test::flat_point();
  point.material = material;
  return point;
}

TEST(GlossTables, OrdersOfMaterials) {
  const Scene scene = scene_of(
      {phong(5), phong(22), phong(3000), phong(5), make_material(Model::lambert, Rgb(0.5f), Rgb(0))});
  const GlossTables tables = tables_of(scene);
  EXPECT_GT(tables.order(0), 2);
  EXPECT_GT(tables.order(1), tables.order(0));
  EXPECT_EQ(tables.order(2), 0);
  EXPECT_EQ(tables.order(3), tables.order(0));
  EXPECT_EQ(tables.order(4), 0);
  EXPECT_EQ(tables.order(99), 0);
  EXPECT_EQ(tables.orders(), (std::vector<int>{tables.order(0), tables.order(1)}));
  EXPECT_EQ(tables.table(2), nullptr);
  ASSERT_EQ(tables.choices().size(), 4u) << "the matt one has no gloss to choose for";
  EXPECT_EQ(tables.choices()[0].traced_share, 0);
  EXPECT_EQ(tables.choices()[2].order, 0);
  EXPECT_EQ(tables.choices()[2].traced_share, 1);
  for (const GlossChoice& choice : tables.choices()) EXPECT_FALSE(choice.why.empty());
}

TEST(GlossTables, AllTraced) {
  const Scene scene = scene_of({phong(5)});
  const GlossTables tables = tables_of(scene, GlossBy::traced);
  EXPECT_TRUE(tables.orders().empty());
  ASSERT_EQ(tables.choices().size(), 1u);
  EXPECT_EQ(tables.choices()[0].traced_share, 1);
  GlossLobe lobe;
  EXPECT_FALSE(tables.lobe(point_of(0), view(10), lobe));
  EXPECT_FALSE(GlossTables().lobe(point_of(0), view(10), lobe));
}

/// Given tables are taken as they are, but for directions left to rays where none is to be.
TEST(GlossTables, TakesGivenTables) {
  const Scene scene = scene_of({phong(5), phong(60)});
  BrdfTableOptions coarse;
  coarse.resolution = 5, coarse.error = 0.2;
  Counters counters;
  const std::vector<BrdfTable> given = {project_brdf(scene, 0, coarse, counters),
                                        project_brdf(scene, 1, coarse, counters)};
  ASSERT_GT(summarize(given[1]).traced_share, 0);
  for (const GlossBy by : {GlossBy::automatic, GlossBy::cached}) {
    const GlossTables tables = tables_of(scene, by, {}, given);
    EXPECT_EQ(tables.table(0)->resolution, 5);
    EXPECT_EQ(tables.table(0)->coefficients, given[0].coefficients);
  }
  EXPECT_EQ(tables_of(scene, GlossBy::automatic, {}, given).table(1)->resolution, 5);
  EXPECT_EQ(tables_of(scene, GlossBy::cached, {}, given).table(1)->resolution, 32);
}

/// Whatever a lobe needs, its bands are cut off, and no direction is left to rays; what is left of it has the
/// albedo of all of it.
TEST(GlossTables, CachedLeavesNothingToRays) {
  const Scene scene = scene_of({phong(60), ggx(0.1f, 0.1f), ggx(0.05f, 0.4f)});
  const GlossTables some = tables_of(scene), all = tables_of(scene, GlossBy::cached);
  const float one[] = {std::sqrt(2 * kPi)};
  for (std::uint32_t m = 0; m < 3; ++m) {
    EXPECT_GT(some.choices()[m].traced_share, 0) << m;
    EXPECT_EQ(all.choices()[m].traced_share, 0) << m;
    EXPECT_EQ(all.order(m), 10) << m;
    const Bsdf bsdf(scene, m);
    for (const float theta : {5.f, 40.f, 70.f}) {
      GlossLobe lobe;
      ASSERT_TRUE(all.lobe(point_of(m), view(theta, 30), lobe));
      Rgb albedo(0);
      BsdfSample sample;
      constexpr int kSamples = 20000;
      for (int i = 0; i < kSamples; ++i)
        if (bsdf.sample_gloss(view(theta, 30), r2_point(i, {0.5f, 0.5f}), sample))
          albedo += sample.weight / static_cast<float>(kSamples);
      EXPECT_NEAR(lobe.coefficients[0] * one[0], albedo.x, 0.03f * albedo.x) << m << ' ' << theta;
    }
  }
}

/// Integrals of f cos H_i, i below order, in `frame`, by quadrature.
std::vector<double> by_quadrature(const Scene& scene, const SurfacePoint& point, const Vec3& wo,
                                  const Frame& frame, int order) {
  static const Quadrature q = hemisphere_quadrature(80, 160);
  const Bsdf bsdf(scene, point);
  return project(
      [&](double x, double y, double z) {
        const Vec3 wi = frame.to_world(Vec3(DVec3(x, y, z)));
        const float cosine = std::max(glm::dot(wi, point.normal), 0.f);
        return static_cast<double>(bsdf.evaluate_gloss(wo, wi).x * cosine);
      },
      BasisKind::hsh, order, q);
}

void expect_lobe(const Scene& scene, const GlossTables& tables, const SurfacePoint& point, const Vec3& wo,
                 double tolerance, const char* what) {
  GlossLobe lobe;
  ASSERT_TRUE(tables.lobe(point, wo, lobe)) << what;
  EXPECT_EQ(lobe.frame.x, make_frame(point.smooth_normal).x);
  EXPECT_EQ(lobe.frame.z, point.smooth_normal);
  ASSERT_EQ(lobe.coefficients.size(), 3 * static_cast<std::size_t>(harmonic_count(lobe.order)));
  const std::vector<double> truth = by_quadrature(scene, point, wo, lobe.frame, lobe.order);
  double off = 0, all = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double d = static_cast<double>(lobe.coefficients[3 * i]) - truth[i];
    off += d * d, all += truth[i] * truth[i];
  }
  EXPECT_LT(std::sqrt(off), tolerance * std::sqrt(all)) << what;
}

/// Whatever way the surface faces, and the viewer looks.
TEST(GlossLobe, IsTheIntegralOfTheLobe) {
  BrdfTableOptions options;
  options.resolution = 48, options.error = 0.0005, options.max_order = 14;
  const std::vector<Material> materials = {phong(8), ggx(0.4f, 0.4f), ggx(0.5f, 0.3f),
                                           make_material(Model::plastic, Rgb(0.8f), Rgb(0), 0.4f, 0.4f)};
  const Scene scene = scene_of(materials);
  const GlossTables tables = tables_of(scene, GlossBy::automatic, options);
  const Vec3 normals[] = {{0, 0, 1}, {0, -1, 0}, glm::normalize(Vec3(0.3f, -0.5f, -0.8f))};
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    for (const Vec3& n : normals) {
      SurfacePoint point = point_of(m);
      const Frame frame = test::turned_about_z(make_frame(n), 0.7f);
      point.geometric_normal = point.smooth_normal = point.normal = n;
      point.tangent = frame.x;
      for (const auto& [theta, phi] : {std::pair{2.f, 10.f}, std::pair{25.f, 200.f}, std::pair{45.f, -80.f}})
        expect_lobe(scene, tables, point, frame.to_world(view(theta, phi)), 0.02,
                    text("material ", m, " theta ", theta).c_str());
    }
  }
}

/// A normal map turns the shading normal: what the lobe loses below the surface's own horizon is not in it.
TEST(GlossLobe, IsRotatedByNormalMaps) {
  BrdfTableOptions options;
  options.resolution = 40, options.error = 0.002, options.max_order = 12;
  const Scene scene = scene_of({phong(8), ggx(0.5f, 0.35f)});
  const GlossTables tables = tables_of(scene, GlossBy::automatic, options);
  for (std::uint32_t m = 0; m < 2; ++m) {
    for (const float tilt : {0.1f, 0.3f, 0.6f}) {
      SurfacePoint point = point_of(m);
      point.normal = {0.6f * std::sin(tilt), -0.8f * std::sin(tilt), std::cos(tilt)};
      const Frame frame = test::turned_about_z(make_frame(point.normal), 0.4f);
      point.tangent = frame.x;
      expect_lobe(scene, tables, point, frame.to_world(view(15, 70)), 0.03, text("tilt ", tilt).c_str());
    }
  }
}

/// Where colours change a metal's lobe from place to place, rays show it, unless records are asked for.
TEST(GlossTables, TexturedMetalsAreTraced) {
  Scene scene = scene_of({make_material(Model::metallic_roughness, Rgb(1), Rgb(0))});
  Material& m = scene.material[0];
  m.metallic = 1, m.roughness = 0.7f;
  EXPECT_GT(tables_of(scene).order(0), 0);
  Texture texture;
  texture.width = 2, texture.height = 1;
  texture.texels = {Vec4(0.2f, 0.4f, 0.6f, 1), Vec4(0.4f, 0.6f, 1, 1)};
  scene.texture.push_back(texture);
  m.base_colour.texture = 0;
  EXPECT_EQ(tables_of(scene).order(0), 0);
  EXPECT_NE(tables_of(scene).choices()[0].why.find("textures"), std::string::npos);
  EXPECT_GT(tables_of(scene, GlossBy::cached).order(0), 0);
  m.base_colour.texture = -1;
  scene.colour.assign(scene.position.size(), Vec4(0.5f));
  EXPECT_EQ(tables_of(scene).order(0), 0);
  scene.colour.assign(scene.position.size(), Vec4(1));
  EXPECT_GT(tables_of(scene).order(0), 0);
}

Bounds unit_box() {
  Bounds b;
  b.include(Vec3(-1)), b.include(Vec3(1));
  return b;
}
Rgb sky(const Vec3& w) { return Rgb(1 + 0.5f * w.x, 1 + 0.4f * w.y * w.z, 0.5f + 0.3f * w.x * w.y); }

/// Each class of materials has the records of its own order; of other orders, those with bands enough.
TEST(GlossCache, RecordsServeTheirClass) {
  const Scene scene = scene_of({phong(3), phong(20)});
  const GlossTables tables = tables_of(scene);
  const int low = tables.order(0), high = tables.order(1);
  ASSERT_LT(low, high);
  GlossCache cache(unit_box(), 0.3, tables);
  EXPECT_EQ(cache.size(), 0u);
  EXPECT_EQ(cache.tree(low + high), nullptr);
  const auto insert = [&](int order) {
    cache.insert(test::radiance_record(sky, Vec3(0), Frame(), order));
    return std::pair(cache.tree(low)->size(), cache.tree(high)->size());
  };
  EXPECT_EQ(insert(low - 1), (std::pair<std::size_t, std::size_t>(0, 0)));
  EXPECT_EQ(insert(low), (std::pair<std::size_t, std::size_t>(1, 0)));
  EXPECT_EQ(insert(high), (std::pair<std::size_t, std::size_t>(1, 1)));
  EXPECT_EQ(insert(high - 1), (std::pair<std::size_t, std::size_t>(2, 1)));
  EXPECT_EQ(insert(high + 1), (std::pair<std::size_t, std::size_t>(3, 2)));
  EXPECT_EQ(cache.size(), 5u);
  // Cut off to its bands, each says the same.
  const RadianceTree& tree = *cache.tree(low);
  EXPECT_EQ(tree[0].light, tree[1].light);
  EXPECT_EQ(tree[0].gradient_x.size(), tree[2].gradient_x.size());
}

TEST(GlossCache, MissesAndRaysAreToldApart) {
  const Scene scene = scene_of({phong(8), phong(3000)});
  GlossCache cache(unit_box(), 0.3, tables_of(scene));
  cache.insert(test::radiance_record(sky, Vec3(0), Frame(), cache.tables().order(0)));
  GlossCache::Worker worker;
  EXPECT_FALSE(cache.outgoing(point_of(1), view(10), worker)) << "too sharp";
  SurfacePoint point = point_of(0);
  ASSERT_TRUE(cache.outgoing(point, view(10), worker));
  EXPECT_GT(cache.outgoing(point, view(10), worker)->weight, 0);
  point.position = {0.5f, 0, 0};
  EXPECT_TRUE(cache.serves(point, view(10), worker));
  ASSERT_TRUE(cache.outgoing(point, view(10), worker));
  EXPECT_EQ(cache.outgoing(point, view(10), worker)->weight, 0);
  EXPECT_EQ(cache.outgoing(point, view(10), worker)->radiance, Rgb(0));
}

/// What one table's own lookup and one record's own light say, for every frame and colour.
TEST(GlossCache, LobeTimesLight) {
  const Scene scene = scene_of({phong(8)});
  GlossCache cache(unit_box(), 0.3, tables_of(scene));
  const int order = cache.tables().order(0);
  cache.insert(test::radiance_record(sky, Vec3(0), test::turned_about_z(Frame(), 1), order));
  GlossCache::Worker worker;
  const BrdfLookup brdf(*cache.tables().table(0));
  for (const Vec3& wo : {view(0), view(30, 50), view(60, -100)}) {
    const GlossyLight out = cache.outgoing(point_of(0), wo, worker).value();
    const Rgb expected = brdf.outgoing(wo, test::projected(sky, make_frame({0, 0, 1}), order));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(out.radiance[c], expected[c], 1e-5f);
    EXPECT_GT(out.stderr_cd.x, 0);
  }
}

}  // namespace
}  // namespace phos
