// Whole pictures from caches in memory: layers, sizes, misses, and the same bytes on any number of threads.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/parallel.h"
#include "place/read_points.h"
#include "splat/picture/misses.h"
#include "splat/picture/render.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

RenderOptions small_picture(const Camera& camera, const IrradianceCache& cache, int side = 32) {
  RenderOptions options;
  options.width = options.height = side;
  options.pixel_samples = 1;
  options.splat = SplatBy::cpu;
  options.isa = "sse2";
  resolve(options, camera, cache);
  return options;
}

TEST(Resolve, FillsTheSizeInFromTheCamera) {
  Camera camera;
  IrradianceCache cache;
  cache.accuracy = 0.3;
  struct Case {
    float aspect;
    std::int64_t width, height, wide, high;
  };
  for (const Case& c : {Case{2, 0, 0, 1000, 500}, Case{0.5f, 0, 0, 500, 1000}, Case{1, 0, 0, 1000, 1000},
                        Case{2, 300, 0, 300, 150}, Case{2, 0, 300, 600, 300}, Case{2, 70, 30, 70, 30},
                        Case{1000, 100, 0, 100, 1}}) {
    camera.aspect = c.aspect;
    RenderOptions options;
    options.width = c.width, options.height = c.height;
    resolve(options, camera, cache);
    EXPECT_EQ(options.width, c.wide);
    EXPECT_EQ(options.height, c.high);
    EXPECT_EQ(options.accuracy, reading_accuracy(0.3));
  }
  RenderOptions options;
  options.width = options.height = 65536;
  EXPECT_THROW(resolve(options, camera, cache), Error);
  camera.aspect = 1e-6f;
  options.width = 1000, options.height = 0;
  EXPECT_THROW(resolve(options, camera, cache), Error);
}

TEST(Render, SameBytesOnAnyNumberOfThreads) {
  const Scene scene = cornell();
  const Lit lit = light_up(scene, 10000);
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, scene.camera[0], 32, 32, {0.5f, 0.5f});
  const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::indirect, 0.5);
  RenderOptions options = small_picture(scene.camera[0], cache);
  options.pixel_samples = 2;
  options.accuracy = 0.3;  // smaller: some pixels miss
  set_threads(1);
  const Rendering one = render_scene(*lit.rays, cache, options);
  set_threads(2);
  const Rendering two = render_scene(*lit.rays, cache, options);
  set_threads(0);
  EXPECT_EQ(one.image.channels(), two.image.channels());
  EXPECT_EQ(one.missed, two.missed);
  EXPECT_GT(one.missed, 0u);
  ASSERT_EQ(one.misses.size(), two.misses.size());
  for (std::size_t i = 0; i < one.misses.size(); ++i)
    EXPECT_EQ(one.misses[i].position, two.misses[i].position);
}

/// Without records only the lamps light the floor: illuminance.Y is the closed form, and every visible point
/// is a miss.
TEST(Render, AnEmptyCacheLeavesDirectLightAndMisses) {
  const AnalyticScene s = point_light_over_plane();
  const RayScene rays(s.scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  RenderOptions options = small_picture(s.scene.camera[0], cache, 64);
  options.max_misses = 200;
  const Rendering rendering = render_scene(rays, cache, options);
  const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], 64, 64, {0.5f, 0.5f});
  std::uint64_t covered = 0;
  const auto lux = rendering.image.channel("illuminance.Y");
  const std::vector<Rgb> beauty = rendering.image.rgb("");
  for (std::size_t i = 0; i < lux.size(); ++i) {
    if (!gbuffer.covered(i)) {
      EXPECT_EQ(lux[i], 0);
      continue;
    }
    ++covered;
    const double truth = s.irradiance_lx(Vec3(gbuffer.position[i]), {0, 1, 0});
    EXPECT_NEAR(static_cast<double>(lux[i]), truth, 1e-3 * truth);
    EXPECT_NEAR(static_cast<double>(beauty[i].y), truth * 0.5 / M_PI, 1e-3 * truth);
  }
  EXPECT_GT(covered, 1000u);
  EXPECT_EQ(rendering.looked_up, covered);
  EXPECT_EQ(rendering.missed, covered);
  EXPECT_FALSE(rendering.image.has_layer("glossy"));
  EXPECT_FALSE(rendering.image.has_layer("specular"));
  // The first few already cover the picture.
  ASSERT_EQ(rendering.misses.size(), 200u);
  int quadrant[4] = {0, 0, 0, 0};
  for (const Miss& m : rendering.misses) ++quadrant[(m.position.x > 0 ? 1 : 0) + (m.position.z > 0 ? 2 : 0)];
  for (const int n : quadrant) EXPECT_GT(n, 15);
}

/// Illuminance is what falls on a surface, whatever it makes of it: I cos / d2 under a lamp on black, on a
/// mirror, on glass, on metal. Records are looked for on black surfaces, where they may be placed.
TEST(Render, IlluminanceOfWhatReflectsNothingDiffusely) {
  for (const Model model : {Model::lambert, Model::mirror, Model::thin_dielectric, Model::conductor}) {
    AnalyticScene s = point_light_over_plane(2, 1000, 0);
    Material& floor = s.scene.material[0];
    floor.model = model, floor.ks = Rgb(0.9f), floor.alpha_x = floor.alpha_y = 0.5f;
    const RayScene rays(s.scene);
    const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
    RenderOptions options = small_picture(s.scene.camera[0], cache);
    options.layers = {"illuminance", "indirect"};
    for (const DirectBy by : {DirectBy::traced, DirectBy::interleaved, DirectBy::none}) {
      options.direct = by;
      const Rendering rendering = render_scene(rays, cache, options);
      const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], 32, 32, {0.5f, 0.5f});
      const auto lux = rendering.image.channel("illuminance.Y");
      std::uint64_t covered = 0;
      for (std::size_t i = 0; i < lux.size(); ++i) {
        if (!gbuffer.covered(i)) continue;
        ++covered;
        const double truth = by == DirectBy::none ? 0 : s.irradiance_lx(Vec3(gbuffer.position[i]), {0, 1, 0});
        EXPECT_NEAR(static_cast<double>(lux[i]), truth, 1e-3 * truth)
            << static_cast<int>(model) << " " << static_cast<int>(by);
      }
      EXPECT_GT(covered, 200u);
      EXPECT_EQ(rendering.missed, model == Model::lambert ? covered : 0u);
    }
  }
}

/// A floor of which one half is black: indirect light on it goes on over the border as if there were none.
TEST(Render, IlluminanceGoesOnOverABlackHalf) {
  Scene scene = cornell();
  std::uint32_t floor = 0;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t)
    if (geometric_normal(scene, t).y > 0.99f &&
        scene.position[scene.triangle[t].v[0]].y < scene.bounds.lo.y + 1e-3f)
      floor = scene.triangle_instance[t];
  ASSERT_EQ(scene.instance[floor].triangle_count, 2u);
  Instance half = scene.instance[floor];
  half.material = add_lambert(scene, "black", 0);
  half.triangle_count = 1, scene.instance[floor].triangle_count = 1;
  const std::uint32_t of_half = ++half.first_triangle;
  scene.triangle_instance[of_half] = static_cast<std::uint32_t>(scene.instance.size());
  scene.instance.push_back(half);
  const Lit lit = light_up(scene, 100000);
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, scene.camera[0], 64, 64, {0.5f, 0.5f});
  const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::indirect, 0.2);
  RenderOptions options = small_picture(scene.camera[0], cache, 64);
  options.direct = DirectBy::none;
  const Rendering rendering = render_scene(*lit.rays, cache, options);
  const auto lux = rendering.image.channel("illuminance.Y");
  const std::vector<Rgb> indirect = rendering.image.rgb("indirect");
  double sum[2] = {0, 0};
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < lux.size(); ++i) {
    if (i % 64 == 63 || !gbuffer.covered(i) || !gbuffer.covered(i + 1)) continue;
    const std::uint32_t a = gbuffer.hit[i].triangle, b = gbuffer.hit[i + 1].triangle;
    if (!((a == of_half && b == of_half - 1) || (b == of_half && a == of_half - 1))) continue;
    const std::size_t black = a == of_half ? i : i + 1, grey = a == of_half ? i + 1 : i;
    EXPECT_EQ(indirect[black], Rgb(0));
    EXPECT_GT(lux[black], 0);
    sum[0] += static_cast<double>(lux[black]), sum[1] += static_cast<double>(lux[grey]);
    ++pairs;
  }
  EXPECT_GT(pairs, 5);
  EXPECT_NEAR(sum[0] / sum[1], 1, 0.05);
}

TEST(Render, DirectNoneIsDark) {
  const AnalyticScene s = point_light_over_plane();
  const RayScene rays(s.scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  RenderOptions options = small_picture(s.scene.camera[0], cache);
  options.direct = DirectBy::none;
  const Rendering rendering = render_scene(rays, cache, options);
  for (const char* channel : {"R", "direct.G", "indirect.G", "illuminance.Y"})
    for (const float v : rendering.image.channel(channel)) EXPECT_EQ(v, 0) << channel;
}

/// Direct light by shadow rays + indirect records is what records of all light show.
TEST(Render, BothWaysOfDirectLightAgree) {
  const AnalyticScene s = uniform_box(0.5f);
  const Lit lit = light_up(s.scene, 400000);
  const Camera& camera = s.scene.camera[0];
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, camera, 32, 32, {0.5f, 0.5f});
  double mean[2] = {0, 0};
  for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
    const IrradianceCache cache = records_in_view(lit, gbuffer, paths, 0.2);
    const Rendering rendering = render_scene(*lit.rays, cache, small_picture(camera, cache));
    EXPECT_EQ(rendering.missed, 0u);
    for (const float v : rendering.image.channel("illuminance.Y"))
      mean[paths == Quantity::all ? 1 : 0] += static_cast<double>(v) / 1024;
    double direct = 0;
    for (const float v : rendering.image.channel("direct.G")) direct += static_cast<double>(v);
    EXPECT_EQ(direct > 0, paths == Quantity::indirect);
  }
  EXPECT_NEAR(mean[0] / mean[1], 1, 0.02);
}

/// A lamp that covers part of a pixel: anti-aliasing mixes it in by its share.
TEST(Render, PixelSamplesMixEdges) {
  Scene scene;
  begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, 100));
  add_quad(scene, {-5, -5, 0}, {5.25f, 0, 0}, {0, 10, 0});                         // x from -5 to 0.25
  Camera camera = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.25f));  // 2 m high at z = 0
  scene.camera.push_back(camera);
  finalize(scene);
  const RayScene rays(scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  for (const SplatBy by : {SplatBy::cpu, SplatBy::gl}) {
    RenderOptions options = small_picture(camera, cache, 4);  // pixels of 0.5 m: the third is half covered
    options.pixel_samples = 64;
    options.splat = by;
    const Rendering rendering = render_scene(rays, cache, options);
    const auto light = rendering.image.channel("emission.G");
    EXPECT_NEAR(light[4], 100, 1e-3f);
    EXPECT_NEAR(light[6], 50, 3);
    EXPECT_NEAR(light[7], 0, 1e-3f);
  }
}

TEST(Misses, AreReadBackAsTheyWere) {
  const std::string path = std::string(PHOS_SCRATCH) + "/splat-render-misses.csv";
  const std::vector<Miss> misses = {{{1.5f, -2e-7f, 3e6f}, {0, 1, 0}},
                                    {{0.1f, 0.2f, 0.3f}, {0.6f, 0, -0.8f}}};
  write_misses(path, misses);
  const std::vector<SurfaceSample> points = read_points(path);
  ASSERT_EQ(points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(points[i].position, misses[i].position);
    EXPECT_NEAR(glm::distance(points[i].normal, misses[i].normal), 0, 1e-6f);
  }
  write_misses(path, {});
  EXPECT_TRUE(read_points(path).empty());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace phos::test
