// Irradiance by drawing the hemisphere, against closed forms and against gathered rays (Gautron 2006,
// table 4.1; docs/methods.md#r1).
#include <gtest/gtest.h>

#include "core/random.h"
#include "estimate/gather.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "splat/raster/hemisphere_raster.h"
#include "splat/raster/raster_plane.h"
#include "support/raster.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr RasterBorder kBorders[] = {RasterBorder::none, RasterBorder::coverage, RasterBorder::stretch};

template <class OneEstimator>
double irradiance_lx(const OneEstimator& estimator, Estimator::Worker& worker, const RecordSite& site) {
  return static_cast<double>(estimator.make(site, worker).record.irradiance.y);
}

/// The same light from everywhere, rho M once reflected: what the plane leaves out is exactly what is
/// missing, and either border makes up for it.
TEST(Raster, UniformLight) {
  const AnalyticScene s = furnace(0.5f, 100 / kPi);  // M = 100
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const double truth = 50, covered = raster_plane(8, RasterBorder::none).covered;
  for (const RasterBorder border : kBorders) {
    const RasterEstimator estimator(rays, lights, {}, raster_options(s.scene, Estimate::raster, border), 1);
    const auto worker = estimator.make_worker();
    double mean = 0;
    for (std::size_t i = 0; i < s.checks.size(); ++i)
      mean += irradiance_lx(estimator, *worker, {s.checks[i].position, s.checks[i].normal, i}) /
              static_cast<double>(s.checks.size());
    EXPECT_NEAR(mean / truth, border == RasterBorder::none ? covered : 1, 0.02) << static_cast<int>(border);
  }
}

/// A floor beside a lit wall that stands on it, nothing else: all light comes from one side, from
/// the horizon up. The wall (height b, width 2 a, at distance c, exitance rho E) gives rho E F. Light that a
/// lamp far away throws straight on the wall is the same all over it.
TEST(Raster, AWallOnTheFloor) {
  constexpr float kDistance = 1, kHalfWidth = 20, kHeight = 20, kLux = 1000, kAlbedo = 0.8f;
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
  const double form = 2 * corner_form_factor_perpendicular(kHalfWidth, kHeight, kDistance);
  const double truth = static_cast<double>(kAlbedo * kLux) * form;
  double error[3];
  for (int b = 0; b < 3; ++b) {
    const RasterEstimator estimator(rays, lights, {}, raster_options(scene, Estimate::raster, kBorders[b]),
                                    1);
    const auto worker = estimator.make_worker();
    error[b] = irradiance_lx(estimator, *worker, {{0, 0, kDistance}, {0, 1, 0}, 1}) / truth - 1;
  }
  // The wall fills what of the hemisphere lies beyond 45 degrees, but for its own far ends, and so as much of
  // the part below the plane's edge on its side: half of it.
  EXPECT_LT(error[0], -0.12);
  EXPECT_NEAR(error[2], 0, 0.02) << "stretched pixels see the wall";
  EXPECT_GT(std::fabs(error[1]), std::fabs(error[2]));
  // And rays agree with the closed form.
  const GatherEstimator gather(rays, lights, {}, raster_options(scene, Estimate::gather), 1);
  const auto worker = gather.make_worker();
  EXPECT_NEAR(irradiance_lx(gather, *worker, {{0, 0, kDistance}, {0, 1, 0}, 1}), truth, 0.02 * truth);
}

/// Root mean square of the relative error of each border against gathered rays, where rays from the camera
/// land.
TEST(Raster, StretchedBordersAreBest) {
  const Scene scene = cornell();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const GatherEstimator gather(rays, lights, {}, raster_options(scene, Estimate::gather), 1);
  const auto rays_worker = gather.make_worker();
  std::vector<RecordSite> sites;
  std::vector<double> truth;
  for (std::uint64_t i = 0; i < 60; ++i) {
    RandomStream random(7, Stage::test, i);
    const Camera::Ray ray = scene.camera[0].ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    sites.push_back({point.position, point.smooth_normal, i});
    truth.push_back(irradiance_lx(gather, *rays_worker, sites.back()));
  }
  ASSERT_GT(sites.size(), 40u);
  double rms[3];
  for (int b = 0; b < 3; ++b) {
    const RasterEstimator estimator(rays, lights, {}, raster_options(scene, Estimate::raster, kBorders[b]),
                                    1);
    const auto worker = estimator.make_worker();
    double square = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double e = irradiance_lx(estimator, *worker, sites[i]) / truth[i] - 1;
      square += e * e;
    }
    rms[b] = std::sqrt(square / static_cast<double>(sites.size()));
    RecordProperty(std::to_string(b), std::to_string(rms[b]));
  }
  EXPECT_GT(rms[0], rms[1]) << "none, coverage";
  EXPECT_GT(rms[1], rms[2]) << "coverage, stretch " << rms[2];
  EXPECT_LT(rms[2], 0.1);
}

}  // namespace
}  // namespace phos::test
