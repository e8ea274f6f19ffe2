// Numbers of rays that follow from an asked noise.
#include "splat/picture/noise_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"

namespace phos::test {
namespace {

/// A square lamp over a floor. A screen hides a part of the lamp from each place.
Scene half_hidden() {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  begin_instance(scene, "screen", add_lambert(scene, "black", 0));
  add_quad(scene, {-4, 1, -4}, {0, 0, 8}, {4, 0, 0});
  begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, 1000));
  add_quad(scene, {-2, 2, -2}, {4, 0, 0}, {0, 0, 4});
  scene.camera.push_back(look_at({0.1f, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 1}, 0.8f));
  finalize(scene);
  return scene;
}

NoiseTarget target_of(const RayScene& rays, double noise, RenderOptions& render) {
  render.noise = noise, render.direct = DirectBy::traced;
  render.splat = SplatBy::cpu, render.width = 64, render.height = 64;
  IrradianceCache cache;
  cache.accuracy = 0.2;
  resolve(render, rays.scene().camera.front(), cache);
  return choose_rays(rays, cache, render, {}, nullptr);
}

}  // namespace

double rays_of(const Doublings& doublings, const RenderOptions& render) {
  double sum = 0;
  for (const std::uint8_t d : doublings.direct) sum += std::exp2(d);
  return static_cast<double>(render.light_samples) * sum / static_cast<double>(doublings.direct.size());
}

/// As many rays as the noise of each part takes; and every part has about the noise that was asked for.
TEST(NoiseTarget, SendsAsManyRaysAsTheNoiseTakes) {
  const Scene scene = half_hidden();
  const RayScene rays(scene);
  RenderOptions coarse, fine;
  const NoiseTarget found = target_of(rays, 0.05, coarse);
  EXPECT_TRUE(found.enough);
  EXPECT_GT(found.direct, 0.005);
  EXPECT_EQ(found.gloss, 0);
  EXPECT_TRUE(found.doublings.gloss.empty());
  const NoiseTarget finer = target_of(rays, 0.02, fine);
  ASSERT_FALSE(finer.doublings.direct.empty());
  // The nearest power of two; and nowhere fewer than in the small pictures.
  const double enough = 64 * found.direct * found.direct / (0.02 * 0.02 / 2);
  EXPECT_GT(rays_of(finer.doublings, fine), std::max(64., enough / std::sqrt(2.)));
  EXPECT_LT(rays_of(finer.doublings, fine), 64 + std::sqrt(2.) * enough);
  EXPECT_EQ(coarse.light_samples, 64);
  EXPECT_EQ(fine.light_samples, 64);
  EXPECT_EQ(fine.gloss_samples, 64);

  RenderOptions impossible;
  const NoiseTarget beyond = target_of(rays, 1e-4, impossible);
  EXPECT_FALSE(beyond.enough);
  EXPECT_EQ(64 << *std::max_element(beyond.doublings.direct.begin(), beyond.doublings.direct.end()), 4096);

  IrradianceCache cache;
  cache.accuracy = 0.2;
  std::vector<Rgb> picture[2];
  for (std::uint64_t seed : {0, 1}) {
    fine.seed = seed;
    picture[seed] = render_scene(rays, cache, fine, {}, nullptr, {}, finer.doublings).image.rgb("direct");
  }
  // Squares of the noise over the light, of strips 8 pixels wide.
  std::vector<double> squares(8, 0), n(8, 0);
  for (std::size_t i = 0; i < picture[0].size(); ++i) {
    const float mean = (luminance(picture[0][i]) + luminance(picture[1][i])) / 2;
    if (!(mean > 0)) continue;
    const auto change = static_cast<double>((luminance(picture[0][i]) - luminance(picture[1][i])) / mean);
    squares[i % 64 / 8] += change * change / 2, n[i % 64 / 8] += 1;
  }
  for (std::size_t strip = 0; strip < 8; ++strip) {
    ASSERT_GT(n[strip], 100) << strip;
    EXPECT_LT(std::sqrt(squares[strip] / n[strip]), 0.02) << strip;
  }
}

TEST(NoiseTarget, LeavesTheNumbersWhereNoneIsAsked) {
  const Scene scene = half_hidden();
  const RayScene rays(scene);
  RenderOptions render;
  render.light_samples = 5;
  choose_rays(rays, IrradianceCache(), render, {}, nullptr);
  EXPECT_EQ(render.light_samples, 5);
}

}  // namespace phos::test
