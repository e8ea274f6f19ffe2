// Records, sensors and shading in an environment, where the light is known.
#include <gtest/gtest.h>

#include "estimate/shading.h"
#include "support/environment.h"
#include "support/gathered.h"
#include "support/one_material.h"
#include "support/sensors.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// A site in free air at height 1 that looks down on a floor of half side a: it shadows nothing, and of what
/// it sees the floor has the share F = 4 corner_form_factor(a, a, 1); the rest is the environment.
constexpr float kHalfSide = 3;
const Vec3 kSite{0, 1, 0}, kDown{0, -1, 0};
double floor_share() { return 4 * corner_form_factor_parallel(double(kHalfSide), double(kHalfSide), 1); }

Scene floor_of(const Material& material, const Environment& map) {
  Scene scene = open_floor(kHalfSide);
  scene.material[0] = material;
  surround(scene, map);
  return scene;
}

/// Sky and sun: more than nine tenths of the light on the floor comes from one texel.
Environment sunny_map() {
  return map_of(32, [](int x, int y) { return Rgb(x == 7 && y == 9 ? 3000.f : y < 16 ? 1.f : 0.2f); });
}

/// Rays of a record see the floor lit by E: rho E F. What leaves the scene is no part of it.
TEST(Gather, SeesTheFloorThatTheEnvironmentLights) {
  for (const bool sunny : {false, true}) {
    const Environment map = sunny ? sunny_map() : constant_map(8, Rgb(2));
    Gathered g(floor_of(make_material(Model::lambert, Rgb(0.6f), Rgb(0)), map));
    const double truth = 0.6 * map.irradiance_up_lx().y * floor_share();
    const Trial t =
        g.trial(kSite, kDown, gather_options(g.scene, Quantity::indirect, 1, 256), {}, truth, 400);
    EXPECT_NEAR(t.mean, truth, 3.5 * t.stderr_of_mean) << sunny;
    EXPECT_LT(t.stderr_of_mean, 0.01 * truth) << sunny;
  }
}

/// With the light straight from the environment, L pi (1 - F) more.
TEST(Gather, AddsWhatArrivesStraight) {
  Gathered g(floor_of(make_material(Model::lambert, Rgb(0.6f), Rgb(0)), constant_map(8, Rgb(2))));
  const double truth = 2 * kPiD * (0.6 * floor_share() + 1 - floor_share());
  const Trial t = g.trial(kSite, kDown, gather_options(g.scene, Quantity::all, 1, 256), {}, truth);
  EXPECT_NEAR(t.mean, truth, 3.5 * t.stderr_of_mean);
  EXPECT_LT(t.stderr_of_mean, 0.01 * truth);
}

/// A mirror of reflectance rho shows the environment: rho L pi F, by walks that leave the scene.
TEST(Gather, SeesTheEnvironmentInMirrors) {
  Gathered g(floor_of(make_material(Model::mirror, Rgb(0), Rgb(0.7f)), constant_map(8, Rgb(2))));
  const double truth = 0.7 * 2 * kPiD * floor_share();
  const Trial t = g.trial(kSite, kDown, gather_options(g.scene, Quantity::indirect, 1, 256), {}, truth);
  EXPECT_NEAR(t.mean, truth, 3.5 * t.stderr_of_mean);
  EXPECT_LT(t.stderr_of_mean, 0.01 * truth);
}

/// Through gloss, light sampled at the hit and the walk's next ray share the environment: together they are
/// what either is for a part of the map, so that the whole is the sum of its parts.
TEST(Gather, WeighsTheEnvironmentInGloss) {
  for (const float exponent : {3.f, 200.f}) {
    Material m = make_material(Model::phong, Rgb(0.2f), Rgb(0.7f));
    m.exponent = exponent;
    const auto mean = [&](const Environment& map, double& error) {
      Gathered g(floor_of(m, map));
      const Trial t = g.trial(kSite, kDown, gather_options(g.scene, Quantity::indirect, 1, 256), {}, 1, 400);
      error = std::hypot(error, t.stderr_of_mean);
      return t.mean;
    };
    double error = 0;
    const double whole = mean(sunny_map(), error);
    const double sky = mean(map_of(32, [](int, int y) { return Rgb(y < 16 ? 1.f : 0.2f); }), error);
    const double sun =
        mean(map_of(32, [](int x, int y) { return Rgb(x == 7 && y == 9 ? 2999.f : 0.f); }), error);
    EXPECT_NEAR(whole, sky + sun, 4 * error) << exponent;
    EXPECT_LT(error, 0.03 * whole) << exponent;
  }
}

/// Where a roof hides the sun, the rim of the sky alone lights the floor, a fortieth of all light there is.
/// Half of the samples look for it: by luminance alone the noise would be more than half of the value.
TEST(Gather, AHiddenSunIsNoNoise) {
  Scene scene = open_floor(kHalfSide, 0.6f);
  begin_instance(scene, "roof", add_lambert(scene, "black", 0));
  add_quad(scene, {-9, 3, -9}, {18, 0, 0}, {0, 0, 18});
  // The sun stands at the zenith, behind the roof; below 45 degrees the sky lights the floor.
  surround(scene, map_of(32, [](int, int y) { return Rgb(y == 0 ? 1e4f : 1.f); }));
  Gathered g(scene);
  const Trial t = g.trial(kSite, kDown, gather_options(scene, Quantity::indirect, 1, 256), {}, 1, 200);
  EXPECT_LT(t.stderr_of_mean * std::sqrt(200), 0.25 * t.mean);
}

/// Lamps and environment together: neither is counted twice nor forgotten.
TEST(Gather, LampsAndEnvironmentAddUp) {
  Scene scene = open_floor(kHalfSide, 0.6f);
  begin_instance(scene, "panel", add_lambert(scene, "panel", 0, 40));
  add_quad(scene, {-0.5f, 1.5f, -0.5f}, {1, 0, 0}, {0, 0, 1});
  Scene dark = scene;
  surround(scene, constant_map(8, Rgb(2)));
  finalize(dark);
  Scene sky = scene;
  sky.material[1].emission = Rgb(0);
  finalize(sky);
  double mean[3], error[3];
  const Scene* scenes[3] = {&scene, &dark, &sky};
  for (int k = 0; k < 3; ++k) {
    Gathered g(*scenes[k]);
    const Trial t = g.trial(kSite, kDown, gather_options(g.scene, Quantity::all, 1, 256), {}, 1);
    mean[k] = t.mean, error[k] = t.stderr_of_mean;
  }
  EXPECT_NEAR(mean[0], mean[1] + mean[2], 4 * std::hypot(error[0], std::hypot(error[1], error[2])));
  EXPECT_LT(error[0], 0.01 * mean[0]);
}

/// E = pi L on open ground at any size of the scene and any strength of the light.
TEST(Sensors, OnOpenGround) {
  for (const float metres : {1e-6f, 1.f, 1e6f}) {
    for (const float strength : {1e-12f, 1.f, 1e12f}) {
      Scene scene = open_floor(metres);
      surround(scene, constant_map(8, Rgb(strength)));
      SensorOptions options;
      options.light_samples = 4096;
      options.direct_only = true;
      const Read read =
          read_sensors_of(scene, sensors_at({{Vec3(0.2f * metres, 0, 0), {0, 1, 0}, 0}}), {}, options);
      const Reading& r = read.readings[0];
      EXPECT_NEAR(r.direct_lx, kPi * strength, 0.003f * kPi * strength) << metres << " " << strength;
      EXPECT_LT(r.stderr_lx, 0.03f * r.direct_lx);
      EXPECT_GT(r.stderr_lx, 0.002f * r.direct_lx);
    }
  }
}

/// Whatever a material does, under an even environment it shows L x its albedo, however the light is split
/// between samples of the environment and rays of the lobe.
TEST(Shading, EverySplitOfTheEnvironmentGivesTheAlbedo) {
  constexpr int kRepeats = 400, kPoints = 1 << 16;
  for (const Named& model : models()) {
    Scene scene = open_floor();
    scene.material[0] = model.material;
    scene.measured = measured_tables();
    surround(scene, constant_map(8, Rgb(5)));
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const RecordTree no_records(scene.bounds, 0.2);
    const Shading shading(rays, lights, no_records, {});
    const Vec3 wo = normalized_or_zero({0.3f, 0.6f, -0.5f});
    SurfacePoint point;
    ASSERT_TRUE(trace(rays, {wo, -wo}, point));
    const Bsdf bsdf(scene, point);
    DVec3 albedo(0);
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 local = sample_cosine_hemisphere(r2_point(i, Vec2(0.5f)));
      albedo += DVec3(bsdf.evaluate(wo, Vec3(local.x, local.z, local.y))) * (kPiD / kPoints);
    }
    for (const auto& [light_samples, gloss_samples] : {std::pair{64, 0}, {16, 8}, {2, 16}}) {
      DVec3 mean(0), squares(0);
      ShadingLog log;
      for (std::uint64_t k = 0; k < kRepeats; ++k) {
        RandomStream random(7, Stage::test, k);
        const Rgb light =
            shading.direct(point, bsdf, wo, light_samples, gloss_samples, random).radiance +
            shading.gloss(point, bsdf, wo, gloss_samples, light_samples, 0, random, random, log).from_lamps;
        const DVec3 v = DVec3(light) / 5.0;
        mean += v / double{kRepeats}, squares += v * v / double{kRepeats};
      }
      const DVec3 error = glm::sqrt(glm::max(squares - mean * mean, DVec3(0)) / (kRepeats - 1.0));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c], albedo[c], 5 * error[c] + 0.01)
            << model.name << ", " << light_samples << " + " << gloss_samples;
    }
  }
}

}  // namespace
}  // namespace phos::test
