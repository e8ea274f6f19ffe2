// Final gathering and photons shown directly against closed forms, and against path tracing: within the
// stated noise and a bound of the bias, which no stated error holds.
#include <gtest/gtest.h>

#include "core/error.h"
#include "reference/render.h"
#include "support/mirrors.h"
#include "support/photon_mapped.h"
#include "support/run.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// Every place within 4 standard errors (one in 16,000 is not) and a part of the truth.
void expect_near(const std::vector<PointIrradiance>& light, const std::vector<Check>& checks, double bias,
                 double most_error) {
  ASSERT_EQ(light.size(), checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const double truth = checks[i].irradiance_lx, stated = light[i].illuminance_stderr_lx;
    EXPECT_NEAR(light[i].illuminance_lx, truth, 4 * stated + bias * truth) << "place " << i;
    EXPECT_LT(stated, most_error * truth) << "place " << i;
  }
}

/// Far from borders light is even: the disc has no bias. Its noise is 1/sqrt(k).
TEST(PhotonViewAnalytic, Furnace) {
  const AnalyticScene s = furnace(0.5f);
  const PhotonMapped mapped(s.scene, 200'000);
  MapOptions options;
  options.photons_in_disc = 1000;
  const auto light = mapped.measure(ReferenceMethod::photons, sensors_at(s.checks), 1, options);
  // Photons of one path are not independent: what they share, at a furnace of two hits a path, is 1 % at
  // most.
  expect_near(light, s.checks, 0.01, 0.05);
  for (const PointIrradiance& e : light) {
    EXPECT_EQ(e.samples, 1u);
    EXPECT_NEAR(e.illuminance_stderr_lx / e.illuminance_lx, 1 / std::sqrt(999.0), 2e-3);
  }
}

/// In a disc of r the light of a lamp at height h is wrong by r2/8 of its Laplacian over it: r is 0.13 m in
/// the middle and 0.3 m at most, so that this is below 2 %.
TEST(PhotonViewAnalytic, PointLampOverAPlane) {
  const AnalyticScene s = point_light_over_plane();
  MapOptions options;
  options.photons_in_disc = 200;
  const PhotonMapped mapped(s.scene, 200'000);
  expect_near(mapped.measure(ReferenceMethod::photons, sensors_at(s.checks), 1, options), s.checks, 0.02,
              0.1);
}

/// A disc of 20 photons has a radius of 1.5 cm: rays that land nearer than that to an edge, 5 % of them, read
/// photons of the other wall in place of some of their own. Most of the noise is of shadow rays to the walls.
TEST(FinalGatherAnalytic, Furnace) {
  const AnalyticScene s = furnace(0.5f);
  const PhotonMapped mapped(s.scene, 200'000);
  MapOptions options;
  options.photons_in_disc = 20, options.gather_rays = 4;
  expect_near(mapped.measure(ReferenceMethod::final_gather, sensors_at(s.checks), 2048, options), s.checks,
              0.02, 0.02);
}

/// Nothing lies about the plane for gather rays to meet: all light is that of shadow rays, which is exact.
TEST(FinalGatherAnalytic, PointLampOverAPlane) {
  const AnalyticScene s = point_light_over_plane();
  const PhotonMapped mapped(s.scene, 2000);
  for (const PointIrradiance& e :
       mapped.measure(ReferenceMethod::final_gather, sensors_at(s.checks), 4, MapOptions()))
    EXPECT_NEAR(e.illuminance_stderr_lx, 0, 1e-6);
  expect_near(mapped.measure(ReferenceMethod::final_gather, sensors_at(s.checks), 4, MapOptions()), s.checks,
              1e-5, 1e-6);
}

/// Light of the lamp's image comes by caustic photons; what comes straight, by shadow rays.
TEST(FinalGatherAnalytic, MirrorWall) {
  const MirrorBox box;
  const PhotonMapped mapped(box.scene, 400'000);
  MapOptions options;
  options.photons_in_disc = 200;
  std::vector<Check> checks{{{2, 0, 2.5f}, {0, 1, 0}}, {{1, 3, 4}, {0, -1, 0}}, {{2, 1, 0}, {0, 0, 1}}};
  for (Check& c : checks)
    c.irradiance_lx =
        MirrorBox::image_lx(c.position, c.normal) + MirrorBox::straight_lx(c.position, c.normal);
  for (const ReferenceMethod method : {ReferenceMethod::final_gather, ReferenceMethod::photons})
    expect_near(mapped.measure(method, sensors_at(checks), 4, options), checks, 0.01, 0.1);
}

/// Photons lie on surfaces: a sensor in free air has none about it.
TEST(PhotonViewAnalytic, RefusesAPointInFreeAir) {
  const MirrorBox box;
  const PhotonMapped mapped(box.scene, 2000);
  for (const ReferenceMethod method : {ReferenceMethod::final_gather, ReferenceMethod::photons}) {
    try {
      mapped.measure(method, {{{2, 0, 2.5f}, {0, 1, 0}}, {{2, 1, 2.5f}, {0, 1, 0}}}, 1, MapOptions());
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(e.what()).find("point 2"), std::string::npos) << e.what();
    }
  }
}

/// Surfaces that the first camera sees on a grid of its picture.
std::vector<SensorPoint> seen_by_camera(const RayScene& rays, int across) {
  const Camera& camera = rays.scene().camera.front();
  std::vector<SensorPoint> seen;
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < across; ++x) {
      const Vec2 at = (Vec2(float(x), float(y)) + 0.5f) / float(across);
      const Camera::Ray ray = camera.ray(at, 1);
      SurfacePoint point;
      if (trace(rays, {ray.origin, ray.direction, 0, kInfinity}, point))
        seen.push_back({point.position, point.geometric_normal});
    }
  return seen;
}

struct MeanLux {
  double lux = 0, error = 0;
};
MeanLux mean_of(const std::vector<PointIrradiance>& light) {
  MeanLux sum;
  for (const PointIrradiance& e : light)
    sum.lux += e.illuminance_lx, sum.error += e.illuminance_stderr_lx * e.illuminance_stderr_lx;
  const auto n = static_cast<double>(light.size());
  return {sum.lux / n, std::sqrt(sum.error) / n};
}

/// Discs of 50 photons (1 cm, in a box of 55 cm) lose and gain light at edges and at the borders of shadows.
TEST(MapAnalytic, CornellBoxAsByPaths) {
  const Scene scene = load_scene(data("cornell-measured.glb"), {});
  const PhotonMapped mapped(scene, 100'000);
  const std::vector<SensorPoint> places = seen_by_camera(mapped.rays, 8);
  ASSERT_GT(places.size(), 40u);
  PointOptions path;
  path.samples = 4096;
  const MeanLux truth =
      mean_of(measure_points(mapped.rays, mapped.luminaires, places, ReferenceMethod::path, {}, path).light);
  MapOptions options;
  options.photons_in_disc = 50;
  for (const auto& [method, samples, bias] :
       {std::tuple{ReferenceMethod::final_gather, 32, 0.02}, {ReferenceMethod::photons, 1, 0.05}}) {
    const MeanLux mean = mean_of(mapped.measure(method, places, samples, options));
    EXPECT_NEAR(mean.lux, truth.lux, 3 * std::hypot(mean.error, truth.error) + bias * truth.lux)
        << row_of(method).name;
    EXPECT_GT(mean.error, 0);
  }
}

/// A picture's stated error holds the noise of the photons, which more samples do not make less.
TEST(PhotonViewAnalytic, PicturesStateTheNoiseOfThePhotons) {
  const AnalyticScene s = furnace(0.5f);
  const PhotonMapped mapped(s.scene, 100'000);
  MapOptions map;
  map.photons_in_disc = 101;
  const auto light = mapped.light(ReferenceMethod::photons, map);
  ReferenceOptions options;
  options.width = options.height = 8, options.samples = 16, options.method = ReferenceMethod::photons;
  const ReferencePicture picture =
      render_reference(mapped.rays, mapped.luminaires, s.scene.camera.front(), options, light.get());
  // Of two units of light one is emitted; the noise of the other is a tenth, and samples lie in the same
  // discs.
  EXPECT_NEAR(picture.error, 0.1, 0.02);
  for (const float v : picture.image.channel("stderr.R")) EXPECT_GT(v, 0);
}

}  // namespace
}  // namespace phos::test
