// Path tracing under skies and suns, against closed forms.
#include <gtest/gtest.h>

#include "reference/point_irradiance.h"
#include "support/daylight.h"

namespace phos::test {
namespace {

PointIrradiance at(const Scene& scene, const Vec3& p, std::int64_t samples) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  return estimate_irradiance(rays, lights, p, {0, 1, 0}, samples, -1, 1);
}

}  // namespace

TEST(Reference, InTheOpenReadsWhatWasAskedFor) {
  for (int type = 1; type <= 16; ++type) {
    Scene scene = open_floor();
    surround(scene, sky_of("cie:" + std::to_string(type), "250,40", 8000, 0));
    const PointIrradiance e = at(scene, {0.1f, 0, 0.2f}, 20000);
    EXPECT_NEAR(e.illuminance_lx, 8000, 4 * e.illuminance_stderr_lx + 1) << type;
    EXPECT_LT(e.illuminance_stderr_lx, 80) << type;
  }
}

TEST(Reference, SeesSunSkyAndPenumbra) {
  Scene open = open_floor();
  surround(open, sky_of("clear", "30,30", 12000, 80000));
  const PointIrradiance both = at(open, {0, 0, 0}, 40000);
  EXPECT_NEAR(both.illuminance_lx, 52000, 4 * both.illuminance_stderr_lx + 5);
  EXPECT_LT(both.illuminance_stderr_lx, 500);
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    const float height = 2 * scale;
    Scene scene = under_an_edge(height, 3 * scale);
    surround(scene, sky_of("", "0,90", 0, 100000));
    const double radius = static_cast<double>(height) * std::tan(glm::radians(0.533 / 2));
    for (const double t : {-1.05, -0.5, 0.0, 0.7, 1.05}) {
      const PointIrradiance e = at(scene, {static_cast<float>(t * radius), 0, 0.3f * scale}, 10000);
      EXPECT_NEAR(e.illuminance_lx / 100000, seen_of_disc(t), 4 * e.illuminance_stderr_lx / 100000 + 2e-3)
          << t << " at " << scale;
    }
  }
}

/// In a mirror the sun is a disc of its own size and luminance, and beside it the sky.
TEST(Reference, SeesTheSunInAMirror) {
  Scene scene;
  const std::uint32_t mirror = add_lambert(scene, "mirror", 0);
  scene.material[mirror].model = Model::mirror, scene.material[mirror].ks = Rgb(0.5f);
  begin_instance(scene, "mirror", mirror);
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  const Environment sky = sky_of("cie:5", "180,45", 1000, 50000);
  surround(scene, sky);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const EyePathTracer tracer(rays, lights);
  const double radius = glm::radians(0.533 / 2),
               disc = 50000 / (std::numbers::pi * std::pow(std::sin(radius), 2));
  const double around = 1000 / std::numbers::pi;
  for (const double off : {0.0, 0.98, 1.02, 3.0}) {
    const double h = std::numbers::pi / 4 + off * radius;  // south is +Z
    RandomStream random(1, Stage::reference, 0);
    const DVec3 towards(0, std::sin(h), std::cos(h)), down(0, -towards.y, towards.z);
    const Ray ray{Vec3(-down), Vec3(down)};
    const auto seen = static_cast<double>(tracer.luminance(ray, random).total().y);
    EXPECT_NEAR(seen / (0.5 * (off < 1 ? disc + around : around)), 1, 1e-3) << off;
  }
}

/// Behind a window, with the sky's closed form.
TEST(Reference, SeesTheSkyThroughAWindow) {
  Scene scene = room_with_window(0);
  surround(scene, sky_of("overcast", "", 5000));
  const auto overcast = [](const DVec3& w) { return 9 * 5000 / (7 * std::numbers::pi) * (1 + 2 * w.y) / 3; };
  for (const DVec3& p : {DVec3(2.5, 0, 3), DVec3(1, 0, 2.5)}) {
    const double truth = through_window_lx(p, overcast, 100);
    const PointIrradiance e = at(scene, Vec3(p), 200000);
    EXPECT_NEAR(e.illuminance_lx, truth, 4 * e.illuminance_stderr_lx + 2e-3 * truth);
    EXPECT_LT(e.illuminance_stderr_lx, 0.05 * truth);
  }
}

}  // namespace phos::test
