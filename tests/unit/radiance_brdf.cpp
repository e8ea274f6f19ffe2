// Tables of glossy reflection: what they hold, how they are read, and their file.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/table.h"
#include "radiance/events.h"
#include "scene/material/bsdf.h"
#include "support/one_material.h"
#include "support/reflections.h"
#include "support/run.h"

namespace phos {
namespace {

using test::make_material;
using test::view;

Material phong(float exponent) { return test::phong(exponent, "floor"); }

BrdfTable table_of(const Material& material, const BrdfTableOptions& options = {}) {
  Counters counters;
  return project_brdf(test::scene_of(material), 0, options, counters);
}

bool same(const BrdfTable& a, const BrdfTable& b) {
  return a.material == b.material && a.material_index == b.material_index && a.isotropic == b.isotropic &&
         a.resolution == b.resolution && a.order == b.order && a.orders == b.orders && a.error == b.error &&
         a.coefficients == b.coefficients && a.albedo == b.albedo && a.note == b.note;
}

BrdfTableOptions coarse(std::int64_t resolution = 6) {
  BrdfTableOptions options;
  options.resolution = resolution;
  return options;
}

TEST(BrdfTable, KnowsIsotropicMaterials) {
  for (const test::Named& m : test::models()) {
    const Bsdf bsdf(test::scene_of(m.material), std::uint32_t{0});
    if (!bsdf.has_gloss()) continue;
    const bool isotropic = m.material.alpha_x == m.material.alpha_y && m.material.anisotropy == 0;
    EXPECT_EQ(table_of(m.material, coarse(2)).isotropic, isotropic) << m.name;
  }
  // Narrow lobes too.
  for (const float alpha : {0.002f, 0.01f, 0.05f}) {
    EXPECT_TRUE(table_of(make_material(Model::conductor, Rgb(0), Rgb(1), alpha, alpha), coarse(2)).isotropic);
    EXPECT_FALSE(
        table_of(make_material(Model::conductor, Rgb(0), Rgb(1), alpha, 1.1f * alpha), coarse(2)).isotropic);
  }
}

TEST(BrdfTable, DirectionsOfTheGrid) {
  BrdfTable grid;
  grid.isotropic = false, grid.resolution = 32;
  int inside = 0;
  for (std::size_t e = 0; e < 1024; ++e) {
    const Vec3 d = grid.direction(e);
    EXPECT_NEAR(glm::length(d), 1, 1e-6);
    EXPECT_GE(d.z, BrdfTable::kLeastCosine);
    if (!grid.inside(e)) {
      EXPECT_EQ(d.z, BrdfTable::kLeastCosine);
      continue;
    }
    ++inside;
    EXPECT_TRUE(grid.used(e));
    const Vec2 p = Vec2(d.x, d.y) / (1 + d.z);
    EXPECT_NEAR(p.x, (2 * static_cast<float>(e % 32) + 1) / 32 - 1, 2e-3);
    EXPECT_NEAR(p.y, (2 * static_cast<float>(e / 32) + 1) / 32 - 1, 2e-3);
  }
  EXPECT_EQ(inside, 812);
  EXPECT_FALSE(grid.used(0));
  BrdfTable rows;
  rows.resolution = 17;
  EXPECT_EQ(rows.direction(0), Vec3(0, 0, 1));
  EXPECT_NEAR(rows.direction(8).x, 0.8f, 1e-6);  // tan(t/2) = 1/2
  EXPECT_EQ(rows.direction(16).z, BrdfTable::kLeastCosine);
}

// Lookups read used entries alone: with the others not a number, no answer changes.
TEST(BrdfTable, LookupsReadUsedEntriesAlone) {
  BrdfTable grid;
  grid.isotropic = false, grid.resolution = 9, grid.order = 1;
  grid.orders.assign(81, 1), grid.error.assign(81, 0), grid.coefficients.assign(3 * 81, 1);
  for (std::size_t e = 0; e < 81; ++e) {
    if (grid.used(e)) continue;
    grid.orders[e] = 0;
    std::fill_n(grid.coefficients.begin() + static_cast<std::ptrdiff_t>(3 * e), 3, NAN);
  }
  const BrdfLookup lookup(grid);
  const float light[] = {1, 2, 3};
  for (float theta = 0; theta <= 90; theta += 1.5f) {
    for (float phi = 0; phi < 360; phi += 7) {
      EXPECT_EQ(lookup.order(view(theta, phi)), 1) << theta << ' ' << phi;
      EXPECT_NEAR(lookup.outgoing(view(theta, phi), light).y, 2, 1e-5);
    }
  }
}

TEST(BrdfTable, QuadrantsAreMirrored) {
  const Material ward = make_material(Model::ward, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), 0.5f, 0.3f);
  const BrdfTable table = table_of(ward, coarse(7));
  ASSERT_FALSE(table.isotropic);
  const Scene scene = test::scene_of(ward);
  const Bsdf bsdf(scene, std::uint32_t{0});
  const HarmonicBasis<float> basis(table.order);
  const auto stride = 3 * static_cast<std::size_t>(basis.count());
  int seen = 0;
  for (std::size_t e = 0; e < table.entries(); ++e) {
    if (!table.used(e) || table.orders[e] == 0) continue;
    const Vec3 wo = table.direction(e);
    const LobeProjection own =
        project_lobe([&](const Vec3& wi) { return bsdf.evaluate_gloss(wo, wi); }, test::mirror_of(wo), basis);
    const auto numbers = 3 * static_cast<std::size_t>(harmonic_count(table.orders[e]));
    for (std::size_t i = 0; i < stride; ++i)
      EXPECT_NEAR(table.coefficients[e * stride + i], i < numbers ? own.coefficients[i] : 0, 2e-4)
          << e << ' ' << i;
    ++seen;
  }
  EXPECT_GT(seen, 12);
}

TEST(BrdfTable, SameNumbersOnAnyNumberOfThreads) {
  const Material ward = make_material(Model::ward, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), 0.5f, 0.3f);
  set_threads(1);
  const BrdfTable one = table_of(ward, coarse());
  set_threads(3);
  EXPECT_TRUE(same(one, table_of(ward, coarse())));
  set_threads(0);
}

TEST(BrdfTable, TighterErrorsTakeHigherOrders) {
  BrdfTableOptions options = coarse(5);
  int before = 0;
  for (const double error : {0.5, 0.1, 0.01, 0.001}) {
    options.error = error, options.max_order = 20;
    const BrdfTable table = table_of(phong(15), options);
    EXPECT_GT(table.order, before) << error;
    before = table.order;
    float worst = 0;
    for (std::size_t e = 0; e < table.entries(); ++e)
      if (table.orders[e] > 0) worst = std::max(worst, table.error[e]);
    EXPECT_LE(worst, error);
    EXPECT_GT(worst, 0);
  }
  options.max_order = 4;  // not enough for 0.001
  const BrdfTable table = table_of(phong(15), options);
  EXPECT_EQ(table.order, 0);
  EXPECT_TRUE(table.coefficients.empty());
  for (const float error : table.error) EXPECT_GT(error, 0.001f);
}

/// Cut off at the highest order instead: what there is of a lobe is what a higher order would begin with.
TEST(BrdfTable, TooSharpLobesCanBeCut) {
  BrdfTableOptions options = coarse(5);
  options.max_order = 6, options.too_sharp = TooSharp::cut;
  const BrdfTable cut = table_of(phong(200), options);
  EXPECT_EQ(summarize(cut).traced_share, 0);
  EXPECT_EQ(cut.order, 6);
  EXPECT_GT(summarize(cut).worst_error, options.error);
  options.max_order = 12;
  const BrdfTable more = table_of(phong(200), options);
  for (std::size_t e = 0; e < cut.entries(); ++e)
    for (std::size_t i = 0; i < 3 * 36; ++i)
      EXPECT_NEAR(cut.coefficients[e * 3 * 36 + i], more.coefficients[e * 3 * 144 + i], 1e-4);
  options.too_sharp = TooSharp::trace;
  EXPECT_EQ(table_of(phong(200), options).order, 0);
}

TEST(BrdfTable, Summary) {
  BrdfTable table;
  table.resolution = 4, table.order = 6;
  table.orders = {4, 6, 0, 0}, table.error = {0.01f, 0.03f, 0.5f, 0.6f};
  const BrdfSummary s = summarize(table);
  EXPECT_EQ(s.least_order, 4);
  EXPECT_EQ(s.greatest_order, 6);
  EXPECT_DOUBLE_EQ(s.mean_order, 5);
  EXPECT_DOUBLE_EQ(s.traced_share, 0.5);
  EXPECT_NEAR(s.mean_error, 0.02, 1e-8);
  EXPECT_NEAR(s.worst_error, 0.03, 1e-8);
  EXPECT_EQ(s.bytes, 4u * (3 * 21 * 4 + 4 + 1));
}

// The Lambert part belongs to irradiance.
TEST(BrdfTable, HoldsNoLambertPart) {
  Material with = phong(10), without = phong(10);
  without.kd = Rgb(0);
  EXPECT_EQ(table_of(with, coarse()).coefficients, table_of(without, coarse()).coefficients);
  EXPECT_NEAR(table_of(with, coarse()).albedo - table_of(without, coarse()).albedo, 0.1f, 1e-5);
}

TEST(BrdfTable, GainsOfEnergyAreCounted) {
  Material m = phong(20);
  Counters counters;
  EXPECT_LE(project_brdf(test::scene_of(m), 0, coarse(), counters).albedo, 0.91f);
  EXPECT_EQ(counters[kGainsEnergyEvent], 0u);
  m.kd = Rgb(0.3f);  // kd + ks = 1.1 at the normal, where the lobe loses nothing
  EXPECT_NEAR(project_brdf(test::scene_of(m), 0, coarse(), counters).albedo, 1.1f, 2e-3);
  EXPECT_GE(counters[kGainsEnergyEvent], 1u);
}

TEST(BrdfTable, TexturesCountByTheirMean) {
  Scene scene = test::scene_of(make_material(Model::metallic_roughness, Rgb(1), Rgb(0)));
  Material& material = scene.material[0];
  material.metallic = 1, material.roughness = 0.6f;
  EXPECT_EQ(table_of(material, coarse()).note, "");
  Texture texture;
  texture.width = 2, texture.height = 1;
  texture.texels = {Vec4(0.2f, 0.4f, 0.6f, 1), Vec4(0.4f, 0.6f, 1, 1)};
  scene.texture.push_back(texture);
  material.base_colour.texture = 0;
  Counters counters;
  const BrdfTable mean = project_brdf(scene, 0, coarse(), counters);
  EXPECT_EQ(mean.note, "textures at their mean");
  material.base_colour.texture = -1, material.kd = Rgb(0.3f, 0.5f, 0.8f);
  const BrdfTable plain = project_brdf(scene, 0, coarse(), counters);
  ASSERT_EQ(mean.coefficients.size(), plain.coefficients.size());
  for (std::size_t i = 0; i < mean.coefficients.size(); ++i)
    EXPECT_NEAR(mean.coefficients[i], plain.coefficients[i], 1e-5);
}

// The largest order around counts, and a single traced neighbour is enough to trace.
TEST(BrdfLookup, OrderOfTheNeighbours) {
  BrdfTable table;
  table.resolution = 5, table.order = 3;
  table.orders = {1, 3, 2, 0, 2}, table.error.assign(5, 0), table.coefficients.assign(5 * 27, 1);
  const BrdfLookup lookup(table);
  const auto at = [](float r) { return Vec3(2 * r, 0, 1 - r * r) / (1 + r * r); };
  EXPECT_EQ(lookup.order(at(0)), 1);
  EXPECT_EQ(lookup.order(at(0.1f)), 3);
  EXPECT_EQ(lookup.order(at(0.3f)), 3);
  EXPECT_EQ(lookup.order(at(0.6f)), 0);
  EXPECT_EQ(lookup.order(at(0.8f)), 0);
}

TEST(BrdfLookup, BandsThatOneSideLacksCountNothing) {
  const BrdfTable table = table_of(phong(10), coarse());
  const BrdfLookup lookup(table);
  const Vec3 wo = view(20, 40);
  const int order = lookup.order(wo);
  ASSERT_GE(order, 3);
  std::vector<float> light(3 * 15 * 15, 1.f), low(light.begin(), light.begin() + 3 * 9);
  std::vector<float> padded = low;
  padded.resize(light.size());
  EXPECT_EQ(lookup.outgoing(wo, low), lookup.outgoing(wo, padded));
  std::fill(light.begin() + 3 * harmonic_count(table.order), light.end(), 1e30f);
  EXPECT_TRUE(is_finite(lookup.outgoing(wo, light)));
  EXPECT_LT(lookup.outgoing(wo, light).x, 1e6f);
  EXPECT_EQ(lookup.outgoing(wo, {}), Rgb(0));
}

TEST(BrdfFile, ComesBackAsItWas) {
  const std::string path = test::scratch("brdf_file") + "/room.brdf";
  std::vector<BrdfTable> tables = {
      table_of(phong(15), coarse()),
      table_of(make_material(Model::ward, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), 0.5f, 0.3f), coarse()),
      table_of(phong(5000), coarse())};
  tables[1].note = "textures at their mean", tables[1].material_index = 7;
  ASSERT_EQ(tables[2].order, 0);
  Provenance provenance;
  provenance.tool = "phos-brdf", provenance.scene_hash = "abc";
  write_brdf(path, tables, provenance);
  const Container file = Container::open(path, FileKind::brdf);
  EXPECT_EQ(file.provenance().scene_hash, "abc");
  const std::vector<BrdfTable> back = read_brdf(file);
  ASSERT_EQ(back.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) EXPECT_TRUE(same(tables[t], back[t])) << t;
  // What nobody reads is not there: sines of isotropic lobes, coefficients where all is traced.
  const auto order = static_cast<std::uint64_t>(tables[0].order);
  EXPECT_EQ(file.tensors().at("0.coefficients").shape, (Shape{6, order * (order + 1) / 2, 3}));
  EXPECT_FALSE(file.has("2.coefficients"));
  std::uint64_t bytes = 0;
  for (const char* column : {"0.orders", "0.error", "0.coefficients"})
    bytes += file.tensors().at(column).bytes.size();
  EXPECT_EQ(summarize(tables[0]).bytes, bytes);
}

TEST(BrdfFile, EmptyMeansNothingGlossy) {
  const std::string path = test::scratch("brdf_file") + "/matt.brdf";
  write_brdf(path, {}, Provenance{});
  const Container file = Container::open(path, FileKind::brdf);
  EXPECT_TRUE(read_brdf(file).empty());
  EXPECT_TRUE(file.tensors().empty());
}

TEST(BrdfFile, AnotherSceneIsRefused) {
  const std::string path = test::scratch("brdf_file") + "/room.brdf";
  Provenance provenance;
  provenance.scene_hash = "one";
  write_brdf(path, {}, provenance);
  const Container file = Container::open(path, FileKind::brdf);
  EXPECT_NO_THROW(require_same_scene(file, "room.glb", "one", Json()));
  try {
    require_same_scene(file, "room.glb", "two", Json());
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::mismatch);
  }
}

}  // namespace
}  // namespace phos
