// Pictures of scenes in an environment: what is behind them, and the light on them by every way there is.
#include <gtest/gtest.h>

#include "splat/direct/interleaved.h"
#include "splat/picture/render.h"
#include "support/environment.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 48;

/// Looks across an open floor towards the horizon: floor below, environment above.
Scene floor_and_sky(const Environment& map, float albedo = 0.5f) {
  Scene scene = open_floor(2, albedo);
  scene.camera.push_back(look_at({0, 1, 3}, {0, 0.6f, 0}, {0, 1, 0}, 0.9f));
  surround(scene, map);
  return scene;
}

RenderOptions options_of(DirectBy direct, std::int64_t light_samples) {
  RenderOptions options;
  options.width = options.height = kSide;
  options.pixel_samples = 1;
  options.light_samples = light_samples;
  options.direct = direct;
  options.splat = SplatBy::cpu;
  options.isa = "sse2";
  return options;
}

Image picture(const Scene& scene, RenderOptions options) {
  const RayScene rays(scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  resolve(options, scene.camera[0], cache);
  return render_scene(rays, cache, options).image;
}

/// Every ray that meets nothing shows the map, in the layer of emission alone.
TEST(Background, IsTheEnvironment) {
  const Environment map = gradient_map(32, 0.3);
  const Scene scene = floor_and_sky(map);
  const Image image = picture(scene, options_of(DirectBy::traced, 4));
  const std::vector<Rgb> beauty = image.rgb(""), emission = image.rgb("emission");
  const std::span<const float> depth = image.channel("Z");
  int sky = 0, ground = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto i = static_cast<std::size_t>(y * kSide + x);
      if (depth[i] > 0) {
        ++ground;
        EXPECT_EQ(emission[i], Rgb(0));
        continue;
      }
      ++sky;
      const Ray ray = pixel_ray(scene.camera[0], kSide, kSide, x, y, {0.5f, 0.5f});
      EXPECT_EQ(emission[i], map.luminance(ray.direction));
      EXPECT_EQ(beauty[i], emission[i]);
    }
  EXPECT_GT(sky, 300);
  EXPECT_GT(ground, 300);
}

/// E on the open floor is the map's own sum, in every way of drawing direct light.
class EveryWay : public testing::TestWithParam<DirectBy> {};

TEST_P(EveryWay, LightsOpenGround) {
  for (const bool sunny : {false, true}) {
    const Environment map =
        sunny ? map_of(32, [](int x, int y) { return Rgb(x == 7 && y == 9 ? 3000.f : 1.f); })
              : gradient_map(32, 0.3);
    const Scene scene = floor_and_sky(map);
    const Image image = picture(scene, options_of(GetParam(), 64));
    const std::vector<Rgb> direct = image.rgb("direct");
    const std::span<const float> depth = image.channel("Z");
    const DVec3 truth = map.irradiance_up_lx();
    DVec3 mean(0);
    double pixels = 0, off = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
      if (!(depth[i] > 0)) continue;
      const DVec3 lx = DVec3(direct[i]) * (std::numbers::pi / 0.5);
      mean += lx, ++pixels;
      off += std::fabs(lx.y - truth.y) > 0.25 * truth.y;
    }
    ASSERT_GT(pixels, 300);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / pixels, truth[c], 0.03 * truth[c]) << sunny;
    EXPECT_LT(off / pixels, 0.05) << sunny;
  }
}

INSTANTIATE_TEST_SUITE_P(Direct, EveryWay,
                         testing::Values(DirectBy::traced, DirectBy::interleaved, DirectBy::shadow_map));

/// Rays that neighbours share cover the sky evenly; that leaves less than independent ones would, and it is
/// what is stated.
TEST(Interleaved, StatesTheErrorThatEvenRaysLeave) {
  const Scene scene = floor_and_sky(gradient_map(32, 0.3));
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const Vec2 middle(0.5f);
  const GBuffer gbuffer = trace_gbuffer(rays, scene.camera[0], kSide, kSide, middle);
  const PixelRays pixel_rays(scene.camera[0], kSide, kSide);
  constexpr std::uint64_t kSeeds = 24;
  for (const int rays_of_each : {1, 4, 16}) {
    std::vector<double> sum(gbuffer.hit.size()), square(sum), stated(sum);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const auto light =
          interleaved_light(rays, lights, gbuffer, pixel_rays, middle, {rays_of_each, 0, 1}, seed);
      for (std::size_t i = 0; i < light.size(); ++i) {
        const auto e = static_cast<double>(light[i].illuminance.y);
        sum[i] += e, square[i] += e * e, stated[i] += light[i].variance.y;
      }
    }
    double real = 0, said = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
      real += (square[i] - sum[i] * sum[i] / kSeeds) / (kSeeds - 1), said += stated[i] / kSeeds;
    const double ratio = std::sqrt(said / real);  // 2.4 to 4.9 if rays were independent
    EXPECT_GT(ratio, 0.85) << rays_of_each;
    EXPECT_LT(ratio, 1.35) << rays_of_each;
  }
}

/// Edges are sampled more often; where some of their samples pass the edge they see the sky.
TEST(Background, IsBlendedAtEdges) {
  const Scene scene = floor_and_sky(constant_map(8, Rgb(1)), 0);
  RenderOptions options = options_of(DirectBy::none, 1);
  const Image plain = picture(scene, options);
  options.edge_samples = 15;
  const Image fine = picture(scene, options);
  int between = 0;
  for (const Rgb& c : fine.rgb("")) {
    EXPECT_LE(c.y, 1.0001f);
    between += c.y > 0.02f && c.y < 0.98f;
  }
  EXPECT_GT(between, 20);
  for (const Rgb& c : plain.rgb("")) EXPECT_TRUE(c.y == 0 || c.y == 1);
}

/// A mirror shows the sky, however long the chain of mirrors.
TEST(Background, IsSeenInMirrors) {
  const Environment map = gradient_map(32, 0.3);
  Scene scene = floor_and_sky(map);
  scene.material[0].model = Model::mirror;
  scene.material[0].ks = Rgb(0.5f);
  finalize(scene);
  const Image image = picture(scene, options_of(DirectBy::traced, 4));
  const std::vector<Rgb> specular = image.rgb("specular");
  const std::span<const float> depth = image.channel("Z");
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto i = static_cast<std::size_t>(y * kSide + x);
      if (!(depth[i] > 0)) continue;
      Vec3 d = pixel_ray(scene.camera[0], kSide, kSide, x, y, {0.5f, 0.5f}).direction;
      d.y = -d.y;
      const Rgb expected = 0.5f * map.luminance(d);
      // On the edge of a texel rounding may take the next one.
      EXPECT_LT(max_component(glm::abs(specular[i] - expected)), 0.15f);
    }
}

}  // namespace
}  // namespace phos::test
