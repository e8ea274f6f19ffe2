// Every estimate of irradiance and radiance from 1e-6 to 1e6 m and from 1e-12 to 1e12 lm, and how far beyond.
#include <gtest/gtest.h>

#include "core/random.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "estimate/radiance_gather.h"
#include "record/footprint.h"
#include "record/tree.h"
#include "sense/sensors.h"
#include "support/daylight.h"
#include "support/gathered.h"
#include "support/luminaires.h"
#include "support/records.h"
#include "support/sweep.h"

namespace phos::test {
namespace {

Figures at_checks(const AnalyticScene& s, const Estimator& estimator) {
  Figures f;
  const auto worker = estimator.make_worker();
  for (std::size_t i = 0; i < s.checks.size(); ++i)
    f.record(estimator.make({s.checks[i].position, s.checks[i].normal, i}, *worker).record);
  return f;
}

EstimateOf by_photons(Estimate estimate, std::int64_t paths, Kernel kernel = Kernel::disc) {
  return [=](const AnalyticScene& s) {
    const Lit lit = light_up(s.scene, paths);
    RecordOptions options;
    options.paths = Quantity::all, options.estimate = estimate, options.kernel = kernel;
    options.resolve(s.scene.bounds.diagonal_m() / 4);
    return at_checks(s, DensityEstimator(lit.photons, *lit.rays, options, 1));
  };
}

TEST(ScaleSweep, PhotonsByHull) {
  sweep_scales("irradiance from photons, hull", furnace(0.5f), by_photons(Estimate::hull, 10000));
}

TEST(ScaleSweep, PhotonsByHullUnderALamp) {
  sweep_scales("irradiance from photons, hull, lit square", rectangle_light_parallel(),
               by_photons(Estimate::hull, 10000));
}

TEST(ScaleSweep, PhotonsByDisc) {
  sweep_scales("irradiance from photons, disc", furnace(0.5f), by_photons(Estimate::kernel, 10000));
}

TEST(ScaleSweep, PhotonsByKernel) {
  sweep_scales("irradiance from photons, kernel", furnace(0.5f),
               by_photons(Estimate::kernel, 10000, Kernel::epanechnikov));
}

TEST(ScaleSweep, Gather) {
  sweep_scales("irradiance by gathering rays", furnace(0.5f), [](const AnalyticScene& s) {
    const Gathered gathered(s.scene);
    const RecordTree tree = half_furnace_tree(s);
    const GatherSource source{.indirect = &tree};
    RecordOptions options = gather_options(s.scene, Quantity::all, -1, 256);
    return at_checks(s, GatherEstimator(gathered.rays, gathered.lights, source, options, 1));
  });
}

/// A lamp's light in them, which shortens their axes.
TEST(ScaleSweep, AdaptiveFootprints) {
  sweep_scales("records with adaptive footprints", rectangle_light_parallel(), [](const AnalyticScene& s) {
    const Gathered gathered(s.scene);
    RecordOptions options = gather_options(s.scene, Quantity::all, 1, 256);
    options.footprint = Footprint::adaptive;
    const GatherEstimator estimator(gathered.rays, gathered.lights, {}, options, 1);
    Figures f = at_checks(s, estimator);
    const auto worker = estimator.make_worker();
    const auto r = estimator.make({s.checks[0].position, s.checks[0].normal, 0}, *worker).record;
    for (const AdaptiveFootprint::Axis& a : r.footprint->axes()) {
      f.metres(static_cast<double>(a.length_m));
      for (const Rgb& lux : {a.slope, a.bend, a.turn_slope, a.turn_bend}) f.lux(lux, r.stderr_lx);
    }
    return f;
  });
}

/// Zones reach to a photon: rounding decides whether that one counts, of a hundred.
constexpr double kOnBorders = 0.05;

TEST(ScaleSweep, PlacementAndInterpolation) {
  sweep_scales("records placed and interpolated", uniform_box(0.5f),
               [](const AnalyticScene& s) {
                 const Lit lit = light_up(s.scene, 10000);
                 const RecordOptions options = all_light(s.scene);
                 IrradianceCache cache;
                 cache.accuracy = options.accuracy;
                 Counters counters;
                 place_at_photons(cache, lit.photons, *lit.rays, options, {.max_candidates = 400}, 1,
                                  counters);
                 RecordTree tree(s.scene.bounds, 0.5);
                 for (const IrradianceRecord& r : cache.records) tree.insert(r);
                 Figures f;
                 f.number(static_cast<double>(cache.records.size()));
                 for (const IrradianceRecord& r : cache.records) f.record(r);
                 const Vec3 size = s.scene.bounds.size();
                 for (std::uint64_t i = 0; i < 200; ++i) {
                   RandomStream random(3, Stage::test, i);
                   const Vec2 u = random.uniform2();
                   const Interpolated e = tree.interpolate({u.x * size.x, 0, u.y * size.z}, {0, 1, 0});
                   f.lux(e.irradiance, e.stderr_lx), f.lux(e.stderr_lx, e.stderr_lx),
                       f.number(static_cast<double>(e.weight));
                 }
                 return f;
               },
               {.decades = kOnBorders});
}

TEST(ScaleSweep, Sensors) {
  sweep_scales("illuminance at sensors", rectangle_light_parallel(), [](const AnalyticScene& s) {
    const RayScene rays(s.scene);
    const Luminaires lights(s.scene);
    IrradianceCache cache;
    cache.accuracy = 0.5;
    for (const Check& check : s.checks) {
      IrradianceRecord r;
      r.position = check.position, r.normal = check.normal;
      r.irradiance = Rgb(static_cast<float>(check.irradiance_lx)), r.stderr_lx = 0.01f * r.irradiance;
      r.radius_m = r.distance_m = 0.1f * s.scene.bounds.diagonal_m();
      cache.records.push_back(r);
    }
    Sensors sensors;
    for (const Check& check : s.checks) sensors.points.push_back({check.position, check.normal});
    // In free air, where rays make the record.
    for (const Check& check : s.checks)
      sensors.points.push_back({check.position + 0.02f * s.scene.bounds.diagonal_m() * check.normal,
                                glm::normalize(Vec3(1, 0.5f, 0.2f))});
    SensorCaches caches({}, nullptr);
    caches.add(cache, "made here");
    SensorOptions options;
    options.rays = 128, options.light_samples = 16;
    SensorReport report;
    Figures f;
    for (const Reading& r : read_light(sensors, rays, lights, caches, options, report))
      for (const float v : {r.illuminance_lx, r.stderr_lx, r.direct_lx, r.indirect_lx}) f.lux(Rgb(v));
    f.number(static_cast<double>(report.records_made)), f.number(static_cast<double>(report.uncovered));
    return f;
  });
}

TEST(ScaleSweep, RadianceRecords) {
  sweep_scales("radiance records", furnace(0.5f),
               [](const AnalyticScene& s) {
                 const Gathered gathered(s.scene);
                 const RecordTree tree = half_furnace_tree(s);
                 const GatherSource source{.indirect = &tree};
                 const RecordOptions options = gather_options(s.scene, Quantity::indirect, -1, 256);
                 const RadianceEstimator estimator(gathered.rays, gathered.lights, source, options, 6,
                                                   RadianceGradient::hybrid, 1);
                 const auto worker = estimator.make_worker();
                 Figures f;
                 for (std::size_t i = 0; i < s.checks.size(); ++i) {
                   const RadianceRecord r =
                       *estimator.make({s.checks[i].position, s.checks[i].normal, i}, *worker).radiance;
                   for (const float v : r.light) f.add(static_cast<double>(v), -2, 1);
                   for (const float v : r.stderr_light) f.add(static_cast<double>(v), -2, 1);
                   for (const float v : r.gradient_x) f.add(static_cast<double>(v), -3, 1);
                   for (const float v : r.gradient_y) f.add(static_cast<double>(v), -3, 1);
                   f.metres(static_cast<double>(r.radius_m)), f.metres(static_cast<double>(r.distance_m));
                 }
                 return f;
               },
               {.binades = 1e-6});  // slopes of 1e-32 are sums of terms that floats have few digits left for
}

Figures direct_light(const AnalyticScene& s) {
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  Figures f;
  for (std::size_t i = 0; i < s.checks.size(); ++i) {
    RandomStream random(1, Stage::test, i);
    const SurfacePoint at = receiver(s.scene, s.checks[i].position, s.checks[i].normal);
    const DirectIrradiance e = direct_irradiance(rays, lights, at, 64, random);
    f.lux(e.irradiance), f.lux(e.stderr_lx);
  }
  return f;
}

TEST(ScaleSweep, DirectLightOfASquare) {
  sweep_scales("direct light of a square lamp", rectangle_light_parallel(), direct_light);
}

TEST(ScaleSweep, DirectLightOfAPoint) {
  sweep_scales("direct light of a point", point_light_over_plane(), direct_light);
}

TEST(ScaleSweep, DirectLightOfMeasuredLuminaires) {
  sweep_scales("direct light of a measured luminaire", measured_point_over_plane(), direct_light);
  sweep_scales("direct light of a measured opening", measured_rectangle(), direct_light);
}

/// Through a window: lumens per area are what a sky's lux go with.
TEST(ScaleSweep, Daylight) {
  const auto estimate = [](Scale by) {
    AnalyticScene s;
    s.scene = room_with_window(0.5f);
    s.checks = {{{2.5f, 0, 3}, {0, 1, 0}, 0}, {{1, 0, 2}, {0, 1, 0}, 0}, {{2, 1, 0}, {0, 0, 1}, 0}};
    finalize(s.scene);
    AnalyticScene room = resized(s, {by.length, 1});
    surround(room.scene, sky_of("clear", "190,40", 10000 * by.of(-2, 1), 50000 * by.of(-2, 1)));
    Figures f = direct_light(room);
    for (const Figure& photon : by_photons(Estimate::hull, 20000)(room).all) f.all.push_back(photon);
    return f;
  };
  sweep_scales("daylight through a window", estimate);
}

/// The law says nothing of whether the value is right to begin with: closed forms at decades, and albedos.
TEST(ScaleSweep, ClosedFormsAtEveryAlbedo) {
  struct Case {
    float albedo;
    std::int64_t paths;
  };
  double worst = 0, tested = 0;
  for (const Case& c : {Case{0, 40000}, {0.5f, 20000}, {0.999f, 60}}) {
    for (const int size : {-20, 0, 20}) {
      const AnalyticScene s = resized(furnace(c.albedo), Scale::binades(size, 7));
      const Lit lit = light_up(s.scene, c.paths);
      const DensityEstimator maker(lit.photons, *lit.rays, all_light(s.scene), 1);
      double z2 = 0;
      for (const Check& check : s.checks) {
        const IrradianceRecord r = record_at(maker, check.position, check.normal);
        const double z =
            (static_cast<double>(r.irradiance.y) - s.mean_irradiance_lx) / static_cast<double>(r.stderr_lx.y);
        EXPECT_LT(std::fabs(z), 4.5) << "albedo " << c.albedo << ", 2^" << size << " m";
        z2 += z * z, worst = std::max(worst, std::fabs(z)), ++tested;
      }
    }
  }
  std::printf("greatest distance of %g estimates from the closed form: %.2f standard errors\n", tested,
              worst);
  expect_limit({"irradiance from photons", "albedo of a closed room", 0, 0.999, 0,
                "at 1 the mean is infinite: refused", true});
}

}  // namespace
}  // namespace phos::test
