// Light of many lamps by a cut through their hierarchy: unbiased, its stated error true, and few rays.
#include <gtest/gtest.h>

#include "direct/direct_reader.h"
#include "direct/lamp_sampler.h"
#include "support/calibration.h"
#include "support/many_lamps.h"

namespace phos::test {
namespace {

const Vec3 kUp(0, 1, 0);
const Vec3 kPlaces[] = {{5, 0, 15}, {11, 0, 3}, {29, 0, 28}, {58.5f, 0, 1}};

/// All lamps, one ray each.
double all_lx(const RayScene& rays, const Luminaires& lights, const SurfacePoint& at) {
  RandomStream random(1, Stage::test, 0);
  return static_cast<double>(luminance(direct_irradiance(rays, lights, at, 1, random).irradiance));
}

struct Found {
  Calibration calibration;
  double rays = 0, error2 = 0, n = 0;
  void add(const CutLight& light, double truth) {
    const auto lx = static_cast<double>(luminance(Rgb(light.irradiance)));
    calibration.add(lx, static_cast<double>(luminance(Rgb(glm::sqrt(light.variance)))), truth);
    rays += static_cast<double>(light.rays), error2 += (lx / truth - 1) * (lx / truth - 1), n += 1;
  }
};

TEST(LightCut, IsTheSumOfOpenLampsAndStatesItsError) {
  for (const int lamps : {1000, 100000}) {
    const Scene scene = hall_of_lamps(lamps, false);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const LightTree tree(scene, lights);
    Found all;
    for (const Vec3& p : kPlaces) {
      const SurfacePoint at = receiver(scene, p, kUp);
      const double truth = open_hall_lx(scene, p);
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomStream random(seed, Stage::test, 1);
        all.add(light_by_cut(rays, lights, tree, at, 32, random), truth);
      }
    }
    EXPECT_GT(all.calibration.share(), 0.94) << lamps;
    EXPECT_LT(all.calibration.ratio(), 1) << lamps;
    EXPECT_GT(all.calibration.ratio(), 0.5)
        << lamps;  // halves of a node are told as if they were independent
    EXPECT_LT(std::fabs(all.calibration.bias()), 4 / std::sqrt(all.n)) << lamps;
    EXPECT_LT(std::sqrt(all.error2 / all.n), lamps > 1000 ? 0.003 : 0.006) << lamps;
    RecordProperty(std::to_string(lamps), std::to_string(std::sqrt(all.error2 / all.n)));
  }
}

TEST(LightCut, IsUnbiasedBehindPartitions) {
  const Scene scene = hall_of_lamps(1000, true);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  for (const Vec3& p : kPlaces) {
    const SurfacePoint at = receiver(scene, p, kUp);
    const double truth = all_lx(rays, lights, at);
    EXPECT_LT(truth, 0.95 * open_hall_lx(scene, p));
    Found found;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      RandomStream random(seed, Stage::test, 1);
      found.add(light_by_cut(rays, lights, tree, at, 64, random), truth);
    }
    EXPECT_GT(found.calibration.share(), 0.9) << p.x;
    EXPECT_LT(found.calibration.ratio(), 1.1) << p.x;
    EXPECT_LT(std::fabs(found.calibration.bias()), 4 / std::sqrt(found.n)) << p.x;
  }
}

/// A cut of all lamps is exact, and lamps that cannot light the point cost no ray.
TEST(LightCut, OfAllLampsIsExact) {
  Scene scene = hall_of_lamps(100, true);
  for (std::size_t i = 0; i < scene.light.size(); i += 2) scene.light[i].position.y = -1;
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  for (const Vec3& p : kPlaces) {
    RandomStream random(1, Stage::test, 1);
    const SurfacePoint at = receiver(scene, p, kUp);
    const CutLight light = light_by_cut(rays, lights, tree, at, 1000, random);
    EXPECT_NEAR(light.irradiance.y, all_lx(rays, lights, at), 1e-5 * light.irradiance.y);
    EXPECT_EQ(light.variance, DVec3(0));
    EXPECT_TRUE(light.exact);
    EXPECT_EQ(light.rays, 50u);
  }
}

/// One lamp of a thousand for one ray: by the hierarchy the noise is less than half of the noise by power,
/// and the mean is the same.
TEST(LampSampler, ChoosesOfManyByWhatTheyBring) {
  const Scene scene = hall_of_lamps(1000, true);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const LampSampler lamps(rays, lights);
  const std::vector<double> shares = lights.power_shares(0.1);
  for (const Vec3& p : kPlaces) {
    const SurfacePoint at = receiver(scene, p, kUp);
    const double truth = all_lx(rays, lights, at);
    constexpr int kSamples = 20000;
    double sum = 0, squares = 0;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      RandomStream random(i, Stage::test, 2);
      ArrivingLight light;
      lamps.sample(at, {random.uniform(), random.uniform(), random.uniform()}, light);
      const double lx =
          light.certain || !rays.occluded(light.ray) ? static_cast<double>(luminance(light.lux)) : 0;
      sum += lx / kSamples, squares += lx * lx / kSamples;
    }
    const double noise = std::sqrt(squares - sum * sum) / truth;
    EXPECT_NEAR(sum, truth, 4 * noise * truth / std::sqrt(kSamples)) << p.x;
    double by_power = 0;  // mean square, exactly
    std::vector<LampSample> each;
    RandomStream random(1, Stage::test, 0);
    sample_lamps(rays, lights, at, 1, random, each);
    for (const LampSample& lamp : each) {
      const auto lx = static_cast<double>(luminance(lamp.irradiance));
      by_power += lx * lx / shares[lamp.light];
    }
    EXPECT_LT(noise, 0.5 * std::sqrt(by_power - truth * truth) / truth) << p.x;
  }
}

/// To 2 % with a fraction of the rays that a lamp chosen by its power takes, or all lamps.
TEST(DirectReader, ReadsManyLampsByFewRays) {
  for (const int lamps : {2000, 100000}) {
    const Scene scene = hall_of_lamps(lamps, true);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const DirectReader reader(rays, lights);
    ASSERT_TRUE(reader.by_cut());
    Calibration all;
    double sent = 0, met = 0;
    for (const Vec3& p : kPlaces) {
      const SurfacePoint at = receiver(scene, p, kUp);
      const double truth = all_lx(rays, lights, at);
      for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const DirectReading e = reader.read(at, {0.02, 0, false}, seed, 1);
        all.add(static_cast<double>(luminance(e.irradiance)), static_cast<double>(luminance(e.stderr_lx)),
                truth);
        sent += static_cast<double>(e.rays) / 400, met += e.met / 400.0;
      }
    }
    EXPECT_LT(sent, 500) << lamps;
    EXPECT_GT(met, 0.7) << lamps;
    EXPECT_GT(all.share(), 0.92) << lamps;
    EXPECT_LT(std::fabs(all.bias()), 4 / std::sqrt(all.n)) << lamps;
    RecordProperty("rays of " + std::to_string(lamps), std::to_string(sent));
  }
}

}  // namespace
}  // namespace phos::test
