// Direct light by as many rays as a stated error takes: the error is met, it is the true one or more, and the
// estimate is unbiased.
#include <gtest/gtest.h>

#include "direct/direct_reader.h"
#include "support/calibration.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

struct Found {
  Calibration calibration;
  double met = 0, rays = 0;
};

Found read_often(const AnalyticScene& s, const Check& check, double error, std::uint64_t seeds) {
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const DirectReader reader(rays, lights);
  Found found;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const DirectReading e =
        reader.read(receiver(s.scene, check.position, check.normal), {error, 0, false}, seed, 3);
    found.calibration.add(static_cast<double>(luminance(e.irradiance)),
                          static_cast<double>(luminance(e.stderr_lx)), check.irradiance_lx);
    found.met += e.met / static_cast<double>(seeds);
    found.rays += static_cast<double>(e.rays) / static_cast<double>(seeds);
  }
  return found;
}

TEST(DirectReader, MeetsTheErrorOfRectangles) {
  for (const AnalyticScene& s : {rectangle_light_parallel(), rectangle_light_perpendicular()})
    for (const double error : {0.01, 0.003}) {
      Calibration all;
      for (const Check& check : s.checks) {
        const Found found = read_often(s, check, error, 100);
        EXPECT_GT(found.met, 0.85) << found.rays << " "
                                   << std::sqrt(found.calibration.stated2 / found.calibration.n) /
                                          check.irradiance_lx
                                   << " " << s.name << " " << error;
        EXPECT_LT(found.rays, 1000) << s.name << " " << error;
        all.add(found.calibration);
      }
      EXPECT_GT(all.share(), 0.93) << s.name;
      EXPECT_LT(all.ratio(), 1.05) << s.name;
      EXPECT_LT(std::fabs(all.bias()), 4 / std::sqrt(all.n)) << s.name;
    }
}

/// A smaller error takes more rays, and light that is known already takes fewer.
TEST(DirectReader, RaysFollowTheError) {
  const AnalyticScene s = rectangle_light_parallel();
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const DirectReader reader(rays, lights);
  const SurfacePoint at = receiver(s.scene, s.checks[1].position, s.checks[1].normal);
  const double lx = s.checks[1].irradiance_lx;
  const auto number = [&](double error, double known_lx, bool holds_direct) {
    return reader.read(at, {error, known_lx, holds_direct}, 1, 0).rays;
  };
  EXPECT_GT(number(0.0003, 0, false), 3 * number(0.001, 0, false));
  EXPECT_LT(number(0.0003, 9 * lx, false), number(0.0003, 0, false) / 2);
  EXPECT_NEAR(static_cast<double>(number(0.0003, lx, true)), static_cast<double>(number(0.0003, 0, false)),
              0.1 * static_cast<double>(number(0.0003, 0, false)));
}

/// Point lamps are known by a ray each.
TEST(DirectReader, PointLampsTakeOneRay) {
  const AnalyticScene s = point_light_over_plane();
  for (const Check& check : s.checks) {
    const Found found = read_often(s, check, 0.01, 2);
    EXPECT_EQ(found.rays, 1);
    EXPECT_EQ(found.met, 1);
    EXPECT_EQ(found.calibration.share(), 1);
  }
}

/// Half of a rectangle hidden, and a second lamp far away: each has rays by its own noise.
TEST(DirectReader, NoiseDecidesWhichLampHasTheRays) {
  AnalyticScene s = rectangle_light_parallel();
  const double alone_lx = s.checks[0].irradiance_lx;
  begin_instance(s.scene, "far", s.scene.instance[1].material);
  const Vec3 far(0, 200, 0);
  add_quad(s.scene, far, {1, 0, 0}, {0, 0, 1});
  s.scene.light.clear();
  finalize(s.scene);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  ASSERT_EQ(lights.size(), 2u);
  const SurfacePoint at = receiver(s.scene, s.checks[0].position, s.checks[0].normal);
  const DirectReading e = DirectReader(rays, lights).read(at, {0.0005, 0, false}, 1, 0);
  EXPECT_TRUE(e.met);
  EXPECT_NEAR(static_cast<double>(e.irradiance.y), alone_lx, 0.01 * alone_lx);
  const AnalyticScene one = rectangle_light_parallel();
  const RayScene one_rays(one.scene);
  const Luminaires one_light(one.scene);
  const DirectReading alone = DirectReader(one_rays, one_light).read(at, {0.0005, 0, false}, 1, 0);
  EXPECT_LT(static_cast<double>(e.rays), 1.1 * static_cast<double>(alone.rays) + 80);
}

}  // namespace
}  // namespace phos::test
