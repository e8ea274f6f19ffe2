// Every record estimate against every scene whose light is known in closed form (derivations:
// tests/support/scenes.h).
#include <gtest/gtest.h>

#include "support/records.h"

#include "record/tree.h"

namespace phos {
namespace {

/// Photon paths that leave about the same number of photons in each scene (a path lands 1/(1 - albedo)
/// times).
std::int64_t paths_for(const test::AnalyticScene& s) {
  const float albedo = s.scene.material[0].kd.x;
  return static_cast<std::int64_t>(400000 * std::max(0.02f, 1 - albedo));
}

/// |z| < 4.5 and a bias of at most 2 % (curvature of E over a zone, smooth shadows).
void expect_estimate(double value, double error, double truth, double scale, const std::string& what) {
  EXPECT_NEAR(value, truth, 4.5 * error + 0.02 * truth + 1e-6 * scale) << what << " +- " << error;
  EXPECT_LT(error, 0.2 * scale) << what;
}

class EveryScene : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EveryScene, RecordsAndInterpolationAgreeWithTheClosedForm) {
  const test::AnalyticScene s = std::move(test::all_point_scenes()[GetParam()]);
  const test::Lit lit = test::light_up(s.scene, paths_for(s));
  const RecordOptions options = test::all_light(s.scene);
  const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
  double scale = 0;
  for (const test::Check& check : s.checks) scale = std::max(scale, check.irradiance_lx);

  IrradianceCache cache;
  cache.accuracy = options.accuracy, cache.quantity = Quantity::all;
  Counters counters;
  const PlacementReport report =
      test::place_at_photons(cache, lit.photons, *lit.rays, options, {.max_candidates = 20000}, 1, counters);
  EXPECT_GT(report.kept, 4u);
  RecordTree tree(s.scene.bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);

  for (const test::Check& check : s.checks) {
    const std::string where = s.name + " at " + std::to_string(check.position.x) + " " +
                              std::to_string(check.position.y) + " " + std::to_string(check.position.z);
    const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
    expect_estimate(static_cast<double>(r.irradiance.y), static_cast<double>(r.stderr_lx.y),
                    check.irradiance_lx, scale, "record, " + where);
    const Interpolated i = tree.interpolate(check.position, check.normal);
    if (i.weight == 0) continue;  // dark sides have no photons and so no records
    expect_estimate(static_cast<double>(i.irradiance.y), static_cast<double>(i.stderr_lx.y),
                    check.irradiance_lx, scale, "interpolated, " + where);
  }
  int lit_checks = 0, covered = 0;
  for (const test::Check& check : s.checks) {
    if (check.irradiance_lx <= 0) continue;
    ++lit_checks, covered += tree.covered(check.position, check.normal);
  }
  EXPECT_GE(covered, lit_checks - 1) << s.name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, ::testing::Range<std::size_t>(0, 10));

/// Closed rooms of which only the mean is known: the mean over the photons' places, each standing for an
/// equal area.
TEST(ClosedRoom, AreaMeanOfInterpolatedIrradiance) {
  for (const test::AnalyticScene& s : {test::uniform_box(0.5f), test::integrating_sphere(0.5f, 1280)}) {
    const test::Lit lit = test::light_up(s.scene, 200000);
    const RecordOptions options = test::all_light(s.scene);
    IrradianceCache cache;
    cache.accuracy = options.accuracy;
    Counters counters;
    test::place_at_photons(cache, lit.photons, *lit.rays, options, {}, 1, counters);
    RecordTree tree(s.scene.bounds, cache.accuracy);
    for (const IrradianceRecord& r : cache.records) tree.insert(r);
    double sum = 0, weight = 0, missed = 0;
    for (std::uint32_t t = 0; t < s.scene.triangle.size(); ++t) {
      const auto& v = s.scene.triangle[t].v;
      const Vec3 a = s.scene.position[v[0]], b = s.scene.position[v[1]], c = s.scene.position[v[2]];
      const int n = s.scene.triangle.size() > 100 ? 4 : 4000;
      for (int i = 0; i < n; ++i) {
        const float u = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(n));
        const float w = u * std::fmod(static_cast<float>(i) * 0.618034f, 1.f);
        const Vec3 q = (1 - u) * a + (u - w) * b + w * c;
        const Interpolated e = tree.interpolate(q, geometric_normal(s.scene, t));
        const double area = static_cast<double>(area_m2(s.scene, t)) / n;
        if (e.weight == 0) {
          missed += area;
          continue;
        }
        sum += area * static_cast<double>(e.irradiance.y), weight += area;
      }
    }
    EXPECT_LT(missed, 0.03 * s.area_m2) << s.name;
    EXPECT_NEAR(sum / weight / s.mean_irradiance_lx, 1, 0.02) << s.name;
  }
}

/// dE/dx of a point light over a plane, E = I h (h2 + x2)^-1.5, is -3 x E / (h2 + x2); turning the receiver
/// about the z axis by t changes E by (n' . w - n . w) I / d2.
TEST(PointLight, GradientsAgreeWithTheClosedForm) {
  const test::AnalyticScene s = test::point_light_over_plane();
  const test::Lit lit = test::light_up(s.scene, 800000);
  RecordOptions options = test::all_light(s.scene);
  options.max_photons = 4000;
  const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
  for (const float x : {0.5f, 1.f, 1.5f}) {
    const IrradianceRecord r = test::record_at(maker, {x, 0, 0}, {0, 1, 0});
    const double e = s.irradiance_lx({x, 0, 0}, {0, 1, 0}), d2 = 4 + double(x) * double(x);
    EXPECT_NEAR(r.translation_gradient[0].x, -3 * double(x) * e / d2, 0.06 * e) << x;
    EXPECT_NEAR(r.translation_gradient[0].z, 0, 0.06 * e) << x;
    EXPECT_NEAR(r.translation_gradient[0].y, 0, 1e-4 * e) << x;
    const float t = 0.05f;
    const Vec3 tilted(std::sin(t), std::cos(t), 0);
    const Vec3 w = glm::normalize(Vec3(-x, 2, 0));
    const double exact = e / static_cast<double>(w.y) * static_cast<double>(glm::dot(tilted, w));
    EXPECT_NEAR(extrapolate(r, r.position, tilted).y - r.irradiance.y, exact - e,
                0.25 * std::fabs(exact - e) + 0.003 * e);
  }
}

/// The furnace is the same everywhere: gradients vanish, for each way of making them.
TEST(Furnace, HasNoGradient) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const test::Lit lit = test::light_up(s.scene, 300000);
  for (const GradientMode mode : {GradientMode::analytic, GradientMode::hemisphere, GradientMode::none}) {
    RecordOptions options = test::all_light(s.scene);
    options.max_photons = 4000, options.min_photons = 2000, options.gradients = mode;
    const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
    for (const test::Check& check : s.checks) {
      const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
      const float limit = mode == GradientMode::none ? 0 : 0.3f * r.irradiance.y;
      EXPECT_LE(glm::length(r.translation_gradient[1]), limit);
      EXPECT_LE(glm::length(r.rotation_gradient[1]), limit);
    }
  }
}

/// Right up to the edge of a surface and into its corners, nothing is lost or gained.
TEST(Border, CorrectedAreaHasNoBias) {
  const test::AnalyticScene s = test::emitting_environment();
  const test::Lit lit = test::light_up(s.scene, 3000000);
  const RecordOptions options = test::all_light(s.scene);
  const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  const Vec3 n = glm::normalize(glm::cross(v, u));
  double sum = 0, variance = 0, count = 0;
  for (const float a : {-0.499f, -0.49f, -0.45f, 0.f, 0.47f, 0.499f}) {
    for (const float b : {-0.499f, -0.4f, 0.1f, 0.495f}) {
      for (const float side : {1.f, -1.f}) {
        const IrradianceRecord r = test::record_at(maker, a * u + b * v, side * n);
        const double z = static_cast<double>((r.irradiance.y - 100 * kPi) / r.stderr_lx.y);
        EXPECT_LT(std::fabs(z), 4.5) << a << " " << b << ": " << r.irradiance.y << " +- " << r.stderr_lx.y;
        sum += static_cast<double>(r.irradiance.y), count += 1;
        variance += static_cast<double>(r.stderr_lx.y) * static_cast<double>(r.stderr_lx.y);
      }
    }
  }
  // Neighbouring zones share photons: about four of these records stand for one.
  EXPECT_NEAR(sum / count, 100 * std::numbers::pi, 4 * 2 * std::sqrt(variance) / count + 1);
}

}  // namespace
}  // namespace phos
