// Path tracing of scenes in an environment, against what can be said of their light without tracing.
#include <gtest/gtest.h>

#include "reference/eye_path_tracer.h"
#include "reference/point_irradiance.h"
#include "scene/material/oren_nayar.h"
#include "support/environment.h"

namespace phos::test {
namespace {

PointIrradiance at(const Scene& scene, const Vec3& p, const Vec3& n, std::int64_t samples,
                   std::int64_t bounces = -1) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  return estimate_irradiance(rays, lights, p, n, samples, bounces, 1);
}

void expect_near(const PointIrradiance& found, const DVec3& truth, double rounding, const std::string& what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(double(found.irradiance_lx[c]), truth[c],
                4 * double(found.stderr_lx[c]) + rounding * truth[c])
        << what << " channel " << c;
}

/// Mean luminance along one ray.
DVec3 luminance_along(const Scene& scene, const Ray& ray, int samples) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const EyePathTracer tracer(rays, lights);
  DVec3 sum(0);
  for (int s = 0; s < samples; ++s) {
    RandomStream random(1, Stage::reference, static_cast<std::uint64_t>(s));
    sum += DVec3(tracer.luminance(ray, random).total());
  }
  return sum / static_cast<double>(samples);
}

/// Under a uniform sky of luminance L an open plane has E = pi L, on both of its sides.
TEST(OpenPlane, UnderAUniformSky) {
  Scene scene = open_floor();
  const DVec3 sky(30, 20, 10);
  surround(scene, constant_map(16, Rgb(sky)));
  for (const float side : {1.f, -1.f}) {
    const PointIrradiance e = at(scene, {0.3f, 0, -0.2f}, {0, side, 0}, 20000);
    expect_near(e, std::numbers::pi * sky, 1e-5, "sky");
    EXPECT_LT(e.illuminance_stderr_lx, 0.01 * e.illuminance_lx);
  }
}

/// L = cos(theta): E = 2 pi / 3 on a plane that faces up. The map has the cosine at the middle of each row;
/// the map's own sum is exact, and differs from that by 1e-3.
TEST(OpenPlane, UnderACosineSky) {
  constexpr int kRows = 64;
  const Environment map = map_of(kRows, [](int, int y) {
    return Rgb(std::max(0.f, std::cos(kPi * (static_cast<float>(y) + 0.5f) / kRows)));
  });
  Scene scene = open_floor();
  surround(scene, map);
  const DVec3 truth = map.irradiance_up_lx();
  EXPECT_NEAR(truth.x, 2 * std::numbers::pi / 3, 1e-3);
  expect_near(at(scene, {0.1f, 0, 0.2f}, {0, 1, 0}, 20000), truth, 1e-5, "cosine");
}

/// A sun of one texel is a directional light of as many lux, shadows included.
TEST(Sun, OfOneTexelIsADirectionalLight) {
  constexpr int kRows = 512, kColumn = 300, kRow = 100;
  const float luminance = 1e6f;
  const Environment map = map_of(
      kRows, [&](int x, int y) { return Rgb(x == kColumn && y == kRow ? luminance : 0.f); }, 0.4);
  Scene scene = open_floor(4);
  begin_instance(scene, "wall", add_lambert(scene, "wall", 0.4f));
  add_quad(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  Scene lamp = scene;
  surround(scene, map);
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = -map.sample({0.5f, 0.5f}).direction;
  sun.intensity = Rgb(map.integral_lx());
  lamp.light.push_back(sun);
  finalize(lamp);
  // The last one lies in the shadow of the wall's middle.
  const Vec3 middle(0, 1, -1), shaded = middle + sun.direction * (-middle.y / sun.direction.y);
  const double open_lx = static_cast<double>(sun.intensity.x * -sun.direction.y);
  for (const Vec3& p : {Vec3(0.3f, 0, 1.5f), Vec3(3.9f, 0, -1.3f), Vec3(-3.9f, 0, -2), shaded}) {
    const PointIrradiance expected = at(lamp, p, {0, 1, 0}, 2000), found = at(scene, p, {0, 1, 0}, 2000);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(
          found.irradiance_lx[c], expected.irradiance_lx[c],
          4 * std::hypot(found.stderr_lx[c], expected.stderr_lx[c]) + 1e-3f * expected.irradiance_lx[c]);
    if (p == shaded) {
      EXPECT_LT(expected.illuminance_lx, 0.5 * open_lx);
    } else {
      EXPECT_GE(expected.illuminance_lx, 0.999 * open_lx);
    }
  }
}

/// Turned by 90 degrees, what fell on a wall that faces +Z falls on one that faces +X.
TEST(Rotation, ByAQuarterTurnsTheLight) {
  const Vec3 axes[4] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}};
  std::vector<DVec3> before, after;
  for (const double turn : {0.0, std::numbers::pi / 2}) {
    Scene scene;
    begin_instance(scene, "speck", add_lambert(scene, "black", 0));
    add_quad(scene, {0, -50, 0}, {0, 0, 1}, {1, 0, 0});  // out of the way
    surround(scene, gradient_map(32, turn));
    for (const Vec3& n : axes) {
      const PointIrradiance e = at(scene, {0, 0, 0}, n, 100000, 1);
      (turn == 0 ? before : after)
          .push_back(DVec3(e.irradiance_lx[0], e.irradiance_lx[1], e.irradiance_lx[2]));
    }
  }
  EXPECT_GT(std::fabs(before[0].x - before[1].x), 0.3);
  for (std::size_t k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[(k + 1) % 4][c], before[k][c], 0.02 * before[k][c]) << k;
}

/// White surfaces of any shape under a uniform sky look as bright as the sky: every path ends in it. Grey
/// convex ones reflect rho of it.
TEST(OpenFurnace, WhiteIsAsBrightAsTheSky) {
  Scene scene;
  begin_instance(scene, "groove", add_lambert(scene, "white", 1));
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {1, -1, 0});  // a valley of two slopes
  add_quad(scene, {0, -1, -1}, {0, 0, 2}, {1, 1, 0});
  surround(scene, constant_map(8, Rgb(7)));
  const DVec3 seen = luminance_along(scene, {{0.1f, 3, 0.2f}, normalized_or_zero({0.1f, -1, 0.05f})}, 20000);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 7, 0.05);
}

TEST(OpenFurnace, AGreySphereReflectsItsShare) {
  AnalyticScene s = integrating_sphere(0.3f, 320);
  for (Triangle& t : s.scene.triangle) std::swap(t.v[1], t.v[2]);  // fronts outwards
  for (Vec3& n : s.scene.normal) n = -n;
  s.scene.light.clear();
  surround(s.scene, constant_map(8, Rgb(7)));
  const DVec3 seen = luminance_along(s.scene, {{0.4f, 0.1f, 3}, {0, 0, -1}}, 20000);
  EXPECT_NEAR(seen.x, 0.3 * 7, 0.01);
}

/// White rough matt surfaces lose no light either.
TEST(OpenFurnace, WhiteOrenNayarIsAsBrightAsTheSky) {
  Scene scene;
  begin_instance(scene, "groove", add_lambert(scene, "white", 1));
  scene.material[0].model = Model::oren_nayar, scene.material[0].sigma_rad = 0.5f;
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {1, -1, 0});
  add_quad(scene, {0, -1, -1}, {0, 0, 2}, {1, 1, 0});
  surround(scene, constant_map(8, Rgb(7)));
  const DVec3 seen = luminance_along(scene, {{0.1f, 3, 0.2f}, normalized_or_zero({0.1f, -1, 0.05f})}, 20000);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 7, 0.05);
}

/// A plane of it under an even sky shows its albedo, which is known in closed form, at each angle.
TEST(OpenFurnace, OrenNayarShowsItsAlbedoByAngle) {
  Scene scene;
  begin_instance(scene, "plate", add_lambert(scene, "matt", 0.6f));
  scene.material[0].model = Model::oren_nayar, scene.material[0].sigma_rad = 0.8f;
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  surround(scene, constant_map(8, Rgb(7)));
  const OrenNayar surface(Rgb(0.6f), 0.8f);
  for (const float cosine : {1.f, 0.5f, 0.1f}) {
    const Vec3 down(std::sqrt(1 - cosine * cosine), -cosine, 0);
    const double seen = luminance_along(scene, {-0.5f * down, down}, 100000).x;
    EXPECT_NEAR(seen / 7, surface.albedo(cosine).x, 0.003) << cosine;
  }
}

/// A mirror shows the environment, and so does a ray that meets nothing.
TEST(Background, IsSeenStraightAndInMirrors) {
  Scene scene;
  Material mirror;
  mirror.model = Model::mirror, mirror.ks = Rgb(1);
  scene.material.push_back(mirror);
  begin_instance(scene, "mirror", 0);
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  const Environment map = gradient_map(32);
  surround(scene, map);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const EyePathTracer tracer(rays, lights);
  RandomStream random(1, Stage::reference, 1);
  const Vec3 up = normalized_or_zero({0.3f, 0.8f, 0.5f}), down(up.x, -up.y, up.z);
  const PathSample straight = tracer.luminance({Vec3(0, 2, 0), up}, random);
  EXPECT_EQ(straight.emission, map.luminance(up));
  EXPECT_EQ(straight.total(), straight.emission);
  const PathSample mirrored = tracer.luminance({-0.5f * down, down}, random);
  EXPECT_EQ(mirrored.specular, map.luminance(up));
  EXPECT_EQ(mirrored.total(), mirrored.specular);
}

/// Next-event estimation and the paths' own rays share the light of a glossy surface: whatever its lobe, the
/// albedo under a uniform sky is what the lobe has, the same by either alone. A sharp and a broad one.
TEST(Gloss, UnderAUniformSkyReflectsItsAlbedo) {
  for (const float exponent : {5.f, 5000.f}) {
    Scene scene;
    Material m;
    m.model = Model::phong, m.ks = Rgb(0.8f), m.exponent = exponent;
    scene.material.push_back(m);
    begin_instance(scene, "plate", 0);
    add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    // A sun in a bright sky: both ways of sampling matter, and the sun stands far off the mirror direction.
    surround(scene, map_of(64, [](int x, int y) { return Rgb(x == 20 && y == 25 ? 2000.f : 1.f); }));
    Scene uniform = scene;
    surround(uniform, constant_map(64, Rgb(1)));
    Scene sun = scene;
    surround(sun, map_of(64, [](int x, int y) { return Rgb(x == 20 && y == 25 ? 1999.f : 0.f); }));
    const Ray ray{{0, 1, 0}, normalized_or_zero({0.02f, -1, 0.01f})};
    const double whole = luminance_along(scene, ray, 100000).x,
                 parts = luminance_along(uniform, ray, 100000).x + luminance_along(sun, ray, 100000).x;
    EXPECT_NEAR(whole, parts, 0.01 * parts) << exponent;
    if (exponent > 1000) {
      EXPECT_NEAR(luminance_along(uniform, ray, 1000).x, 0.8, 0.01);
    }
  }
}

}  // namespace
}  // namespace phos::test
