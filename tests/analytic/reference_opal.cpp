// Light through sheets that scatter it, by path tracing and from both ends, against closed forms.
#include <gtest/gtest.h>

#include "reference/measure_points.h"
#include "support/opal.h"

namespace phos::test {
namespace {

class Opal : public testing::TestWithParam<ReferenceMethod> {
 protected:
  static std::vector<PointIrradiance> measure(const Scene& scene, const std::vector<SensorPoint>& points,
                                              std::int64_t samples) {
    const RayScene rays(scene);
    const Luminaires lights(scene);
    PointOptions options;
    options.samples = samples;
    return measure_points(rays, lights, points, GetParam(), {}, options).light;
  }
};

TEST_P(Opal, UnderALamp) {
  const OpalUnderALamp opal;
  std::vector<SensorPoint> points;
  for (const float x : {0.f, 0.5f, 0.9f}) points.push_back({{x, 0, 0}, {0, 1, 0}});
  const std::vector<PointIrradiance> light = measure(opal.scene, points, 16384);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = OpalUnderALamp::floor_lx(static_cast<double>(points[i].position.x));
    EXPECT_NEAR(light[i].illuminance_lx, truth, 3 * light[i].illuminance_stderr_lx);
    EXPECT_LT(light[i].illuminance_stderr_lx, 0.02 * truth);
  }
}

TEST_P(Opal, Furnace) {
  const OpalFurnace furnace;
  std::vector<SensorPoint> points;
  for (const Check& c : OpalFurnace::places()) points.push_back({c.position, c.normal});
  for (const PointIrradiance& e : measure(furnace.scene, points, 4096))
    EXPECT_NEAR(e.illuminance_lx, OpalFurnace::kIrradiance_lx,
                3 * e.illuminance_stderr_lx + 0.003 * OpalFurnace::kIrradiance_lx);
}

INSTANTIATE_TEST_SUITE_P(Methods, Opal,
                         testing::Values(ReferenceMethod::path, ReferenceMethod::bidirectional),
                         [](const auto& info) {
                           return info.param == ReferenceMethod::path ? "Path" : "Bidirectional";
                         });

}  // namespace
}  // namespace phos::test
