// Path tracing of measured luminaires against closed forms, and of openings against points.
#include <gtest/gtest.h>

#include "reference/point_irradiance.h"
#include "support/luminaires.h"

namespace phos::test {
namespace {

PointIrradiance direct(const Scene& scene, const Vec3& p, const Vec3& n, std::int64_t samples) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  return estimate_irradiance(rays, lights, p, n, samples, 1, 1);
}

/// E = I cos / d2; a point needs no luck.
TEST(MeasuredLuminaire, APointGivesItsCandela) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    const AnalyticScene s = measured_point_over_plane(size);
    for (const Check& check : s.checks)
      EXPECT_NEAR(direct(s.scene, check.position, check.normal, 16).illuminance_lx, check.irradiance_lx,
                  2e-5 * check.irradiance_lx)
          << size;
  }
}

/// At 1 m straight below: as many lux as candela.
TEST(MeasuredLuminaire, OneMetreBelowLuxAreCandela) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  hang(scene, luminaire(lambertian(321)), {0, 1, 0});
  finalize(scene);
  EXPECT_NEAR(direct(scene, {0, 0, 0}, {0, 1, 0}, 1).illuminance_lx, 321, 1e-3);
}

TEST(MeasuredLuminaire, ALambertianOpeningIsALambertianLamp) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    const AnalyticScene s = measured_rectangle(size);
    for (const Check& check : s.checks) {
      const PointIrradiance e = direct(s.scene, check.position, check.normal, 20000);
      EXPECT_NEAR(e.illuminance_lx, check.irradiance_lx,
                  4 * e.illuminance_stderr_lx + 1e-4 * check.irradiance_lx)
          << s.name;
      EXPECT_LT(e.illuminance_stderr_lx, 0.02 * check.irradiance_lx);
    }
  }
}

/// Far away an opening is a point, whatever its form; near by it is not.
TEST(MeasuredLuminaire, OpeningsBecomePointsFarAway) {
  using Form = LuminousOpening::Form;
  for (const LuminousOpening& opening : {LuminousOpening{Form::box, {0.6f, 0.3f, 0.1f}},
                                         {Form::ellipsoid, {0.3f, 0.3f, 0.3f}},
                                         {Form::cylinder_x, {0.6f, 0.1f, 0.1f}},
                                         {Form::cylinder_z, {0.4f, 0.4f, 0}},
                                         {Form::box, {0.6f, 0.3f, 0}}}) {
    const auto file =
        luminaire({[](double c, double g) { return 100 + c * (360 - c) / 324 + g; }, 30, 10, 180}, opening);
    for (const float distance : {0.6f, 60.f}) {
      Scene scene;
      begin_instance(scene, "floor", add_lambert(scene, "black", 0));
      add_quad(scene, {-100, 0, -100}, {0, 0, 200}, {200, 0, 0});
      hang(scene, file, {0, distance, 0});
      finalize(scene);
      const Vec3 p(0.3f * distance, 0, 0.2f * distance);
      const PointIrradiance e = direct(scene, p, {0, 1, 0}, 40000);
      const Vec3 way = p - Vec3(0, distance, 0);
      const double d = glm::length(way), candela = scene.fitting[0].intensity_cd(way / float(d)).y;
      const double point_lx = candela * double(distance) / (d * d * d);
      if (distance > 1)
        EXPECT_NEAR(e.illuminance_lx / point_lx, 1, 4 * e.illuminance_stderr_lx / point_lx + 1e-3)
            << opening.describe();
      else
        EXPECT_GT(std::fabs(e.illuminance_lx / point_lx - 1), 0.004) << opening.describe();
    }
  }
}

/// What leaves is what arrives: in a closed black room the mean illuminance is lumens over area.
TEST(MeasuredLuminaire, ABlackRoomReceivesItsLumens) {
  using Form = LuminousOpening::Form;
  for (const LuminousOpening& opening :
       {LuminousOpening{}, {Form::box, {0.6f, 0.3f, 0.1f}}, {Form::box, {0.6f, 0.3f, 0}}}) {
    const auto file =
        luminaire({[](double c, double g) { return 100 + c * (360 - c) / 324 + g; }, 30, 10, 180}, opening);
    const Scene scene = measured_room(file);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const EyePathTracer tracer(rays, lights, {1, false});
    double sum = 0, square = 0;
    constexpr int kPoints = 40000;
    for (int k = 0; k < kPoints; ++k) {
      RandomStream random(5, Stage::test, static_cast<std::uint64_t>(k));
      // Points of the six walls, by area: x 15, y 20, z 12 m2, each twice.
      const float u = random.uniform() * 47;
      const int axis = u < 15 ? 0 : u < 35 ? 1 : 2;
      const Vec3 half(2, 1.5f, 2.5f);
      SurfacePoint sensor;
      sensor.position = half * (2.f * Vec3(random.uniform(), random.uniform(), random.uniform()) - 1.f);
      const float side = random.uniform() < 0.5f ? -1.f : 1.f;
      sensor.position[axis] = side * half[axis];
      sensor.geometric_normal = Vec3(0);
      sensor.geometric_normal[axis] = -side;
      sensor.smooth_normal = sensor.normal = sensor.geometric_normal;
      sensor.error_m = 1e-5f;
      RandomStream own(6, Stage::test, static_cast<std::uint64_t>(k));
      const double e = luminance(tracer.irradiance(sensor, own));
      sum += e, square += e * e;
    }
    const double mean = sum / kPoints, error = std::sqrt((square / kPoints - mean * mean) / kPoints);
    EXPECT_NEAR(94 * mean, file->photometry->flux_lm(), 4 * 94 * error) << opening.describe();
    EXPECT_LT(94 * error, 0.01 * file->photometry->flux_lm());
  }
}

/// The file's factor for the tilt of a luminaire that does not hang straight down.
TEST(MeasuredLuminaire, TiltDimsByItsTable) {
  PhotometricFile file = *luminaire(isotropic(100));
  file.tilt.factor_at_deg = {{0, 1}, {90, 0.5}};
  const auto shared = std::make_shared<const PhotometricFile>(file);
  for (const double deg : {0.0, 45.0, 90.0, 180.0}) {
    Scene scene;
    begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
    add_quad(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    const double a = deg * std::numbers::pi / 180;
    const glm::dmat4 at = aimed({0, 2, 0}, {std::sin(a), -std::cos(a), 0}, {0, 0, 1});
    hang_luminaire(scene, shared, {"lamp", at, Rgb(1)}, LuminairesAs::openings);
    finalize(scene);
    EXPECT_NEAR(scene.light[0].flux_lm.y, 400 * std::numbers::pi * file.tilt.factor(deg), 0.01) << deg;
  }
}

}  // namespace
}  // namespace phos::test
