// Direct light of measured luminaires where records gather it: closed forms, and the sampler of lamps.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "direct/lamp_sampler.h"
#include "support/luminaires.h"

namespace phos::test {
namespace {

TEST(MeasuredDirectLight, AgreesWithTheClosedForm) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    for (const AnalyticScene& s : {measured_point_over_plane(size), measured_rectangle(size)}) {
      const RayScene rays(s.scene);
      const Luminaires lights(s.scene);
      for (const Check& check : s.checks) {
        RandomStream random(3, Stage::direct_light, 0);
        const DirectIrradiance e =
            direct_irradiance(rays, lights, receiver(s.scene, check.position, check.normal), 4096, random);
        EXPECT_NEAR(e.irradiance.y, check.irradiance_lx, 2e-3 * check.irradiance_lx) << s.name;
      }
    }
  }
}

/// One lamp of many kinds at a time, by its promise: the mean of samples is the sum of all closed forms.
TEST(MeasuredDirectLight, LampsAreChosenWithoutBias) {
  AnalyticScene s = measured_point_over_plane();
  const auto narrow =
      luminaire({[](double, double g) { return g <= 30 ? 2000 * (1 - g / 30) : 0.0; }, 360, 30, 60});
  hang(s.scene, narrow, {1, 2, 1});
  hang(s.scene, luminaire(lambertian(500), {LuminousOpening::Form::box, {1, 0.5f, 0}}), {-1, 3, 0});
  add_point_light(s.scene, {0, 1, -2}, 70);
  finalize(s.scene);
  ASSERT_EQ(s.scene.light.size(), 4u);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const LampSampler sampler(rays, lights);
  for (const Check& check : s.checks) {
    RandomStream random(3, Stage::direct_light, 0);
    const SurfacePoint point = receiver(s.scene, check.position, check.normal);
    const double truth = direct_irradiance(rays, lights, point, 16384, random).irradiance.y;
    double sum = 0, square = 0;
    constexpr int kSamples = 100000;
    for (int k = 0; k < kSamples; ++k) {
      ArrivingLight light;
      RandomStream random(4, Stage::test, static_cast<std::uint64_t>(k));
      sampler.sample(point, {random.uniform(), random.uniform(), random.uniform()}, light);
      const bool arrives = light.lux.y > 0 && (light.certain || !rays.occluded(light.ray));
      const double e = arrives ? static_cast<double>(light.lux.y) : 0;
      sum += e, square += e * e;
    }
    const double mean = sum / kSamples, error = std::sqrt((square / kSamples - mean * mean) / kSamples);
    EXPECT_NEAR(mean, truth, 4 * error + 1e-3 * truth);
    EXPECT_LT(error, 0.02 * truth);
  }
}

}  // namespace
}  // namespace phos::test
