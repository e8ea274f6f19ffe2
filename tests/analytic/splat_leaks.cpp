// Light through thin walls in pictures, with the leak test and without.
#include <gtest/gtest.h>

#include "splat/picture/render.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

/// Two walls of 4 m, a centimetre apart; records on the lit face alone, of radii that reach through. What
/// looks at the second wall's dark front, from between, must be dark.
double leak(LeakTest test, std::uint64_t& missed) {
  const AnalyticScene s = thin_walls(1000, 0.01f);
  const RayScene rays(s.scene);
  IrradianceCache cache = empty_cache(Quantity::indirect, 0.3);
  for (int i = 0; i < 400; ++i) {
    RandomStream random(3, Stage::test, static_cast<std::uint64_t>(i));
    const Vec2 u = random.uniform2();
    IrradianceRecord r;
    r.position = Vec3(3.8f * u.x - 1.9f, 3.8f * u.y - 1.9f, 0), r.normal = {0, 0, 1};
    r.irradiance = Rgb(100);
    r.radius_m = r.distance_m = 3;
    cache.records.push_back(r);
  }
  const auto mean = [&](const Camera& camera, std::uint64_t& misses) {
    RenderOptions options;
    options.width = options.height = 48;
    options.pixel_samples = 1;
    options.splat = SplatBy::cpu;
    options.direct = DirectBy::none;
    options.leak_test = test;
    options.layers = {"illuminance"};
    Scene seen = s.scene;
    seen.camera = {camera};
    const RayScene seen_rays(seen);
    resolve(options, camera, cache);
    const Rendering picture = render_scene(seen_rays, cache, options);
    misses = picture.missed;
    double sum = 0;
    for (const float v : picture.image.channel("illuminance.Y")) sum += static_cast<double>(v);
    return sum / static_cast<double>(picture.image.pixels());
  };
  std::uint64_t lit_missed = 0;
  const double lit = mean(look_at({0, 0, 1.5f}, {0, 0, 0}, {0, 1, 0}, 0.8f), lit_missed);
  EXPECT_NEAR(lit, 100, 1e-3);
  EXPECT_EQ(lit_missed, 0u);
  // Along the gap, tilted towards the second wall: the near plane of no camera fits a look straight on.
  const double dark = mean(look_at({0.5f, 0.5f, -0.005f}, {0.6f, 0.5f, -0.01f}, {0, 1, 0}, 0.05f), missed);
  return dark / lit;
}

TEST(Leaks, ThinWallsInPictures) {
  std::uint64_t missed = 0;
  EXPECT_GT(leak(LeakTest::none, missed), 0.9) << "no leak to mend: the test shows nothing";
  EXPECT_EQ(missed, 0u);
  EXPECT_LT(leak(LeakTest::ray, missed), 1e-3);
  EXPECT_EQ(missed, 48u * 48u) << "dark places are misses, to be filled";
}

/// Where nothing stands between, the leak test changes nothing but the rounding of sums.
TEST(Leaks, LookupsAreSplats) {
  const Scene scene = cornell();
  const Lit lit = light_up(scene, 10000);
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, scene.camera[0], 32, 32, {0.5f, 0.5f});
  const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::indirect, 0.3);
  RenderOptions options;
  options.width = options.height = 32;
  options.pixel_samples = 1;
  options.splat = SplatBy::cpu;
  options.direct = DirectBy::none;
  resolve(options, scene.camera[0], cache);
  std::vector<float> light[2];
  for (const LeakTest test : {LeakTest::none, LeakTest::ray}) {
    options.leak_test = test;
    const Rendering r = render_scene(*lit.rays, cache, options);
    light[test == LeakTest::ray ? 1 : 0] = r.image.channels().at("indirect.G");
    EXPECT_EQ(r.seconds.find("lookups with leak test") != nullptr, test == LeakTest::ray);
    EXPECT_EQ(r.seconds.find("splat") != nullptr, test == LeakTest::none);
  }
  std::size_t same = 0;
  for (std::size_t i = 0; i < light[0].size(); ++i)
    same += std::fabs(light[0][i] - light[1][i]) <= 1e-3f * light[0][i];
  EXPECT_GT(same, light[0].size() * 9 / 10);
}

}  // namespace
}  // namespace phos::test
