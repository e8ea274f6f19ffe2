// What of a picture is made: layers asked for alone, and more samples where surfaces meet.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "core/sampling.h"
#include "splat/picture/edges.h"
#include "splat/picture/layers.h"
#include "splat/picture/render.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

RenderOptions picture_of(const IrradianceCache& cache, const Camera& camera, int side) {
  RenderOptions options;
  options.width = options.height = side;
  options.pixel_samples = 1;
  options.light_samples = 4;
  options.splat = SplatBy::cpu;
  resolve(options, camera, cache);
  return options;
}

TEST(LayerSet, ReadsNames) {
  const std::vector<std::string> some{"beauty", "Z"};
  const LayerSet set(some);
  EXPECT_TRUE(set.has(Layer::beauty));
  EXPECT_TRUE(set.has(Layer::depth));
  EXPECT_FALSE(set.has(Layer::direct));
  EXPECT_FALSE(set.all());
  EXPECT_TRUE(LayerSet(std::vector<std::string>{"all"}).has(Layer::stderr_));
  EXPECT_THROW(LayerSet(std::vector<std::string>{"beauti"}), Error);
  EXPECT_THROW(LayerSet(std::vector<std::string>{}), Error);
}

/// A layer is the same bits whatever others are made.
TEST(Render, LayersOneByOne) {
  const Scene scene = cornell();
  const RayScene rays(scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  RenderOptions options = picture_of(cache, scene.camera[0], 24);
  options.pixel_samples = 2;
  const Image all = render_scene(rays, cache, options).image;
  for (const char* name : {"beauty", "direct", "indirect", "emission", "stderr", "albedo", "illuminance",
                           "weight", "normal", "position", "Z"}) {
    options.layers = {name};
    const Image one = render_scene(rays, cache, options).image;
    EXPECT_GE(one.channels().size(), 1u) << name;
    EXPECT_LE(one.channels().size(), 3u) << name;
    for (const auto& [channel, values] : one.channels()) {
      ASSERT_TRUE(all.has(channel)) << channel;
      EXPECT_EQ(values, all.channels().at(channel)) << channel;
    }
  }
  options.layers = {"glossy"};
  EXPECT_TRUE(render_scene(rays, cache, options).image.has_layer("glossy")) << "asked for, although black";
}

/// An estimate of direct light may lie below 0; a picture does not, and is the sum of its layers all the
/// same.
TEST(Layers, AreNotBelowNoLight) {
  for (const auto& names : {std::vector<std::string>{"all"}, std::vector<std::string>{"beauty"}}) {
    Layers layers(2, 1, LayerSet(names), 2, 2);
    PixelSample dark, bright;
    dark.direct = Rgb(-3, 1, -1), dark.indirect = Rgb(2), dark.illuminance_lx = -3;
    bright.direct = Rgb(1), bright.illuminance_lx = 1;
    layers.add(0, dark), layers.add(0, bright);
    layers.add(1, bright, 2);
    const Image image = layers.image(std::vector<std::uint16_t>{2, 2});
    const auto at = [&](const char* channel, std::size_t i) { return image.channels().at(channel)[i]; };
    EXPECT_EQ(at("R", 0), 1) << "indirect light alone";
    EXPECT_EQ(at("G", 0), 2) << "and direct light";
    EXPECT_EQ(at("B", 0), 1);
    EXPECT_EQ(at("R", 1), 1);
    if (names[0] != "all") continue;
    EXPECT_EQ(at("direct.R", 0), 0);
    EXPECT_EQ(at("direct.G", 0), 1);
    EXPECT_EQ(at("direct.B", 0), 0);
    EXPECT_EQ(at("illuminance.Y", 0), 0);
    EXPECT_EQ(at("illuminance.Y", 1), 1);
  }
}

TEST(Edges, WhereSurfacesMeet) {
  const AnalyticScene s = furnace(0.5f);
  const RayScene rays(s.scene);
  constexpr int kSide = 100;
  const GBuffer g = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  const std::vector<std::uint32_t> edges = edge_pixels(s.scene, g);
  ASSERT_FALSE(edges.empty());
  EXPECT_LT(edges.size(), g.hit.size() / 5);
  std::vector<bool> edge(g.hit.size());
  for (const std::uint32_t i : edges) edge[i] = true;
  for (std::size_t i = 0; i + 1 < g.hit.size(); ++i) {
    if (i % kSide == kSide - 1) continue;
    const bool turns = glm::dot(Vec3(g.normal[i]), Vec3(g.normal[i + 1])) < 0.5f;
    EXPECT_TRUE(!turns || (edge[i] && edge[i + 1]));
  }
  // A wall seen at a grazing angle has none.
  const AnalyticScene floor = point_light_over_plane();
  const RayScene floor_rays(floor.scene);
  const Camera grazing = look_at({-7, 0.1f, 0}, {0, 0, 0}, {0, 1, 0}, 0.1f);
  const GBuffer flat = trace_gbuffer(floor_rays, grazing, kSide, 8, {0.5f, 0.5f});
  std::size_t beside_sky = 0;
  for (const std::uint32_t i : edge_pixels(floor.scene, flat)) {
    const bool sky = !flat.covered(i) || (i >= kSide && !flat.covered(i - kSide)) ||
                     (i + kSide < flat.hit.size() && !flat.covered(i + kSide)) || !flat.covered(i - 1) ||
                     !flat.covered(i + 1);
    beside_sky += sky;
    EXPECT_TRUE(sky) << i;
  }
}

/// A strip that stands out of a wall, a fifth of a pixel wide, is between pixels, and found all the same.
TEST(Edges, WhereSomethingNarrowerThanAPixelStandsInBetween) {
  Scene scene;
  begin_instance(scene, "wall", add_lambert(scene, "wall", 0.5f));
  add_quad(scene, {-2, -2, 0}, {4, 0, 0}, {0, 2, 0});
  add_quad(scene, {-2, 0.01f, 0}, {4, 0, 0}, {0, 2, 0});
  begin_instance(scene, "strip", add_lambert(scene, "strip", 0.9f));
  add_quad(scene, {-2, 0, 0.1f}, {4, 0, 0}, {0, 0.01f, 0});
  const Camera camera = look_at({0, 0.02f, 4}, {0, 0.02f, 0}, {0, 1, 0}, 2 * std::atan(0.25f));
  scene.camera.push_back(camera);
  finalize(scene);
  constexpr int kSide = 40;  // a pixel is 5 cm
  const RayScene rays(scene);
  const GBuffer g = trace_gbuffer(rays, camera, kSide, kSide, {0.5f, 0.5f});
  for (const Vec4& seen : g.albedo) ASSERT_EQ(seen.w, g.albedo[0].w) << "the strip hides between the pixels";
  std::size_t above = 0, below = 0;
  for (const std::uint32_t i : edge_pixels(scene, g)) {
    const float y = g.position[i].y;
    EXPECT_LT(std::fabs(y), 0.06f);
    (y > 0.01f ? above : below) += 1;
  }
  EXPECT_EQ(above, kSide);
  EXPECT_EQ(below, kSide);
}

/// Samples at edges alone come as close to many samples everywhere as those do at edges.
TEST(Render, EdgeSamplesSmoothEdges) {
  Scene scene;
  begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, 100));
  add_quad(scene, {-5, -5, 0}, {5.3f, 0.4f, 0}, {-0.7f, 10, 0});
  const Camera camera = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.25f));
  scene.camera.push_back(camera);
  finalize(scene);
  const RayScene rays(scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  RenderOptions options = picture_of(cache, camera, 32);
  const auto error = [&](std::int64_t samples, std::int64_t at_edges, const std::vector<float>& truth) {
    options.pixel_samples = samples, options.edge_samples = at_edges;
    const Rendering r = render_scene(rays, cache, options);
    double square = 0;
    const auto light = r.image.channel("emission.G");
    for (std::size_t i = 0; i < truth.size(); ++i)
      square += std::pow(static_cast<double>(light[i] - truth[i]), 2);
    return std::sqrt(square / static_cast<double>(truth.size()));
  };
  options.pixel_samples = 1024;
  const Rendering many = render_scene(rays, cache, options);
  const std::vector<float>& truth = many.image.channels().at("emission.G");
  const double one = error(1, 0, truth), sixteen = error(16, 0, truth);
  EXPECT_GT(one, 2 * sixteen);
  EXPECT_NEAR(error(2, 14, truth) / sixteen, 1, 1e-3) << "the same samples where it matters";
  EXPECT_NEAR(error(1, 15, truth) / sixteen, 1, 0.15) << "as many, the centre among them";
}

/// Light of the records that doubles within a pixel of a crease, in proportion to the place: samples at edges
/// bring its mean, whichever places of pixels were seen before.
TEST(Render, EdgeSamplesHaveTheLightOfTheirOwnPlace) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
  add_quad(scene, {-2, 0, 0}, {0, 0, 2}, {4, 0, 0});
  begin_instance(scene, "wall", add_lambert(scene, "wall", 0.8f));
  add_quad(scene, {-2, 0, 0}, {4, 0, 0}, {0, 2, 0});
  const Camera camera = look_at({0, 1.9f, 1.9f}, {0, 0.03f, 0}, {0, 1, 0}, 2 * std::atan(0.1f));
  scene.camera.push_back(camera);
  finalize(scene);
  const RayScene rays(scene);
  IrradianceCache cache = empty_cache(Quantity::indirect, 1);
  for (const Vec3& up : {Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    IrradianceRecord r;
    r.normal = up, r.irradiance = Rgb(1), r.radius_m = 10;
    for (Vec3& g : r.translation_gradient) g = 10.f * (Vec3(0, 1, 1) - up);
    cache.records.push_back(r);
  }
  RenderOptions options = picture_of(cache, camera, 8);  // a pixel is 7 cm
  options.direct = DirectBy::interleaved;
  const auto light = [&](std::int64_t samples, std::int64_t at_edges) {
    options.pixel_samples = samples, options.edge_samples = at_edges;
    return render_scene(rays, cache, options).image.channels().at("indirect.G");
  };
  const std::vector<float> truth = light(1024, 0);
  for (const auto& [samples, at_edges] : {std::pair{1, 255}, {2, 254}, {4, 252}, {16, 240}}) {
    const std::vector<float> found = light(samples, at_edges);
    for (std::size_t i = 24; i < 40; ++i)  // the crease goes through these two rows
      EXPECT_NEAR(found[i] / truth[i], 1, 0.02) << i << ": " << samples << " + " << at_edges;
  }
}

/// Packets give what single rays give, bit for bit, also where the picture does not fill them.
TEST(GBuffer, PacketsAreSingleRays) {
  const AnalyticScene s = integrating_sphere(0.5f, 1280);
  for (const Scene& scene : {cornell(), s.scene}) {
    for (const char* isa : {"", "sse2"}) {
      const RayScene rays(scene, {isa});
      const GBuffer g = trace_gbuffer(rays, scene.camera[0], 203, 101, {0.3f, 0.7f});
      for (std::size_t i = 0; i < g.hit.size(); ++i) {
        const Ray ray = pixel_ray(scene.camera[0], 203, 101, static_cast<int>(i % 203),
                                  static_cast<int>(i / 203), {0.3f, 0.7f});
        Hit hit;
        ASSERT_EQ(rays.intersect(ray, hit), g.covered(i));
        ASSERT_EQ(hit.distance_m, g.hit[i].distance_m);
        ASSERT_EQ(hit.triangle, g.hit[i].triangle);
        ASSERT_EQ(hit.u, g.hit[i].u);
        ASSERT_EQ(hit.v, g.hit[i].v);
      }
    }
  }
}

/// So do those that ask whether anything is in the way, some of which have no way to go.
TEST(Rays, PacketsAreOccludedAsSingleRaysAre) {
  const Scene scene = cornell();
  for (const char* isa : {"", "sse2"}) {
    const RayScene rays(scene, {isa});
    std::vector<Ray> ray;
    for (std::uint64_t i = 0; i < 1003; ++i) {
      RandomStream random(1, Stage::test, i);
      const Vec3 size = scene.bounds.hi - scene.bounds.lo;
      const Vec3 from = scene.bounds.lo + Vec3(random.uniform(), random.uniform(), random.uniform()) * size;
      ray.push_back(
          {from, sample_uniform_sphere(random.uniform2()), 0, i % 7 == 0 ? -1 : size.x * random.uniform()});
    }
    std::vector<std::uint8_t> blocked(ray.size(), 2);
    rays.occluded(ray, blocked);
    std::size_t free = 0;
    for (std::size_t i = 0; i < ray.size(); ++i) {
      ASSERT_EQ(blocked[i] == 1, ray[i].t_max_m > 0 && rays.occluded(ray[i])) << i;
      ASSERT_LE(blocked[i], 1) << i;
      free += ray[i].t_max_m > 0 && blocked[i] == 0;
    }
    EXPECT_GT(free, 100u);
    EXPECT_LT(free, 800u);
  }
}

}  // namespace
}  // namespace phos::test
