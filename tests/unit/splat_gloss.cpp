// Radiance records drawn on the CPU, against the lookup.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "core/parallel.h"
#include "splat/cpu/gloss_kernel.h"
#include "splat/gl/renderer.h"
#include "support/gloss_view.h"

namespace phos {
namespace {

constexpr double kAccuracy = test::GlossView::kAccuracy;
constexpr Vec2 kMiddle = test::GlossView::kMiddle;

/// How two pictures differ.
struct Difference {
  std::size_t drawn = 0, other_records = 0;
  double light = 0, error = 0, weight = 0;  // greatest, over what a pixel of that weight may show
};

Difference difference(const GlossBuffer& a, const GlossBuffer& b) {
  Difference d;
  double most = 0, most_error = 0;  // of mean luminances
  for (std::size_t i = 0; i < a.light.size(); ++i) {
    if (!(a.light[i].w > 0)) continue;
    most = std::max(most, double(max_component(Rgb(a.light[i]) / a.light[i].w)));
    most_error = std::max(most_error, double(max_component(Rgb(a.error[i]) / a.light[i].w)));
  }
  for (std::size_t i = 0; i < a.light.size(); ++i) {
    d.drawn += a.light[i].w > 0;
    if (a.error[i].w != b.error[i].w) {
      ++d.other_records;
      continue;
    }
    const auto off = [&](const Vec4& x, const Vec4& y) {
      return double(max_component(glm::abs(Rgb(x) - Rgb(y))));
    };
    d.light = std::max(d.light, off(a.light[i], b.light[i]) / most);
    d.error = std::max(d.error, off(a.error[i], b.error[i]) / most_error);
    d.weight = std::max(d.weight, std::fabs(double(a.light[i].w) - double(b.light[i].w)));
  }
  return d;
}

struct Gloss : test::GlossView {
  explicit Gloss(Scene of) : GlossView(std::move(of), 90, 70) {}
  void expect_as_looked_up(const std::vector<RadianceRecord>& records, std::size_t drawn_at_least) const {
    const GlossCache filled = cache(records);
    const GlossBuffer drawn = draw(filled), looked_up = look_up(filled);
    const Difference d = difference(looked_up, drawn);
    EXPECT_GE(d.drawn, drawn_at_least);
    EXPECT_LE(d.other_records, 2u) << "only rounding at the border of validity";
    EXPECT_LT(d.light, 1e-4);
    EXPECT_LT(d.error, 1e-4);
    EXPECT_LT(d.weight, 1e-4);
    EXPECT_NEAR(double(drawn.pairs), double(looked_up.pairs), 4);
  }
};

TEST(GlossSplat, IsTheLookupOnFlatSurfaces) {
  const Gloss box{test::glossy_cornell()};
  box.expect_as_looked_up(box.records(60, 0.1f, 0.8f), 500);
  EXPECT_EQ(box.draw(box.cache(box.records(20, 0.2f, 0.5f))).turned, 0u);
}

TEST(GlossSplat, FootprintsAmongDiscsAreTheLookup) {
  const Gloss box{test::glossy_cornell()};
  std::vector<RadianceRecord> records = box.records(80, 0.2f, 0.8f);
  const GlossBuffer discs = box.draw(box.cache(records));
  test::shape(records);
  box.expect_as_looked_up(records, 500);
  EXPECT_LT(box.draw(box.cache(records)).pairs, discs.pairs) << "they reach less far";
  const Gloss sphere{test::glossy_sphere().scene};
  records = sphere.records(60, 0.6f, 3);
  test::shape(records);
  sphere.expect_as_looked_up(records, 2000);
}

TEST(GlossSplat, TurnsRecordsOnCurvedOnes) {
  const Gloss sphere{test::glossy_sphere().scene};
  const std::vector<RadianceRecord> records = sphere.records(40, 0.3f, 2);
  sphere.expect_as_looked_up(records, 2500);
  EXPECT_GT(sphere.draw(sphere.cache(records)).turned, 2500u);
}

/// A record in another frame of the same normal.
TEST(GlossSplat, TurnsRecordsAboutTheNormal) {
  const Gloss box{test::glossy_cornell()};
  std::vector<RadianceRecord> records = box.records(30, 0.2f, 0.8f);
  for (RadianceRecord& r : records) {
    const Frame f = r.frame;
    r.frame = {0.6f * f.x + 0.8f * f.y, 0.6f * f.y - 0.8f * f.x, f.z};
  }
  box.expect_as_looked_up(records, 500);
}

/// The walls of the box made glossy: materials of different orders, anisotropic ones, a coat.
Scene many_materials() {
  Scene scene = test::glossy_cornell();
  for (Material& m : scene.material)
    if (m.name == "white") m.model = Model::plastic, m.alpha_x = m.alpha_y = 0.5f;
  for (Material& m : scene.material)
    if (m.name == "red") m.model = Model::ward, m.ks = Rgb(0.4f), m.alpha_x = 0.6f, m.alpha_y = 0.4f;
  for (Material& m : scene.material)
    if (m.name == "green") m.model = Model::phong, m.ks = Rgb(0.2f, 0.3f, 0.5f), m.exponent = 3;
  return scene;
}

TEST(GlossSplat, EveryMaterialReadsItsOwnBands) {
  const Gloss box{many_materials()};
  ASSERT_GE(box.tables.orders().size(), 2u);
  box.expect_as_looked_up(box.records(200, 0.1f, 0.8f), 2000);
}

TEST(GlossSplat, NoGradientsNoSteps) {
  const Gloss box{test::glossy_cornell()};
  std::vector<RadianceRecord> records = box.records(30, 0.2f, 0.8f);
  for (RadianceRecord& r : records) r.gradient_x.clear(), r.gradient_y.clear();
  box.expect_as_looked_up(records, 500);
}

/// Twice: a renderer serves many pictures.
void expect_gl_as_cpu(const Gloss& of, const std::vector<RadianceRecord>& records) {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  const GlossCache cache = of.cache(records);
  const GlossBuffer cpu = of.draw(cache);
  GlRenderer gl(of.scene);
  for (int i = 0; i < 2; ++i) {
    const GlossBuffer drawn = gl.splat_gloss(cache, kAccuracy, of.rays, of.g, of.camera, kMiddle);
    const Difference d = difference(cpu, drawn);
    EXPECT_GT(d.drawn, 500u);
    EXPECT_LE(d.other_records, 2u);
    EXPECT_LT(d.light, 1e-4);
    EXPECT_LT(d.error, 1e-4);
    EXPECT_LT(d.weight, 1e-4);
    EXPECT_EQ(drawn.pairs, cpu.pairs);
    EXPECT_EQ(drawn.turned, cpu.turned);
  }
}

TEST(GlGloss, FlatSurfaces) {
  const Gloss box{test::glossy_cornell()};
  expect_gl_as_cpu(box, box.records(60, 0.1f, 0.8f));
}

TEST(GlGloss, AllKindsOfLobes) {
  const Gloss box{many_materials()};
  expect_gl_as_cpu(box, box.records(200, 0.1f, 0.8f));
}

TEST(GlGloss, CurvedSurfaces) {
  const Gloss sphere{test::glossy_sphere().scene};
  expect_gl_as_cpu(sphere, sphere.records(40, 0.3f, 2));
}

TEST(GlGloss, FootprintsAmongDiscs) {
  const Gloss box{test::glossy_cornell()};
  std::vector<RadianceRecord> records = box.records(80, 0.2f, 0.8f);
  test::shape(records);
  expect_gl_as_cpu(box, records);
}

TEST(GlossSplat, LeavesAllElseAlone) {
  const Gloss box{test::glossy_cornell()};
  const GlossCache cache = box.cache(box.records(30, 0.2f, 3));
  const GlossBuffer drawn = box.draw(cache);
  std::size_t matt = 0;
  for (std::size_t i = 0; i < drawn.light.size(); ++i) {
    if (box.g.covered(i) && box.tables.order(static_cast<std::uint32_t>(box.g.albedo[i].w)) > 0) continue;
    ++matt;
    EXPECT_EQ(drawn.light[i], Vec4(0));
    EXPECT_EQ(drawn.error[i], Vec4(0));
  }
  EXPECT_GT(matt, 1000u);
  const GlossBuffer none = box.draw(box.cache({}));
  ASSERT_EQ(none.light.size(), box.g.position.size());
  for (const Vec4& v : none.light) EXPECT_EQ(v, Vec4(0));
}

TEST(GlossSplat, IsTheSameForAnyNumberOfThreads) {
  const Gloss box{test::glossy_cornell()};
  const GlossCache cache = box.cache(box.records(60, 0.1f, 0.8f));
  set_threads(1);
  const GlossBuffer one = box.draw(cache);
  set_threads(5);
  const GlossBuffer five = box.draw(cache);
  set_threads(0);
  EXPECT_EQ(0, std::memcmp(one.light.data(), five.light.data(), one.light.size() * sizeof(Vec4)));
  EXPECT_EQ(0, std::memcmp(one.error.data(), five.error.data(), one.error.size() * sizeof(Vec4)));
  EXPECT_EQ(one.pairs, five.pairs);
}

void expect_the_same_bits(bool shaped) {
#ifdef PHOS_SPLAT_AVX2
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  constexpr int kOrder = 7, kNumbers = 3 * kOrder * kOrder;
  RandomStream random(1, Stage::test, 0);
  const auto numbers = [&](std::size_t n) {
    std::vector<float> v(n);
    for (float& x : v) x = 2 * random.uniform() - 1;
    return v;
  };
  const auto lanes = [&](std::vector<GlossLane>& v) {
    for (GlossLane& lane : v)
      for (int k = 0; k < kGlossLanes; ++k) lane.of[k] = 2 * random.uniform() - 1;
  };
  const std::vector<float> light = numbers(kNumbers), x = numbers(kNumbers), y = numbers(kNumbers),
                           error = numbers(3 * kOrder);
  GlossSplat record{};
  record.inverse_radius = 0.7f, record.front_limit_m = -10, record.steepness_per_m = 1.3f;
  record.weight = 0.6f;
  if (shaped) {
    for (float& inverse : record.inverse) inverse = 0.5f + random.uniform();
    record.inverse_shortest = 2, record.per_radius = 1.2f;
  }
  record.normal[2] = record.x[0] = record.y[1] = 1;
  record.light = light.data(), record.gradient_x = x.data(), record.gradient_y = y.data(),
  record.stderr_light = error.data();
  std::vector<GlossLane> places(6), lobe(kNumbers), band[2] = {std::vector<GlossLane>(3 * kOrder), {}};
  lanes(places), lanes(lobe);
  band[1] = band[0];
  GlossGroup group[2] = {};
  GlossLane weight[2];
  const GlossKernel* const kernel[2] = {&gloss_kernel_plain, &gloss_kernel_avx2};
  for (int i = 0; i < 2; ++i) {
    GlossGroup& g = group[i];
    g.px = places[0], g.py = places[1], g.pz = places[2], g.nx = places[3], g.ny = places[4],
    g.nz = places[5];
    g.order = kOrder, g.lobe = lobe.data(), g.band_error = band[i].data();
    kernel[i]->weights(g, record, 0.2f, kLeastWeight, weight[i]);
    kernel[i]->add(g, record, weight[i]);
    record.steepness_per_m = 0;
    kernel[i]->add(g, record, weight[i]);
    record.steepness_per_m = 1.3f;
    kernel[i]->finish(g);
  }
  EXPECT_GT(group[0].error[3].of[0] + group[0].error[3].of[1] + group[0].error[3].of[2], 1);
  EXPECT_EQ(0, std::memcmp(&weight[0], &weight[1], sizeof weight[0]));
  EXPECT_EQ(0, std::memcmp(group[0].light, group[1].light, sizeof group[0].light));
  EXPECT_EQ(0, std::memcmp(group[0].error, group[1].error, sizeof group[0].error));
  EXPECT_EQ(0, std::memcmp(group[0].irradiance, group[1].irradiance, sizeof group[0].irradiance));
#else
  GTEST_SKIP() << "not an x86-64 build";
#endif
}

TEST(GlossSplat, KernelsGiveTheSameBits) { expect_the_same_bits(false); }
TEST(GlossSplat, KernelsGiveTheSameBitsOfFootprints) { expect_the_same_bits(true); }

}  // namespace
}  // namespace phos
