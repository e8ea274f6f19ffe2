// Glossy reflection as harmonics, against closed forms, independent tables and fine quadrature.
#include <gtest/gtest.h>

#include <map>

#include "core/sampling.h"
#include "hsh/projection.h"
#include "hsh/rotation.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/table.h"
#include "scene/material/bsdf.h"
#include "support/golden_table.h"
#include "support/one_material.h"
#include "support/reflections.h"
#include "support/run.h"

namespace phos {
namespace {

using test::Reflection;
using test::view;

std::size_t at(int l, int m, std::size_t channel = 0) {
  return 3 * static_cast<std::size_t>(harmonic_index(l, m)) + channel;
}

double norm(std::span<const float> v) {
  double sum = 0;
  for (const float x : v) sum += static_cast<double>(x) * static_cast<double>(x);
  return std::sqrt(sum);
}

double distance(std::span<const float> a, std::span<const float> b) {
  std::vector<float> d(a.begin(), a.end());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
  return norm(d);
}

// f = 1/pi: f cos = z/pi, whose integral against H_0^0 = 1/sqrt(2 pi) is 1/sqrt(2 pi), and against H_1^0 =
// sqrt(3/(2 pi)) (2z - 1) it is 1/sqrt(6 pi). Its energy is the integral of z^2/pi^2, 2/(3 pi): order 2 is
// exact.
TEST(BrdfProjection, Lambert) {
  const HarmonicBasis<float> basis(6);
  const LobeProjection p =
      project_lobe([](const Vec3&) { return Rgb(1 / kPi); }, test::mirror_of(view(0)), basis);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(p.coefficients[at(0, 0, c)], 1 / std::sqrt(2 * kPi), 1e-6);
    EXPECT_NEAR(p.coefficients[at(1, 0, c)], 1 / std::sqrt(6 * kPi), 1e-6);
    for (int i = 0; i < basis.count(); ++i) {
      if (i == harmonic_index(0, 0) || i == harmonic_index(1, 0)) continue;
      EXPECT_NEAR(p.coefficients[3 * static_cast<std::size_t>(i) + c], 0, 1e-6) << i;
    }
  }
  EXPECT_NEAR(p.energy, 3 * 2 / (3 * std::numbers::pi), 1e-6);
  EXPECT_NEAR(p.albedo.x, 1, 1e-6);
  float error = 1;
  EXPECT_EQ(p.lowest_order(1e-5, error), 2);
  EXPECT_LT(error, 1e-6);
}

TEST(BrdfProjection, GoldenPhongLobes) {
  const auto rows = test::read_table(test::data("golden/hsh/phong_lobes_order10.csv"));
  ASSERT_EQ(rows.size(), 440u);
  const HarmonicBasis<float> basis(10);
  std::map<std::string, LobeProjection> lobes;
  for (const auto& row : rows) {
    const std::string& exponent = row.at("exponent");
    const std::string& tilt = row.at("tilt_deg");
    auto [found, added] = lobes.try_emplace(exponent + " " + tilt);
    if (added) {
      const Vec3 axis = view(std::stof(tilt));
      found->second = project_lobe(
          [&](const Vec3& wi) {
            return Rgb(std::pow(std::max(glm::dot(axis, wi), 0.f), std::stof(exponent)));
          },
          std::array{axis}, basis);
    }
    const LobeProjection& p = found->second;
    const double tolerance = 1e-4 * std::sqrt(p.energy / 3);
    const int l = std::stoi(row.at("l")), m = std::stoi(row.at("m"));
    EXPECT_NEAR(p.coefficients[at(l, m)], std::stod(row.at("coef")), tolerance) << found->first << l << m;
    if (m == 0) continue;
    EXPECT_NEAR(p.coefficients[at(l, -m)], 0, tolerance) << found->first << l << m;
  }
}

// Every model of a scene, from the normal to grazing, against a quadrature that knows
// nothing of lobes.
TEST(BrdfProjection, AgreesWithFineQuadrature) {
  const int order = 8;
  const Quadrature fine = hemisphere_quadrature(192, 384);
  const HarmonicBasis<float> basis(order);
  std::vector<float> harmonics(static_cast<std::size_t>(basis.count()));
  const std::vector<test::Named> models = test::models();
  for (std::size_t k = 0; k < models.size(); ++k) {
    const Scene scene = test::scene_of(models[k].material);
    const Bsdf bsdf(scene, std::uint32_t{0});
    if (!bsdf.has_gloss()) continue;
    const float angles[] = {0, 35, 70};
    const Vec3 wo = view(angles[k % 3], 25);
    const LobeProjection p =
        project_lobe([&](const Vec3& wi) { return bsdf.evaluate_gloss(wo, wi); }, test::mirror_of(wo), basis);
    std::vector<double> c(harmonics.size());
    double energy = 0;
    for (std::size_t q = 0; q < fine.size(); ++q) {
      const Vec3 wi(static_cast<float>(fine.x[q]), static_cast<float>(fine.y[q]),
                    static_cast<float>(fine.z[q]));
      const Rgb f = bsdf.evaluate_gloss(wo, wi) * wi.z;
      energy += static_cast<double>(glm::dot(f, f)) * fine.weight[q];
      basis.evaluate(BasisKind::hsh, wi.x, wi.y, wi.z, harmonics.data());
      for (std::size_t i = 0; i < c.size(); ++i)
        c[i] += static_cast<double>(f.y * harmonics[i]) * fine.weight[q];
    }
    double off = 0;
    for (std::size_t i = 0; i < c.size(); ++i)
      off += std::pow(static_cast<double>(p.coefficients[3 * i + 1]) - c[i], 2);
    EXPECT_TRUE(p.resolved) << models[k].name;
    // Both quadratures err: this one where lobes are narrow, that one where data have corners.
    EXPECT_LT(std::sqrt(off / energy), 1e-3) << models[k].name;
    EXPECT_NEAR(p.energy / energy, 1, 1e-3) << models[k].name;
  }
}

// Orders at 5 % of the energy (an independent program, within one order), theta 0 20 40 60 75 85; 0: none up
// to 10.
TEST(BrdfProjection, OrderSelection) {
  struct Case {
    const char* name;
    std::function<Reflection(const Vec3& wo)> f;
    int expected[6];
  };
  const auto phong = [](float e) { return [e](const Vec3& wo) { return test::phong_reflection(e, wo); }; };
  const auto ggx = [](float a) { return [a](const Vec3& wo) { return test::ggx_reflection(a, wo); }; };
  const Case cases[] = {
      {"phong 15", phong(15), {5, 5, 6, 6, 7, 7}},
      {"phong 22", phong(22), {6, 6, 6, 7, 8, 9}},
      {"phong 50", phong(50), {9, 9, 9, 10, 0, 0}},
      {"ward .6 .25",
       [](const Vec3& wo) { return test::ward_reflection(.6f, .25f, wo); },
       {4, 4, 5, 6, 9, 0}},
      {"ggx .3", ggx(.3f), {4, 4, 4, 7, 0, 0}},
      {"ggx .15", ggx(.15f), {7, 8, 9, 0, 0, 0}},
  };
  const float angles[] = {0, 20, 40, 60, 75, 85};
  const HarmonicBasis<float> basis(10);
  for (const Case& c : cases) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 wo = view(angles[k]);
      float error;
      const int order = project_lobe(c.f(wo), test::mirror_of(wo), basis).lowest_order(0.05, error);
      const int wanted = c.expected[k] == 0 ? 11 : c.expected[k];
      EXPECT_NEAR(order == 0 ? 11 : order, wanted, 1) << c.name << " at " << angles[k];
    }
  }
}

// What a table says it leaves out is what it leaves out.
TEST(BrdfTableTest, StatedErrorIsTheError) {
  Material ward = test::make_material(Model::ward, Rgb(0), Rgb(0.9f, 0.6f, 0.3f), 0.5f, 0.3f);
  const Scene scene = test::scene_of(ward);
  const Bsdf bsdf(scene, std::uint32_t{0});
  BrdfTableOptions options;
  options.resolution = 8;
  Counters counters;
  const BrdfTable table = project_brdf(scene, 0, options, counters);
  ASSERT_FALSE(table.isotropic);
  const Quadrature fine = hemisphere_quadrature(96, 192);
  const std::size_t stride = 3 * static_cast<std::size_t>(harmonic_count(table.order));
  int seen = 0;
  for (const std::size_t e : {27u, 28u, 18u, 45u, 10u}) {
    const int order = table.orders[e];
    if (order == 0) continue;
    ++seen;
    const HarmonicBasis<double> basis(order);
    std::vector<double> harmonics(static_cast<std::size_t>(basis.count()));
    double off = 0, energy = 0;
    for (std::size_t q = 0; q < fine.size(); ++q) {
      const Vec3 wi(static_cast<float>(fine.x[q]), static_cast<float>(fine.y[q]),
                    static_cast<float>(fine.z[q]));
      const Rgb f = bsdf.evaluate_gloss(table.direction(e), wi) * wi.z;
      basis.evaluate(BasisKind::hsh, fine.x[q], fine.y[q], fine.z[q], harmonics.data());
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < harmonics.size(); ++i)
          sum += static_cast<double>(table.coefficients[e * stride + 3 * i + c]) * harmonics[i];
        const auto value = static_cast<double>(f[static_cast<int>(c)]);
        off += (sum - value) * (sum - value) * fine.weight[q], energy += value * value * fine.weight[q];
      }
    }
    EXPECT_NEAR(off / energy, table.error[e], 1e-3) << e;
    EXPECT_LE(table.error[e], options.error);
  }
  EXPECT_GE(seen, 3);
}

// Under uniform light of luminance L, only c_00 sqrt(2 pi) L counts: what leaves is L times the albedo of the
// direction, whatever the order.
TEST(BrdfLookupTest, UniformLightGivesTheAlbedo) {
  BrdfTableOptions options;
  options.max_order = 6, options.error = 0.5;
  Material phong = test::make_material(Model::phong, Rgb(0.1f), Rgb(0.8f, 0.5f, 0.2f));
  phong.exponent = 10;
  const Material ward = test::make_material(Model::ward, Rgb(0), Rgb(0.8f, 0.5f, 0.2f), 0.6f, 0.3f);
  const HarmonicBasis<float> basis(4);
  for (const Material& material : {phong, ward}) {
    const Scene scene = test::scene_of(material);
    const Bsdf bsdf(scene, std::uint32_t{0});
    Counters counters;
    const BrdfTable table = project_brdf(scene, 0, options, counters);
    const BrdfLookup lookup(table);
    for (const int light_order : {1, 3, 9}) {
      std::vector<float> light(3 * static_cast<std::size_t>(harmonic_count(light_order)));
      const Rgb luminance_cd_m2(100, 50, 200);
      for (std::size_t c = 0; c < 3; ++c)
        light[c] = luminance_cd_m2[static_cast<int>(c)] * std::sqrt(2 * kPi);
      for (const Vec3& wo : {view(0), view(33, 70), view(65, -160)}) {
        ASSERT_GT(lookup.order(wo), 0);
        const LobeProjection exact = project_lobe([&](const Vec3& wi) { return bsdf.evaluate_gloss(wo, wi); },
                                                  test::mirror_of(wo), basis);
        const Rgb out = lookup.outgoing(wo, light), expected = luminance_cd_m2 * exact.albedo;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[c] / expected[c], 1, 4e-3) << wo.x << ' ' << wo.y;
      }
    }
  }
}

// Under any light, what leaves is the integral of f cos L. L is of order 4, so only the interpolation and the
// bands that the table leaves out can err.
TEST(BrdfLookupTest, OutgoingIsTheIntegral) {
  std::vector<float> light(3 * 16);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = r2_point(static_cast<int>(i), {0.5f, 0.5f}).x - (i < 3 ? -3.f : 0.5f);
  BrdfTableOptions options;
  options.error = 0.001, options.max_order = 15, options.resolution = 64;
  Material phong = test::make_material(Model::phong, Rgb(0), Rgb(0.9f, 0.6f, 0.3f));
  phong.exponent = 12;
  const Material ward = test::make_material(Model::ward, Rgb(0), Rgb(0.3f, 0.9f, 0.6f), 0.6f, 0.4f);
  const HarmonicBasis<float> basis(4);
  for (const Material& material : {phong, ward}) {
    const Scene scene = test::scene_of(material);
    const Bsdf bsdf(scene, std::uint32_t{0});
    Counters counters;
    const BrdfTable table = project_brdf(scene, 0, options, counters);
    EXPECT_EQ(table.isotropic, material.model == Model::phong);
    const BrdfLookup lookup(table);
    for (const Vec3& wo : {view(3, 12), view(30, 100), view(40, -77), view(50, 200)}) {
      ASSERT_GE(lookup.order(wo), 4);
      const LobeProjection exact = project_lobe([&](const Vec3& wi) { return bsdf.evaluate_gloss(wo, wi); },
                                                test::mirror_of(wo), basis);
      Rgb expected(0);
      for (std::size_t i = 0; i < light.size(); ++i)
        expected[static_cast<int>(i % 3)] += exact.coefficients[i] * light[i];
      const Rgb out = lookup.outgoing(wo, light);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(out[c], expected[c], 0.01f * expected[c]) << wo.x << ' ' << wo.y;
      // The coefficients of that direction say the same.
      const std::vector<float> own = lookup.coefficients(wo);
      Rgb summed(0);
      for (std::size_t i = 0; i < light.size(); ++i) summed[static_cast<int>(i % 3)] += own[i] * light[i];
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[c], summed[c], 1e-4f * summed[c]);
    }
  }
}

// An isotropic material sees no azimuth: turning view and light together changes nothing.
TEST(BrdfLookupTest, IsotropicTablesTurn) {
  Material phong = test::make_material(Model::phong, Rgb(0), Rgb(1));
  phong.exponent = 20;
  const Scene scene = test::scene_of(phong);
  Counters counters;
  const BrdfTable table = project_brdf(scene, 0, {}, counters);
  const BrdfLookup lookup(table);
  std::vector<float> light(3 * 49);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = r2_point(static_cast<int>(i), {0.1f, 0.5f}).y;
  const float reference = lookup.outgoing(view(50), light).x;
  for (const float degrees : {10.f, 90.f, 180.f, -135.f}) {
    std::vector<float> turned = light;
    rotate_about_z(turned, degrees * kPi / 180, 3);
    EXPECT_NEAR(lookup.outgoing(view(50, degrees), turned).x / reference, 1, 1e-4) << degrees;
  }
}

/// Tables of order 10 at `resolution` with every entry that `wo` needs, whatever its error.
BrdfTable grid_around(const Vec3& wo, int resolution, const std::function<Reflection(const Vec3& wo)>& f,
                      const HarmonicBasis<float>& basis) {
  BrdfTable table;
  table.isotropic = false, table.resolution = resolution, table.order = basis.order();
  const auto side = static_cast<std::size_t>(resolution),
             stride = 3 * static_cast<std::size_t>(basis.count());
  table.orders.assign(side * side, static_cast<std::uint8_t>(basis.order()));
  table.coefficients.assign(side * side * stride, 0);
  for (std::size_t e = 0; e < side * side; ++e) {
    const Vec3 d = table.direction(e);
    const Vec2 apart = Vec2(d.x, d.y) / (1 + d.z) - Vec2(wo.x, wo.y) / (1 + wo.z);
    const float width = 2.f / static_cast<float>(resolution);
    if (std::fabs(apart.x) > width || std::fabs(apart.y) > width) continue;
    const LobeProjection p = project_lobe(f(d), test::mirror_of(d), basis);
    std::copy(p.coefficients.begin(), p.coefficients.end(),
              table.coefficients.begin() + static_cast<std::ptrdiff_t>(e * stride));
  }
  return table;
}

// Bilinear interpolation of the coefficients on the parabolic grid errs by about 1/N^2; the means at N = 32
// are those of an independent program (25 other directions).
TEST(BrdfLookupTest, InterpolationError) {
  const HarmonicBasis<float> basis(10);
  struct Case {
    const char* name;
    std::function<Reflection(const Vec3& wo)> f;
    double mean;
  };
  const Case cases[] = {
      {"phong 5", [](const Vec3& wo) { return test::phong_reflection(5, wo); }, 0.005},
      {"phong 22", [](const Vec3& wo) { return test::phong_reflection(22, wo); }, 0.024},
      {"ward .2 .5", [](const Vec3& wo) { return test::bounded_ward_reflection(.2f, .5f, wo); }, 0.015},
  };
  for (const Case& c : cases) {
    std::map<int, double> mean;
    for (const int resolution : {16, 32}) {
      constexpr int kDirections = 25;
      for (int i = 0; i < kDirections; ++i) {
        const Vec2 p = 0.95f * sample_disc(r2_point(i, {0.3f, 0.6f}));
        const float r2 = glm::dot(p, p);
        const Vec3 wo = Vec3(2 * p.x, 2 * p.y, 1 - r2) / (1 + r2);
        const BrdfTable table = grid_around(wo, resolution, c.f, basis);
        const std::vector<float> exact = project_lobe(c.f(wo), test::mirror_of(wo), basis).coefficients;
        const std::vector<float> read = BrdfLookup(table).coefficients(wo);
        mean[resolution] += distance(read, exact) / norm(exact) / kDirections;
      }
    }
    EXPECT_NEAR(mean[32] / c.mean, 1, 0.35) << c.name;
    EXPECT_GT(mean[16] / mean[32], 2.8) << c.name;
    EXPECT_LT(mean[16] / mean[32], 5.2) << c.name;
  }
}

// Angles of an isotropic table are twice as near as those of the grid, and need no turning of the lobe.
TEST(BrdfLookupTest, IsotropicRowsInterpolateBetter) {
  Material phong = test::make_material(Model::phong, Rgb(0), Rgb(1));
  phong.exponent = 22;
  const Scene scene = test::scene_of(phong);
  Counters counters;
  BrdfTableOptions options;
  options.max_order = 16, options.error = 1e-3;
  const BrdfTable table = project_brdf(scene, 0, options, counters);
  const HarmonicBasis<float> basis(table.order);
  const BrdfLookup lookup(table);
  for (int i = 0; i < 25; ++i) {
    const Vec2 p = 0.8f * sample_disc(r2_point(i, {0.3f, 0.6f}));
    const float r2 = glm::dot(p, p);
    const Vec3 wo = Vec3(2 * p.x, 2 * p.y, 1 - r2) / (1 + r2);
    ASSERT_GT(lookup.order(wo), 0) << wo.z;
    const std::vector<float> exact =
        project_lobe(test::phong_reflection(22, wo), test::mirror_of(wo), basis).coefficients;
    // The bands left out are sqrt(1e-3) of the lobe.
    EXPECT_LT(distance(lookup.coefficients(wo), exact) / norm(exact), 0.035) << wo.z;
  }
}

}  // namespace
}  // namespace phos
