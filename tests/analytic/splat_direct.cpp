// Direct light at visible points, by shadow rays and by shadow maps, against closed forms (derivations:
// tests/support/scenes.h).
#include <gtest/gtest.h>

#include "estimate/shading.h"
#include "record/tree.h"
#include "scene/lamp/form.h"
#include "scene/picture.h"
#include "splat/direct/edge_light.h"
#include "splat/direct/interleaved.h"
#include "splat/gl/renderer.h"
#include "support/daylight.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 48;

/// What arrives straight from the lamps where `truth` counts all bounces; nothing but the furnace reflects
/// onto what is looked at.
double direct_lx(const AnalyticScene& s, const Check& check) {
  return s.name == "furnace" ? std::numbers::pi * static_cast<double>(s.scene.material[0].emission.x)
                             : check.irradiance_lx;
}

class EveryLitScene : public testing::TestWithParam<std::size_t> {};

/// A Lambert surface under E reflects rho E / pi. The stated variance is that of independent samples; the
/// points are of low discrepancy, so the error is less.
TEST_P(EveryLitScene, ShadowRaysAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordTree no_records(s.scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  std::uint64_t item = 0;
  for (const Check& check : s.checks) {
    const Vec3 from = check.position + 0.004f * check.normal;
    SurfacePoint point;
    ASSERT_TRUE(trace(rays, {from, -check.normal}, point)) << s.name;
    const Bsdf bsdf(s.scene, point);
    const double truth = direct_lx(s, check);
    for (const int samples : {1, 16, 4096}) {
      RandomStream random(1, Stage::test, item++);
      const DirectLight light = shading.direct(point, bsdf, check.normal, samples, 0, random);
      const double scale = std::numbers::pi / static_cast<double>(bsdf.diffuse_reflectance().y);
      const double e = static_cast<double>(light.radiance.y) * scale;
      EXPECT_NEAR(static_cast<double>(light.illuminance.y), e, 1e-4 * e) << s.name;
      if (samples == 1 && s.scene.light[0].kind == Light::Kind::area) continue;
      const double error = std::sqrt(static_cast<double>(light.variance.y)) * scale;
      EXPECT_NEAR(e, truth, 4 * error + 1e-3 * truth) << s.name << ", " << samples;
      if (samples == 4096) {
        EXPECT_LT(error, 0.05 * truth + 1e-9) << s.name;
      }
    }
  }
}

/// All but the furnace and the glowing environment, where every wall is a lamp.
class SceneWithDarkSurfaces : public testing::TestWithParam<std::size_t> {};

/// Shadow maps are a preview: most pixels within a tenth, the mean within a twentieth.
TEST_P(SceneWithDarkSurfaces, ShadowMapsComeClose) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const RayScene rays(s.scene);
  const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  GlRenderer gl(s.scene);
  const std::vector<Rgb> light = gl.direct_illuminance(gbuffer, 256, 512);
  std::vector<double> value(light.size()), no_error(light.size(), 0);
  for (std::size_t i = 0; i < light.size(); ++i) value[i] = static_cast<double>(light[i].y);
  const Agreement a = compare(s, gbuffer, value, no_error, 0.1);
  EXPECT_GT(a.pixels, 300) << s.name;
  EXPECT_GT(a.within, 0.9) << s.name;
  EXPECT_LT(std::fabs(a.relative_bias), 0.05) << s.name;
}

/// One pass of interleaved rays over a scene, as pixels of illuminance.
struct Interleaved {
  Interleaved(const AnalyticScene& s, int rays_of_each) : rays(s.scene), lights(s.scene) {
    const Vec2 middle(0.5f);
    gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, middle);
    light = interleaved_light(rays, lights, gbuffer, PixelRays(s.scene.camera[0], kSide, kSide), middle,
                              {rays_of_each, 0, 1}, 1);
    for (const SharedLight& l : light) {
      value.push_back(static_cast<double>(l.illuminance.y));
      error.push_back(std::sqrt(static_cast<double>(l.variance.y)));
    }
  }
  RayScene rays;
  Luminaires lights;
  GBuffer gbuffer;
  std::vector<SharedLight> light;
  std::vector<double> value, error;
};

/// Pixels share rays with their own surface alone: the mean holds, and what light changes over four pixels is
/// all the blur there is.
TEST_P(SceneWithDarkSurfaces, InterleavedRaysAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const Interleaved four(s, 4);
  const Agreement a = compare(s, four.gbuffer, four.value, four.error, 0.05);
  EXPECT_GT(a.pixels, 300) << s.name;
  EXPECT_GT(a.within, 0.97) << s.name;
  EXPECT_LT(std::fabs(a.relative_bias), 0.01) << s.name;
}

/// A lamp that is seen whole is the closed form, and noise is left at shadows alone.
TEST(Interleaved, HasNoNoiseWhereTheLampIsSeenWhole) {
  const AnalyticScene s = rectangle_light_parallel();
  const Interleaved shared(s, 1);
  std::size_t whole = 0;
  for (std::size_t i = 0; i < shared.light.size(); ++i) {
    const Vec3 p(shared.gbuffer.position[i]), normal(shared.gbuffer.normal[i]);
    if (!shared.gbuffer.covered(i) || normal.y < 0.5f || p.y > 0.1f) continue;
    if (shared.light[i].variance != DVec3(0)) continue;
    const double truth = s.irradiance_lx(p, normal);
    EXPECT_NEAR(shared.value[i], truth, 1e-4 * truth);
    ++whole;
  }
  EXPECT_GT(whole, 300u);
}

/// Sixteen times as many rays' worth: the error of one ray each is well below that of single rays alone.
TEST(Interleaved, SharesWhatNeighboursFind) {
  const AnalyticScene s = rectangle_light_parallel();
  const Interleaved shared(s, 1);
  const RecordTree no_records(s.scene.bounds, 0.2);
  const Shading shading(shared.rays, shared.lights, no_records, {});
  double own = 0, together = 0, n = 0;
  for (std::size_t i = 0; i < shared.light.size(); ++i) {
    if (!shared.gbuffer.covered(i)) continue;
    const Vec3 p(shared.gbuffer.position[i]), normal(shared.gbuffer.normal[i]);
    if (normal.y < 0.5f || p.y > 0.1f) continue;
    const double truth = s.irradiance_lx(p, normal);
    RandomStream random(1, Stage::test, i);
    SurfacePoint point;
    ASSERT_TRUE(trace(shared.rays, {p + 0.004f * normal, -normal}, point));
    const DirectLight alone = shading.direct(point, Bsdf(s.scene, point), normal, 1, 0, random);
    own += std::pow(static_cast<double>(alone.illuminance.y) - truth, 2);
    together += std::pow(shared.value[i] - truth, 2), n += 1;
  }
  ASSERT_GT(n, 300);
  EXPECT_LT(std::sqrt(together / n), 0.4 * std::sqrt(own / n));
}

/// Samples of one pixel, all on one surface.
struct PixelSamples {
  PixelSamples(const RayScene& rays, const Camera& camera, std::size_t at, std::size_t count) : pixel(at) {
    const PixelRays pixel_rays(camera, kSide, kSide);
    for (std::size_t s = 0; s < count; ++s)
      ray.push_back(pixel_rays(static_cast<int>(at % kSide), static_cast<int>(at / kSide),
                               subpixel_offset(static_cast<int>(s), static_cast<int>(count))));
    hit.resize(count);
    rays.intersect(ray, hit);
    for (std::uint32_t s = 0; s < count; ++s) all.push_back(s);
  }
  bool on_one_triangle() const {
    return std::all_of(hit.begin(), hit.end(), [&](const Hit& h) {
      return std::isfinite(h.distance_m) && h.triangle == hit[0].triangle;
    });
  }
  EdgeSamples samples() const { return {pixel, 0, ray, hit, all}; }
  std::size_t pixel;
  std::vector<Ray> ray;
  std::vector<Hit> hit;
  std::vector<std::uint32_t> all;
};

/// What samples of a pixel find together is the closed form, lamps of all kinds.
TEST_P(SceneWithDarkSurfaces, SamplesOfAPixelAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, Vec2(0.5f));
  const EdgeLight edge(rays, lights, 1, 1);
  EdgeLight::Scratch scratch;
  double pixels = 0, within = 0, sum = 0, truths = 0;
  for (std::size_t i = 0; i < gbuffer.hit.size(); ++i) {
    const PixelSamples pixel(rays, s.scene.camera[0], i, 16);
    if (!gbuffer.covered(i) || !pixel.on_one_triangle()) continue;
    if (!(max_component(s.scene.material_of(gbuffer.hit[i].triangle).kd) > 0)) continue;
    double truth = 0;
    for (const std::uint32_t k : pixel.all) {
      const SurfacePoint p = rays.surface(pixel.ray[k], pixel.hit[k]);
      truth += s.irradiance_lx(p.position, p.normal) / 16;
    }
    if (!(truth > 0)) continue;
    const SharedLight light = edge.light(pixel.samples(), nullptr, scratch);
    const auto value = static_cast<double>(light.illuminance.y);
    ++pixels, sum += value, truths += truth;
    within += std::fabs(value - truth) <= 0.05 * truth + 3 * std::sqrt(light.variance.y / 16);
  }
  EXPECT_GT(pixels, 300) << s.name;
  EXPECT_GT(within / pixels, 0.97) << s.name;
  EXPECT_NEAR(sum / truths, 1, 0.01) << s.name;
}

/// A lamp above a floor, `reach` m to each side or as far as x = `right` of these, and a roof that hides half
/// of it from the middle, turned about the vertical.
Scene lit_floor(bool roofed, float turn = 0, float right = 1, float reach = 1) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f, 0));
  add_quad(scene, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
  begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, 100));
  add_quad(scene, {-reach, 4, -reach}, {reach * (right + 1), 0, 0}, {0, 0, 2 * reach});
  if (roofed) {
    begin_instance(scene, "roof", add_lambert(scene, "roof", 0, 0));
    const Vec3 along(std::sin(turn), 0, std::cos(turn)), away(along.z, 0, -along.x);
    add_quad(scene, Vec3(0, 2, 0) - 9.f * along, 18.f * along, 9.f * away);
  }
  scene.camera.push_back(look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 0.1f));
  finalize(scene);
  return scene;
}
/// Of its picture, the four pixels about the middle.
constexpr std::size_t kMiddle = (kSide / 2 - 1) * kSide + kSide / 2 - 1;
constexpr std::size_t kFour[] = {kMiddle, kMiddle + 1, kMiddle + kSide, kMiddle + kSide + 1};

/// Half of a lamp is hidden: half of the light, by symmetry, with about the error that is stated.
TEST(EdgeLight, HalfALampIsHalfTheLight) {
  constexpr int kTurns = 40, kSeeds = 20, kSamples = 24;
  double sum = 0, square = 0, stated = 0, half = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Scene scene = lit_floor(true, (static_cast<float>(turn) + 0.5f) / kTurns * kPi / 2);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    ASSERT_EQ(lights.size(), 1u);
    half = 50 * static_cast<double>(LampForm(scene, lights[0]).projected_solid_angle({0, 0, 0}, {0, 1, 0}));
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const EdgeLight edge(rays, lights, 1, seed);
      EdgeLight::Scratch scratch;
      double mean = 0, variance = 0;  // of the four: that of the middle
      for (const std::size_t i : kFour) {
        const PixelSamples pixel(rays, scene.camera[0], i, kSamples);
        const SharedLight light = edge.light(pixel.samples(), nullptr, scratch);
        mean += static_cast<double>(light.illuminance.y) / 4;
        variance += light.variance.y / kSamples / 16;
      }
      sum += mean, square += (mean - half) * (mean - half), stated += variance;
    }
  }
  const double n = kTurns * kSeeds, error = std::sqrt(square / n);
  EXPECT_NEAR(sum / n, half, 4 * error / std::sqrt(n) + 0.001 * half);
  EXPECT_LT(error, 0.05 * half);
  EXPECT_GT(std::sqrt(stated / n), error);
  EXPECT_LT(std::sqrt(stated / n), 2 * error);
}

/// In half shadow, as many rays as the option takes, of which only some are on their way at once.
TEST(Interleaved, AnyNumberOfRays) {
  const Scene scene = lit_floor(true);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const double half =
      50 * static_cast<double>(LampForm(scene, lights[0]).projected_solid_angle({0, 0, 0}, {0, 1, 0}));
  constexpr int kFew = 6;
  const GBuffer gbuffer = trace_gbuffer(rays, scene.camera[0], kFew, kFew, Vec2(0.5f));
  for (const int count : {255, 65535, 65536}) {
    const auto light = interleaved_light(rays, lights, gbuffer, PixelRays(scene.camera[0], kFew, kFew),
                                         Vec2(0.5f), {count, 0, 1}, 1);
    double mean = 0;
    for (const SharedLight& l : light) {
      mean += static_cast<double>(l.illuminance.y) / kFew / kFew;
      EXPECT_GT(l.variance.y, 0) << count;
      EXPECT_LT(std::sqrt(l.variance.y), half / std::sqrt(static_cast<double>(count))) << count;
    }
    EXPECT_NEAR(mean, half, 0.01 * half) << count;
  }
}

/// The half shadow of the roof's edge, 18 pixels wide: from below it a point sees the lamp as far as its own
/// distance on the other side.
struct HalfShadow {
  explicit HalfShadow(float reach = 1) : scene(lit_floor(true, 0, 1, reach)) {
    scene.camera[0] = look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 2.4f);
    gbuffer = trace_gbuffer(RayScene(scene), scene.camera[0], kSide, kSide, Vec2(0.5f));
    for (std::size_t i = 0; i < gbuffer.hit.size(); ++i) {
      const Vec3 p(gbuffer.position[i]);
      const Scene seen = lit_floor(false, 0, std::clamp(-p.x / reach, -0.9999f, 1.f), reach);
      truth.push_back(
          100 * static_cast<double>(LampForm(seen, Luminaires(seen)[0]).projected_solid_angle(p, {0, 1, 0})));
      mean += truth.back() / static_cast<double>(gbuffer.hit.size());
    }
  }
  /// Root mean square, relative to the mean, of so many passes together.
  double error(int rays_of_each, int passes) const {
    const RayScene rays(scene);
    const Luminaires lights(scene);
    std::vector<double> sum(truth.size(), 0);
    for (int pass = 0; pass < passes; ++pass) {
      const auto light = interleaved_light(rays, lights, gbuffer, PixelRays(scene.camera[0], kSide, kSide),
                                           Vec2(0.5f), {rays_of_each, pass, passes}, 1);
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += static_cast<double>(light[i].illuminance.y) / passes;
    }
    double square = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      square += std::pow(sum[i] - truth[i], 2) / static_cast<double>(truth.size());
    return std::sqrt(square) / mean;
  }
  Scene scene;
  GBuffer gbuffer;
  std::vector<double> truth;
  double mean = 0;
};

TEST(Interleaved, BlursLessWithMoreRaysAndInTheEndNotAtAll) {
  const HalfShadow shadow;
  double before = HUGE_VAL;
  for (const auto& [count, most] : {std::pair{8, 0.04}, {64, 0.012}, {1024, 0.001}}) {
    const double error = shadow.error(count, 1);
    EXPECT_LT(error, most) << count;
    EXPECT_LT(error, 0.6 * before) << count;
    before = error;
  }
}

/// Of the sun and the sky together, the shadow's edge lies between two pixels, not over four of them: under a
/// roof that begins at x = 0, with half a pixel of penumbra.
TEST(Interleaved, TheSunsShadowHasAnEdge) {
  Scene scene = under_an_edge(3, 20);
  scene.camera.push_back(look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 2.4f));
  constexpr double kSun_lx = 80'000, kSky_lx = 10'000;
  surround(scene, sky_of("overcast", "180,90", kSky_lx, kSun_lx));
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const GBuffer gbuffer = trace_gbuffer(rays, scene.camera[0], kSide, kSide, Vec2(0.5f));
  const auto light = interleaved_light(rays, lights, gbuffer, PixelRays(scene.camera[0], kSide, kSide),
                                       Vec2(0.5f), {64, 0, 1}, 1);
  double square = 0;
  int n = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double x = static_cast<double>(gbuffer.position[i].x), pixel_m = 0.1;
    if (std::fabs(x) < pixel_m || std::fabs(x) > 3 * pixel_m) continue;
    const double from_sky = 0.5 * kSky_lx;  // about
    const double off = static_cast<double>(light[i].illuminance.y) - from_sky - (x > 0 ? kSun_lx : 0);
    square += off * off, ++n;
  }
  ASSERT_GT(n, 100);
  EXPECT_LT(std::sqrt(square / n), 0.04 * kSun_lx);
}

/// Of a pixel that sees most of a lamp, a ray that happens to be blocked says no more than one that is not;
/// and of a lamp that is wide as seen, the rays of one pass meet its bright and its dim parts unevenly. With
/// more than one ray the first alone looks for shadows, and misses a little of them.
TEST(Interleaved, PassesOfFewRaysAreRightTogether) {
  struct Case {
    float reach;  // of the lamp
    double of_64, of_1024, of_1024_and_one;
  };
  for (const Case& c : {Case{1, 0.012, 0.007, 0.0015}, {8, 0.05, 0.02, 0.008}}) {
    const HalfShadow shadow(c.reach);
    for (const int rays : {1, 2, 4, 8}) {
      EXPECT_LT(shadow.error(rays, 64 / rays), c.of_64) << c.reach << ", " << rays;
      EXPECT_LT(shadow.error(rays, 1024 / rays), rays == 1 ? c.of_1024_and_one : c.of_1024)
          << c.reach << ", " << rays;
    }
  }
}

/// Whatever the pixel about them says, samples find half a lamp where half of it is to be seen, and all of
/// one.
TEST(EdgeLight, NeighboursArePutToTheTest) {
  for (const bool roofed : {false, true}) {
    const Scene scene = lit_floor(roofed);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const float lux = 100 * LampForm(scene, lights[0]).projected_solid_angle({0, 0, 0}, {0, 1, 0});
    const EdgeLight edge(rays, lights, 1, 1);
    EdgeLight::Scratch scratch;
    const PixelSamples pixel(rays, scene.camera[0], kMiddle, 24);
    const SharedLight whole{Rgb(lux), DVec3(0)}, in_doubt{Rgb(lux), DVec3(1)}, dark;
    for (const SharedLight* about : {&whole, &in_doubt, &dark, static_cast<const SharedLight*>(nullptr)})
      EXPECT_NEAR(edge.light(pixel.samples(), about, scratch).illuminance.y, roofed ? lux / 2 : lux,
                  0.1f * lux);
  }
}

/// Beside a lamp light changes much within a pixel: what one sample finds, and the pixel about agrees with,
/// is not what all of them find.
TEST(EdgeLight, SteepLightIsTheMeanOfThePixel) {
  const AnalyticScene s = rectangle_light_perpendicular();
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const EdgeLight edge(rays, lights, 1, 1);
  EdgeLight::Scratch scratch;
  int steep = 0;
  for (std::size_t i = 0; i < std::size_t{kSide} * kSide; ++i) {
    const PixelSamples pixel(rays, s.scene.camera[0], i, 64);
    if (!pixel.on_one_triangle()) continue;
    double mean = 0;
    const auto at = [&](std::size_t k) {
      const SurfacePoint p = rays.surface(pixel.ray[k], pixel.hit[k]);
      return s.irradiance_lx(p.position, p.normal);
    };
    for (std::size_t k = 0; k < 64; ++k) mean += at(k) / 64;
    if (!(mean > 0) || std::fabs(at(0) - mean) < 0.03 * mean) continue;
    ++steep;
    const SharedLight about{Rgb(static_cast<float>(at(0))), DVec3(0)};
    EXPECT_NEAR(edge.light(pixel.samples(), &about, scratch).illuminance.y, mean, 0.025 * mean) << i;
  }
  EXPECT_GT(steep, 10);
}

/// Rays that all agree may all have missed something: a beam so thin that the samples of a pixel see none, or
/// all, of its shadow is within what they say.
TEST(EdgeLight, SaysThatItMayHaveMissedSomething) {
  double lit = 0, within = 0, stated2 = 0, error2 = 0;
  for (int turn = 0; turn < 20; ++turn) {
    Scene scene = lit_floor(false);
    const float angle = (static_cast<float>(turn) + 0.5f) / 20 * kPi;
    const Vec3 along(std::sin(angle), 0, std::cos(angle)), across(along.z, 0, -along.x);
    begin_instance(scene, "beam", 0);
    add_quad(scene, Vec3(0.1f, 3.f, 0) - 9.f * along, 18.f * along, 0.06f * across);  // hides some 4 %
    finalize(scene);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const float lux = 100 * LampForm(scene, lights[0]).projected_solid_angle({0, 0, 0}, {0, 1, 0});
    const SharedLight whole{Rgb(lux), DVec3(0)};
    // The truth, by very many rays.
    const PixelSamples many(rays, scene.camera[0], kMiddle, 4096);
    EdgeLight::Scratch scratch;
    const double truth = static_cast<double>(
        EdgeLight(rays, lights, 4, 7).light(many.samples(), nullptr, scratch).illuminance.y);
    EXPECT_LT(truth, 0.99 * static_cast<double>(lux));
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const PixelSamples pixel(rays, scene.camera[0], kMiddle, 24);
      const SharedLight light = EdgeLight(rays, lights, 1, seed).light(pixel.samples(), &whole, scratch);
      const double error = static_cast<double>(light.illuminance.y) - truth,
                   stated = std::sqrt(light.variance.y / 24);
      lit += 1, within += std::fabs(error) <= 2 * stated;
      error2 += error * error, stated2 += stated * stated;
    }
  }
  EXPECT_GT(within / lit, 0.9);
  EXPECT_GT(stated2, 0.4 * error2);
  EXPECT_LT(stated2, 4 * error2);
}

INSTANTIATE_TEST_SUITE_P(Most, SceneWithDarkSurfaces, testing::Values(0, 1, 2, 8, 9));
INSTANTIATE_TEST_SUITE_P(All, EveryLitScene, testing::Range<std::size_t>(0, 10));

}  // namespace
}  // namespace phos::test
