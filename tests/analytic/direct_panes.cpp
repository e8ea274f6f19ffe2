// Light straight through panes, by every estimator that starts at a receiver, against closed forms.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "estimate/record_options.h"
#include "scene/material/pane.h"
#include "support/daylight.h"
#include "support/gathered.h"
#include "support/panes.h"

namespace phos::test {
namespace {

double direct_lx(const Scene& scene, const Vec3& p, int samples = 256) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RandomStream random(1, Stage::direct_light, 7);
  return static_cast<double>(
      direct_irradiance(rays, lights, receiver(scene, p, {0, 1, 0}), samples, random).irradiance.y);
}

}  // namespace

/// 100,000 lx of sun at 60 degrees of elevation: 79,738 lx.
TEST(Panes, TheSunThroughOne) {
  Scene scene = under_a_pane(1);
  surround(scene, sky_of("", "180,60", 0, 100000));
  const double truth = 1e5 * std::sin(glm::radians(60.0)) * kAt30;
  EXPECT_NEAR(truth, 79738, 1);
  EXPECT_NEAR(direct_lx(scene, {0, 0, 0}), truth, 0.01 * truth);
}

/// A point lamp of 1000 cd: I T c / d2 on the floor and in mid-air, and nothing of it behind a wall.
TEST(Panes, ALampThroughOne) {
  Scene scene = under_a_pane(1);
  add_point_light(scene, {0, 2, 0}, 1000);
  finalize(scene);
  EXPECT_NEAR(direct_lx(scene, {0, 0, 0}), 250 * kClear, 0.01);
  EXPECT_NEAR(direct_lx(scene, {0, 0.5f, 0}), 1000 / 2.25 * kClear, 0.02);
  EXPECT_NEAR(direct_lx(scene, {0, 1.5f, 0}), 4000, 0.1) << "above the pane";
}

/// Of a point lamp above a pane a sensor that looks down sees the image: I R c / d2.
TEST(Panes, ALampIsReflectedInOne) {
  Scene scene = under_a_pane(2);
  add_point_light(scene, {0, 3, 0}, 1000);
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  for (const float x : {0.f, 0.5f, 2.f}) {
    RandomStream random(1, Stage::direct_light, 7);
    const SurfacePoint at = receiver(scene, {x, 2.5f, 0}, {0, -1, 0});
    const double d = std::hypot(static_cast<double>(x), 1.5), cosine = 1.5 / d;
    const double r =
        static_cast<double>(pane_layer(static_cast<float>(cosine), 1.5f, Rgb(1)).reflectance().x);
    EXPECT_NEAR(static_cast<double>(direct_irradiance(rays, lights, at, 16, random).irradiance.y),
                1000 * r * cosine / (d * d), 1e-3);
  }
}

/// Black walls that shine, and a pane: pi L everywhere. The pane's share of it that is reflected comes by
/// images or by gathered rays.
TEST(Panes, GatheredRaysPassThem) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "room", 0, 100));
  add_room(scene, {-1, 0, -1}, {1, 2, 1});
  begin_instance(scene, "pane", add_pane(scene));
  add_quad(scene, {-1, 0.7f, -1}, {0, 0, 2}, {2, 0, 0});
  finalize(scene);
  Gathered gathered(scene);
  const RecordOptions options = gather_options(scene, Quantity::all, -1, 512);
  const double truth = std::numbers::pi * 100;
  const Trial t = gathered.trial({0.2f, 0, 0.1f}, {0, 1, 0}, options, {}, truth, 100);
  EXPECT_NEAR(t.mean, truth, 4 * t.stderr_of_mean + 0.002 * truth);
}

}  // namespace phos::test
