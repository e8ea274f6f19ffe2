// Radiance records by drawing the hemisphere, against closed forms and against gathered rays
// (docs/methods.md#r2).
#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "record/tree.h"
#include "splat/raster/radiance_raster.h"
#include "support/gathered.h"
#include "support/radiance_scenes.h"
#include "support/raster.h"

namespace phos::test {
namespace {

const double kEven = std::sqrt(2 * std::numbers::pi);

RadianceRecord record_at(const Estimator& estimator, const RecordSite& site) {
  const auto worker = estimator.make_worker();
  return *estimator.make(site, *worker).radiance;
}

/// In a furnace the same light comes from everywhere: one coefficient is all, and it has no gradient.
TEST(RadianceRaster, InAFurnaceOneCoefficientIsAll) {
  const AnalyticScene s = furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordTree all = uniform_tree(Vec3(0), {2, 1, 1.5f}, 2);
  const GatherSource source{.indirect = &all, .holds_direct = true};
  RecordOptions options = gather_options(s.scene, Quantity::indirect, -1, 4096);
  const double radiance = 1 / std::numbers::pi;  // rho E / pi
  for (const int side : {16, 64}) {
    options.raster_side = side;
    const RadianceRasterEstimator estimator(rays, lights, source, options, 10, RadianceGradient::analytic, 1);
    EXPECT_TRUE(estimator.one_thread());
    for (std::uint64_t i = 0; i < s.checks.size(); ++i) {
      const RadianceRecord r = record_at(estimator, {s.checks[i].position, s.checks[i].normal, i});
      std::vector<double> rest = channel(r.light);
      EXPECT_NEAR(rest[0], radiance * kEven, 1e-4 * radiance * kEven);
      rest[0] = 0;
      EXPECT_LT(norm(rest), 0.004 * radiance * kEven);
      EXPECT_NEAR(irradiance_of(r).irradiance.y, 1, 2e-3f);
      EXPECT_EQ(r.stderr_light, std::vector<float>(30, 0));
      EXPECT_GT(r.radius_m, 0);
      EXPECT_LE(r.radius_m, *options.max_radius_m);
    }
  }
}

/// A floor beside a lit wall that stands on it, nothing else: light down to the horizon, the same all over
/// the wall. Stretched pixels show the same as rays, but for their noise, the wall's far ends and half a
/// pixel at its top; pixels without a border do not.
TEST(RadianceRaster, AWallOnTheFloorAgreesWithRays) {
  constexpr float kDistance = 1, kHalfWidth = 20, kHeight = 20, kLux = 1000, kAlbedo = 0.8f;
  constexpr int kOrder = 6;
  Scene scene;
  begin_instance(scene, "wall", add_lambert(scene, "wall", kAlbedo));
  add_quad(scene, {-kHalfWidth, 0, 0}, {2 * kHalfWidth, 0, 0}, {0, kHeight, 0});
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = {0, 0, -1};
  sun.intensity = Rgb(kLux);
  scene.light.push_back(sun);
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordSite site{{0, 0, kDistance}, {0, 1, 0}, 1};
  const RadianceEstimator gather(rays, lights, {}, raster_options(scene, Estimate::gather), kOrder,
                                 RadianceGradient::none, 1);
  const RadianceRecord of_rays = record_at(gather, site);
  const std::vector<double> truth = channel(of_rays.light), stated = channel(of_rays.stderr_light);
  double variance = 0;
  for (std::size_t l = 0; l < stated.size(); ++l)
    variance += static_cast<double>(2 * l + 1) * stated[l] * stated[l];
  double off[3];
  for (const RasterBorder border : {RasterBorder::none, RasterBorder::coverage, RasterBorder::stretch}) {
    const RadianceRasterEstimator estimator(rays, lights, {}, raster_options(scene, Estimate::raster, border),
                                            kOrder, RadianceGradient::none, 1);
    const RadianceRecord drawn = record_at(estimator, site);
    EXPECT_TRUE(drawn.gradient_x.empty());
    off[static_cast<int>(border)] = distance(channel(drawn.light), truth);
    RecordProperty(std::to_string(static_cast<int>(border)),
                   std::to_string(off[static_cast<int>(border)] / norm(truth)));
  }
  EXPECT_LT(off[2], 2 * std::sqrt(variance) + 0.03 * norm(truth));
  EXPECT_GT(off[0], 0.3 * norm(truth));
  EXPECT_GT(off[1], 0.2 * norm(truth));
}

/// In a furnished box: root mean square over places of the relative distance to the coefficients of rays, and
/// the irradiance that both hold.
TEST(RadianceRaster, StretchedBordersAreBest) {
  constexpr int kOrder = 5;
  const Scene scene = cornell();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RadianceEstimator gather(rays, lights, {}, raster_options(scene, Estimate::gather), kOrder,
                                 RadianceGradient::hybrid, 1);
  std::vector<RecordSite> sites;
  std::vector<RadianceRecord> truth;
  for (std::uint64_t i = 0; i < 30; ++i) {
    RandomStream random(7, Stage::test, i);
    const Camera::Ray ray = scene.camera[0].ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    sites.push_back({point.position, point.smooth_normal, i});
    truth.push_back(record_at(gather, sites.back()));
  }
  ASSERT_GT(sites.size(), 20u);
  double rms[3] = {0, 0, 0};
  for (const RasterBorder border : {RasterBorder::none, RasterBorder::coverage, RasterBorder::stretch}) {
    const RadianceRasterEstimator estimator(rays, lights, {}, raster_options(scene, Estimate::raster, border),
                                            kOrder, RadianceGradient::hybrid, 1);
    double& sum = rms[static_cast<int>(border)];
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const std::vector<double> light = channel(truth[i].light);
      const double off = distance(channel(record_at(estimator, sites[i]).light), light) / norm(light);
      sum += off * off / static_cast<double>(sites.size());
    }
    sum = std::sqrt(sum);
    RecordProperty(std::to_string(static_cast<int>(border)), std::to_string(sum));
  }
  EXPECT_LT(rms[2], 0.3);
  EXPECT_GT(rms[1], 2 * rms[2]);
  EXPECT_GT(rms[0], 2 * rms[2]);
}

TEST(RadianceRaster, SameRecordAgain) {
  const AnalyticScene s = furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordSite site{s.checks[0].position, s.checks[0].normal, 5};
  RecordOptions options = raster_options(s.scene, Estimate::raster);
  options.raster_side = 32;
  std::vector<float> light[2], slope[2];
  for (int i = 0; i < 2; ++i) {
    const RadianceRasterEstimator estimator(rays, lights, {}, options, 4, RadianceGradient::hybrid, 3);
    const RadianceRecord r = record_at(estimator, site);
    light[i] = r.light, slope[i] = r.gradient_x;
  }
  EXPECT_EQ(light[0], light[1]);
  EXPECT_EQ(slope[0], slope[1]);
  EXPECT_THROW(RadianceRasterEstimator(rays, lights, {}, options, 0, RadianceGradient::hybrid, 3), Error);
}

}  // namespace
}  // namespace phos::test
