// Coefficients of radiance and their gradients against closed forms: surfaces whose light is known from every
// place, and closed rooms where the same light comes from everywhere.
#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "record/tree.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "support/gathered.h"
#include "support/radiance_scenes.h"

namespace phos {
namespace {

constexpr int kOrder = 6;
const double kEven = std::sqrt(2 * std::numbers::pi);  // c_00 of radiance 1 in every direction

/// Nothing is in the way, so that the derivative of each ray's term is that of the whole: against finite
/// differences of projections from displaced places, which know nothing of hits.
TEST(Gradients, EqualFiniteDifferences) {
  const Quadrature fine = hemisphere_quadrature(80, 160);
  for (const test::RadianceScene& scene : test::radiance_scenes()) {
    const Hemisphere h = scene.seen(fine);
    RadianceProjector projector(kOrder);
    const RadianceRecord exact = projector.project(h, RadianceGradient::analytic, 0);
    const RadianceRecord moved = projector.project(h, RadianceGradient::numeric, 0);
    const std::vector<double> truth = scene.coefficients(DVec3(0), kOrder, fine);
    EXPECT_LT(test::distance(test::channel(exact.light), truth), 1e-6 * test::norm(truth)) << scene.name;
    for (const int axis : {0, 1}) {
      const auto at = [&](const DVec3& p) { return scene.coefficients(p, kOrder, fine); };
      const std::vector<double> slope = test::slope_along(axis, 1e-3, at);
      const double scale = test::norm(slope) + 1e-2 * test::norm(truth);  // 1/m: even light has no slope
      EXPECT_LT(test::distance(test::channel(axis == 0 ? exact.gradient_x : exact.gradient_y), slope),
                2e-5 * scale)
          << scene.name << ", analytic, axis " << axis;
      EXPECT_LT(test::distance(test::channel(axis == 0 ? moved.gradient_x : moved.gradient_y), slope),
                5e-4 * scale)
          << scene.name << ", numeric, axis " << axis;
    }
  }
}

/// A lit ball in front of the dark: no light moves at its silhouette, where it is seen edge on, but the
/// cosine that divides the terms there is bounded, which costs little.
TEST(Gradients, OfABallSeenFromOutside) {
  const DVec3 centre(0.8, 0.3, 1.5);
  const double radius = 0.4;
  const Quadrature around = sphere_quadrature(400, 400);
  const HarmonicBasis<double> basis(kOrder);
  const auto seen = [&](const DVec3& p, const auto& use) {
    for (std::size_t i = 0; i < around.size(); ++i) {
      const DVec3 n(around.x[i], around.y[i], around.z[i]), step = centre + radius * n - p;
      const double d = glm::length(step), cosine = -glm::dot(n, step) / d;
      if (cosine > 0) use(step / d, d, n, around.weight[i] * radius * radius * cosine / (d * d));
    }
  };
  const auto coefficients = [&](const DVec3& p) {
    std::vector<double> sum(static_cast<std::size_t>(basis.count())), value(sum);
    seen(p, [&](const DVec3& w, double, const DVec3&, double sr) {
      basis.evaluate(BasisKind::hsh, w.x, w.y, w.z, value.data());
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sr * value[i];
    });
    return sum;
  };
  Hemisphere h;
  seen(DVec3(0), [&](const DVec3& w, double d, const DVec3& n, double sr) {
    h.direction.push_back(Vec3(w)), h.distance_m.push_back(static_cast<float>(d));
    h.hit_normal.push_back(Vec3(n)), h.radiance.push_back(Rgb(1));
    h.projected_sr.push_back(static_cast<float>(sr * w.z));
  });
  RadianceProjector projector(kOrder);
  const RadianceRecord record = projector.project(h, RadianceGradient::analytic, 0);
  for (const int axis : {0, 1}) {
    const std::vector<double> slope = test::slope_along(axis, 0.02, coefficients);
    EXPECT_LT(test::distance(test::channel(axis == 0 ? record.gradient_x : record.gradient_y), slope),
              0.01 * test::norm(slope));
  }
}

/// In a furnace the same light comes from everywhere: one coefficient, no gradient, no noise but that of the
/// strata; and the irradiance of the very same rays.
TEST(Furnace, OneCoefficientIsAll) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 4096);
  const RecordTree all = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, 2);  // M / (1 - rho)
  const GatherSource source{.indirect = &all, .holds_direct = true};
  const double radiance = 1 / std::numbers::pi;  // rho E / pi
  for (const auto mode : {RadianceGradient::analytic, RadianceGradient::hybrid, RadianceGradient::numeric}) {
    const RadianceEstimator estimator(rays, lights, source, options, 10, mode, 1);
    const auto worker = estimator.make_worker();
    for (std::uint64_t i = 0; i < s.checks.size(); ++i) {
      const RadianceRecord r =
          *estimator.make({s.checks[i].position, s.checks[i].normal, i}, *worker).radiance;
      std::vector<double> rest = test::channel(r.light);
      const auto stated = test::channel(r.stderr_light);
      EXPECT_NEAR(rest[0], radiance * kEven, 1e-5);
      rest[0] = 0;
      double variance = 0;
      for (std::size_t l = 0; l < stated.size(); ++l)
        variance += static_cast<double>(2 * l + 1) * stated[l] * stated[l];
      EXPECT_LT(test::norm(rest), 1.2 * std::sqrt(variance));
      EXPECT_LT(test::norm(rest), 0.15 * radiance * kEven);
      EXPECT_NEAR(irradiance_of(r).irradiance.y, 1, 2e-3f);
      EXPECT_NEAR(irradiance_of(r).irradiance.y, irradiance_of(RadianceEstimator::seen(*worker)).y, 1e-5f);
      EXPECT_GE(r.radius_m, *options.min_radius_m);
      EXPECT_LE(r.radius_m, *options.max_radius_m);
    }
  }
}

/// The irradiance that a radiance record holds is that of irradiance records, of other rays.
TEST(Irradiance, EqualsThatOfIrradianceRecords) {
  const test::AnalyticScene s = test::uniform_box(0.5f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 1024);
  const RadianceEstimator estimator(g.rays, g.lights, {}, options, 5, RadianceGradient::analytic, 1);
  const auto worker = estimator.make_worker();
  for (const Vec3& p : {Vec3(0.5f, 0, 0.4f), Vec3(1.9f, 0, 1.4f)}) {
    double sums[2] = {}, variance = 0;
    constexpr std::uint64_t kTimes = 40;
    for (const IrradianceRecord& r : g.records(p, {0, 1, 0}, options, {}, kTimes)) {
      sums[0] += static_cast<double>(r.irradiance.y);
      variance += static_cast<double>(r.stderr_lx.y) * static_cast<double>(r.stderr_lx.y);
    }
    for (std::uint64_t i = 0; i < kTimes; ++i) {
      const IrradianceRecord r = estimator.make({p, {0, 1, 0}, i}, *worker).record;
      sums[1] += static_cast<double>(r.irradiance.y);
      variance += static_cast<double>(r.stderr_lx.y) * static_cast<double>(r.stderr_lx.y);
    }
    EXPECT_NEAR(sums[0], sums[1], 3.5 * std::sqrt(variance));
    EXPECT_LT(std::sqrt(variance), 0.01 * sums[0]);
  }
}

}  // namespace
}  // namespace phos
