// Radiance from photons against closed forms: light of few bands, luminous surfaces, lit rooms.
#include "estimate/radiance_density.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "estimate/radiance_gather.h"
#include "place/two_level.h"
#include "scene/lamp/luminaires.h"
#include "support/gathered.h"
#include "support/photon_lobes.h"
#include "support/records.h"

namespace phos {
namespace {

const double kEven = std::sqrt(2 * std::numbers::pi);  // c_00 of radiance 1 in every direction

/// What the photons of a quadrature of the hemisphere are to a disc of 1 m2, for light as seen from its
/// middle.
ZonePhotons photons_of(const Hemisphere& h) {
  ZonePhotons zone;
  for (std::size_t i = 0; i < h.size(); ++i) {
    zone.offset_m.emplace_back(0), zone.flux_lm.push_back(h.radiance[i] * h.projected_sr[i]);
    zone.direction.push_back(h.direction[i]), zone.inverse_distance.push_back(1 / h.distance_m[i]);
    zone.source_normal.push_back(h.hit_normal[i]);
  }
  return zone;
}
RadianceRecord project(const ZonePhotons& zone, int order, RadianceGradient mode,
                       const Vec2& step = Vec2(0)) {
  const std::vector<std::uint8_t> used(zone.size(), 1);
  return PhotonProjector(order).project(zone, used, 1, 0, step, Frame(), mode);
}

TEST(CosineFit, LightOfFewBandsIsExact) {
  const Quadrature q = hemisphere_quadrature(80, 160);
  for (const int order : {1, 2, 3, 7, 10, 30}) {
    const auto count = static_cast<std::size_t>(harmonic_count(order));
    std::vector<double> truth(count);
    RandomStream random(41, Stage::test, static_cast<std::uint64_t>(order));
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 16 == 0) random.start_bounce(static_cast<std::uint32_t>(i / 16));
      truth[i] = random.uniform_double() - 0.5;
    }
    const std::vector<double> moments =
        project([&](double x, double y, double z) { return z * reconstruct(truth, BasisKind::hsh, x, y, z); },
                BasisKind::hsh, order, q);
    EXPECT_LT(test::distance(test::fitted(moments, order), truth), 1e-10 * test::norm(truth)) << order;
  }
}

/// Light of any bands: the irradiance is that of the moments, E = sqrt(2 pi) b_00.
TEST(CosineFit, KeepsIrradiance) {
  for (const int order : {1, 2, 6, 10}) {
    std::vector<double> moments(static_cast<std::size_t>(harmonic_count(order)));
    for (std::size_t i = 0; i < moments.size(); ++i) moments[i] = 1 / (1.0 + static_cast<double>(i * i));
    const std::vector<double> c = test::fitted(moments, order);
    const double second = order > 1 ? std::sqrt(std::numbers::pi / 6) * c[2] : 0;
    EXPECT_NEAR(std::sqrt(std::numbers::pi / 2) * c[0] + second, kEven * moments[0], 1e-12) << order;
  }
}

TEST(PhotonProjector, EvenLightIsOneCoefficient) {
  const Quadrature q = hemisphere_quadrature(40, 80);
  const test::RadianceScene sky{"sky", [](const DVec3&, const DVec3&) {
                                  return test::Seen{HUGE_VAL, {}, 2};
                                }};
  const RadianceRecord r = project(photons_of(sky.seen(q)), 10, RadianceGradient::analytic);
  std::vector<double> light = test::channel(r.light);
  EXPECT_NEAR(light[0], 2 * kEven, 1e-5);
  light[0] = 0;
  EXPECT_LT(test::norm(light), 3e-5) << "the rounding of floats, times what the fit makes of it";
  EXPECT_EQ(test::norm(test::channel(r.gradient_x)), 0) << "from infinitely far";
  EXPECT_NEAR(irradiance_of(r).irradiance.y, 2 * kPi, 1e-5f);
}

/// Light, its fit and the slopes of that, against finite differences of projections from displaced places,
/// which know nothing of photons. The cosine of sources is bounded, which shows where they are seen edge on.
TEST(PhotonProjector, GradientsEqualFiniteDifferences) {
  constexpr int kOrder = 6;
  const Quadrature fine = hemisphere_quadrature(80, 160);
  for (const test::RadianceScene& scene : test::radiance_scenes()) {
    const ZonePhotons zone = photons_of(scene.seen(fine));
    const auto at = [&](const DVec3& p) {
      const auto weighted = [&](double x, double y, double z) {
        return z * scene.look(p, {x, y, z}).luminance;
      };
      return test::fitted(project(weighted, BasisKind::hsh, kOrder, fine), kOrder);
    };
    const std::vector<double> truth = at(DVec3(0));
    const RadianceRecord exact = project(zone, kOrder, RadianceGradient::analytic),
                         moved = project(zone, kOrder, RadianceGradient::numeric);
    EXPECT_LT(test::distance(test::channel(exact.light), truth), 1e-5 * test::norm(truth)) << scene.name;
    for (const int axis : {0, 1}) {
      const std::vector<double> slope = test::slope_along(axis, 1e-3, at),
                                a = test::channel(axis == 0 ? exact.gradient_x : exact.gradient_y),
                                b = test::channel(axis == 0 ? moved.gradient_x : moved.gradient_y);
      const double scale = test::norm(slope) + 1e-2 * test::norm(truth);
      EXPECT_LT(test::distance(a, slope), 2e-4 * scale) << scene.name << ", analytic, axis " << axis;
      EXPECT_LT(test::distance(b, slope), 2e-3 * scale) << scene.name << ", numeric, axis " << axis;
      EXPECT_LT(test::distance(a, b), 2e-3 * scale) << scene.name << ", axis " << axis;
    }
    // A place a little aside has the light that the slopes say.
    const RadianceRecord aside = project(zone, kOrder, RadianceGradient::analytic, Vec2(2e-3f, -1e-3f));
    EXPECT_LT(test::distance(test::channel(aside.light), at({2e-3, -1e-3, 0})),
              2e-5 * test::norm(truth) + 1e-5 * test::norm(test::channel(exact.gradient_x)))
        << scene.name;
  }
}

RecordOptions resolved(const Scene& scene) {
  RecordOptions options;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

/// Records at places of a scene, from photons.
struct Places {
  Places(const test::Lit& lit, int order)
      : estimator(lit.photons, *lit.rays, resolved(*lit.scene), order, RadianceGradient::analytic, 1),
        worker(estimator.make_worker()) {}
  RadianceRecord at(const Vec3& p, const Vec3& n, std::uint64_t item) {
    const Made made = estimator.make({p, n, item}, *worker);
    EXPECT_EQ(made.record.irradiance, irradiance_of(*made.radiance).irradiance);
    return *made.radiance;
  }
  RadianceDensityEstimator estimator;
  std::unique_ptr<Estimator::Worker> worker;
};

/// In a furnace the same light comes from everywhere, but for what the walls themselves emit: rho M / (1 -
/// rho) / pi.
TEST(RadianceDensity, Furnace) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const test::Lit lit = test::light_up(s.scene, 200'000);
  Places places(lit, 10);
  const double radiance = 1 / std::numbers::pi;
  double z2 = 0, count = 0;
  for (std::uint64_t i = 0; i < s.checks.size(); ++i) {
    const RadianceRecord r = places.at(s.checks[i].position, s.checks[i].normal, i);
    EXPECT_NEAR(irradiance_of(r).irradiance.y, 1, 4 * irradiance_of(r).stderr_lx.y);
    for (const test::NamedLobe& lobe : test::glossy_lobes()) {
      const std::vector<double> c = test::coefficients(lobe, 10);
      const double z =
          (test::through(c, test::channel(r.light)) - radiance * kEven * c[0]) / test::stated(c, r);
      EXPECT_LT(std::fabs(z), 4) << lobe.name;
      z2 += z * z, count += 1;
    }
  }
  EXPECT_NEAR(z2 / count, 1, 0.5);
}

/// A wall that a lamp lights, over a black floor: L = rho E / pi of each point of it, E = I cos / d2, by
/// quadrature over the wall. Through lobes, and the coefficients fit the same way.
TEST(RadianceDensity, BesideALitWall) {
  const Vec3 lamp(1, 0.7f, 0.2f);
  const float intensity = 100, albedo = 0.8f;
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "black", 0));
  test::add_quad(scene, {0, 0, -2}, {0, 0, 4}, {3, 0, 0});
  test::begin_instance(scene, "wall", test::add_lambert(scene, "white", albedo));
  test::add_quad(scene, {0, 0, -2}, {0, 2, 0}, {0, 0, 4});
  test::add_point_light(scene, lamp, intensity);
  finalize(scene);
  const test::Lit lit = test::light_up(scene, 1'000'000);
  constexpr int kOrder = 8;
  Places places(lit, kOrder);
  // Local axes of the floor.
  const Frame frame = make_frame({0, 1, 0});
  const auto moments = [&](const Vec3& p) {
    std::vector<double> node, weight, sum(kOrder * kOrder), value(sum);
    gauss_legendre(64, node, weight);
    const HarmonicBasis<double> basis(kOrder);
    for (std::size_t i = 0; i < node.size(); ++i) {
      for (std::size_t j = 0; j < node.size(); ++j) {
        const double t = 0.5 + 0.5 * node[i];  // harmonics are smooth in the root of the height
        const Vec3 q(0, static_cast<float>(2 * t * t), static_cast<float>(2 * node[j]));
        const DVec3 to(lamp - q), step(q - p);
        const double d2 = glm::dot(to, to), r2 = glm::dot(step, step), r = std::sqrt(r2);
        const double light =
            static_cast<double>(albedo * intensity) / std::numbers::pi * to.x / (d2 * std::sqrt(d2));
        const Vec3 w = frame.to_local(Vec3(step / r));
        basis.evaluate(BasisKind::hsh, double(w.x), double(w.y), double(w.z), value.data());
        const double area = 0.25 * weight[i] * weight[j] * 8 * 2 * t;
        const double flux = light * area * (-step.x / r) * (step.y / r) / r2;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += flux * value[k];
      }
    }
    return sum;
  };
  double squares = 0, expected = 0, seen = 0;
  std::uint64_t item = 0;
  for (const Vec3& p : {Vec3(0.6f, 0, 0), Vec3(1, 0, 0.5f), Vec3(1.2f, 0, -0.4f), Vec3(1.6f, 0, 0.1f)}) {
    const std::vector<double> b = moments(p), truth = test::fitted(b, kOrder);
    const RadianceRecord r = places.at(p, {0, 1, 0}, item++);
    const IrradianceRecord e = irradiance_of(r);
    EXPECT_NEAR(static_cast<double>(e.irradiance.y), kEven * b[0], 4 * static_cast<double>(e.stderr_lx.y))
        << p.x;
    EXPECT_EQ(r.frame.x, frame.x);
    for (const float azimuth : {20.f, 110.f, 200.f, 290.f}) {
      for (const test::NamedLobe& lobe : test::glossy_lobes(azimuth)) {
        const std::vector<double> c = test::coefficients(lobe, kOrder);
        const double light = test::through(c, truth), off = test::through(c, test::channel(r.light)) - light;
        squares += off * off, expected += test::stated(c, r) * test::stated(c, r), seen += light * light;
      }
    }
  }
  // Lobes that see the wall have more noise than is stated, the others less.
  EXPECT_NEAR(squares / expected, 1, 0.7);
  EXPECT_LT(squares / seen, 0.1 * 0.1);
}

/// The light of a Cornell box by photons and by gathered rays, at places on all walls.
TEST(RadianceDensity, AgreesWithGatheredRays) {
  const test::Lit lit = test::light_up(test::cornell(), 300'000);
  constexpr int kOrder = 7;
  Places places(lit, kOrder);
  const Luminaires lights(*lit.scene);
  const RecordOptions options = test::gather_options(*lit.scene, Quantity::indirect, -1, 1024);
  const CoarseLevel coarse(*lit.rays, lit.photons, options, 1);
  const RadianceEstimator gather(*lit.rays, lights, coarse.source(), options, kOrder, RadianceGradient::none,
                                 1);
  const auto worker = gather.make_worker();
  std::vector<std::vector<double>> lobes;
  for (const test::NamedLobe& lobe : test::glossy_lobes()) lobes.push_back(test::coefficients(lobe, kOrder));
  double squares = 0, expected = 0, seen = 0, of_sums = 0, sums[2] = {};
  const Vec3 above_the_blocks(0.28f, 0.45f, 0.28f);
  int places_left = 60;
  for (std::uint64_t i = 0; places_left > 0; ++i) {
    RandomStream random(1, Stage::test, i);
    SurfacePoint point;
    const Vec3 along = sample_uniform_sphere(random.uniform2());
    if (!trace(*lit.rays, {above_the_blocks, along}, point)) continue;
    --places_left;
    const RecordSite site{point.position, point.smooth_normal, i};
    const RadianceRecord a = places.at(site.position, site.normal, i),
                         b = *gather.make(site, *worker).radiance;
    double here = 0;
    for (const std::vector<double>& lobe : lobes) {
      const double by_photons = test::through(lobe, test::channel(a.light)),
                   by_rays = test::through(lobe, test::channel(b.light));
      const double error = std::hypot(test::stated(lobe, a), test::stated(lobe, b));
      squares += (by_photons - by_rays) * (by_photons - by_rays), expected += error * error;
      seen += by_rays * by_rays;
      sums[0] += by_photons, sums[1] += by_rays, here += error;
    }
    of_sums += here * here;
  }
  EXPECT_NEAR(sums[0], sums[1], 3 * std::sqrt(of_sums));
  EXPECT_LT(std::sqrt(of_sums), 0.03 * sums[1]);
  // Lobes that look away from the light have less noise than is stated.
  EXPECT_LT(squares / expected, 1.3);
  EXPECT_GT(squares / expected, 0.1);
  EXPECT_LT(squares / seen, 0.15 * 0.15);
}

}  // namespace
}  // namespace phos
