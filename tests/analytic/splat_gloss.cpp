// Pictures of a glossy sheet under known light, from radiance records.
#include <gtest/gtest.h>

#include <numbers>

#include "scene/material/bsdf.h"
#include "splat/gbuffer.h"
#include "splat/picture/render.h"
#include "support/gloss_scenes.h"
#include "support/radiance_records.h"

namespace phos {
namespace {

constexpr double kAccuracy = 0.3;
constexpr int kSide = 24;

/// A sheet in the plane y = 0, seen at a slant; a lamp above it if asked for.
struct Sheet {
  Scene scene;
  explicit Sheet(bool lamp, float scale = 1) {
    Material m;
    m.name = "sheet", m.model = Model::phong;
    m.kd = Rgb(0.2f, 0.1f, 0.3f), m.ks = Rgb(0.5f, 0.6f, 0.4f), m.exponent = 12;
    scene.material.push_back(m);
    test::begin_instance(scene, "sheet", 0);
    test::add_quad(scene, Vec3(-1, 0, -1) * scale, Vec3(0, 0, 2) * scale, Vec3(2, 0, 0) * scale);
    if (lamp) {
      test::begin_instance(scene, "lamp", test::add_lambert(scene, "lamp", 0, 1000));
      test::add_quad(scene, Vec3(-0.2f, 1, -0.8f) * scale, Vec3(0.4f, 0, 0) * scale,
                     Vec3(0, 0, 0.4f) * scale);
    }
    scene.camera.push_back(test::look_at(Vec3(0, 0.8f, 0.9f) * scale, Vec3(0), Vec3(0, 1, 0), 0.6f));
    finalize(scene);
  }
};

struct Picture {
  const Sheet& sheet;
  RayScene rays{sheet.scene};
  GlossTables tables = test::gloss_tables(sheet.scene);
  RenderOptions options;
  explicit Picture(const Sheet& of) : sheet(of) {
    options.width = options.height = kSide;
    options.pixel_samples = 1, options.splat = SplatBy::cpu, options.isa = "sse2";
    options.direct = DirectBy::none;
    options.accuracy = kAccuracy;
  }
  Rendering render(const std::vector<RadianceRecord>& records) {
    IrradianceCache cache;
    for (const RadianceRecord& r : records) cache.records.push_back(irradiance_of(r));
    resolve(options, sheet.scene.camera[0], cache);
    const GlossCache gloss = test::gloss_cache(rays, tables, kAccuracy, records);
    return render_scene(rays, cache, options, {}, &gloss);
  }
  /// Records of one light all over the sheet, up to x = `to`.
  std::vector<RadianceRecord> records(const test::WorldLight& light, float scale = 1, float to = 1) const {
    std::vector<RadianceRecord> all;
    for (float x = -1; x <= to; x += 0.1f)
      for (float z = -1; z <= 1; z += 0.1f)
        all.push_back(test::radiance_record(light, Vec3(x, 0, z) * scale, make_frame(Vec3(0, 1, 0)),
                                            tables.order(0), scale));
    return all;
  }
};

/// Integral of the glossy part of f cos over the hemisphere, times light.
Rgb reflected(const Scene& scene, const SurfacePoint& point, const Vec3& wo, const test::WorldLight& light) {
  const Bsdf bsdf(scene, point);
  Rgb sum(0);
  constexpr int kRings = 200, kSlices = 400;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kSlices; ++k) {
      const float y = (static_cast<float>(i) + 0.5f) / kRings, across = std::sqrt(1 - y * y),
                  phi = 2 * kPi * (static_cast<float>(k) + 0.5f) / kSlices;
      const Vec3 w(across * std::cos(phi), y, across * std::sin(phi));
      sum += bsdf.evaluate_gloss(wo, w) * light(w) * y;
    }
  return sum * (2 * kPi / (kRings * kSlices));
}

/// Light whose HSH end before the lobe's bands do: what tables leave out of a lobe then meets no light.
void expect_reflected(const Sheet& sheet, const test::WorldLight& light, float scale, double allowance) {
  Picture picture(sheet);
  const Rendering made = picture.render(picture.records(light, scale));
  EXPECT_EQ(made.gloss.missed, 0u);
  EXPECT_EQ(made.missed, 0u);
  const std::vector<Rgb> glossy = made.image.rgb("glossy"), indirect = made.image.rgb("indirect");
  const PixelRays pixel_rays(sheet.scene.camera[0], kSide, kSide);
  for (int pixel = 0; pixel < kSide * kSide; pixel += 37) {
    const Ray r = pixel_rays(pixel % kSide, pixel / kSide, Vec2(0.5f));
    SurfacePoint point;
    if (!trace(picture.rays, {r.origin, r.direction}, point)) continue;
    const Rgb truth = reflected(sheet.scene, point, -r.direction, light);
    const auto i = static_cast<std::size_t>(pixel);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(glossy[i][c] / truth[c], 1, allowance) << pixel << " " << c;
  }
  EXPECT_GT(made.gloss.looked_up, 100u);
  EXPECT_GT(max_component(indirect[kSide * kSide / 2]), 0);
}

TEST(GlossPicture, ConstantLight) {
  const Sheet sheet(false);
  expect_reflected(
      sheet, [](const Vec3&) { return Rgb(30, 20, 10); }, 1, 0.01);
}

TEST(GlossPicture, LinearLight) {
  const Sheet sheet(false);
  expect_reflected(
      sheet, [](const Vec3& w) { return Rgb(30, 20, 10) * (1.5f + w.x + 0.3f * w.z - 0.4f * w.y); }, 1, 0.02);
}

TEST(GlossPicture, AnySizeOfScene) {
  for (const float scale : {1e-6f, 1e6f}) {
    const Sheet sheet(false, scale);
    expect_reflected(
        sheet, [](const Vec3&) { return Rgb(30, 20, 10); }, scale, 0.01);
  }
}

/// Of constant light L, kd L comes from the Lambert part: records serve both.
TEST(GlossPicture, TheLambertPartToo) {
  const Sheet sheet(false);
  Picture picture(sheet);
  const Rendering made = picture.render(picture.records([](const Vec3&) { return Rgb(10); }));
  const Rgb middle = made.image.rgb("indirect")[kSide * kSide / 2 + kSide / 2];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle[c], 10 * sheet.scene.material[0].kd[c], 1e-3);
}

/// Beyond the records gloss is traced: into nothing here.
TEST(GlossPicture, MissesAreTraced) {
  const Sheet sheet(false);
  Picture picture(sheet);
  const Rendering made = picture.render(picture.records([](const Vec3&) { return Rgb(10); }, 1, -0.3f));
  EXPECT_GT(made.gloss.missed, 20u);
  EXPECT_LT(made.gloss.missed, made.gloss.looked_up);
  EXPECT_EQ(made.gloss_misses.size(), made.gloss.missed);
  for (const Miss& m : made.gloss_misses) EXPECT_GT(m.position.x, -0.15f);
  for (const Rgb& c : made.image.rgb("glossy")) EXPECT_TRUE(is_finite(c));
}

TEST(GlossPicture, TheRecordsErrorShows) {
  const Sheet sheet(false);
  Picture picture(sheet);
  std::vector<RadianceRecord> records = picture.records([](const Vec3&) { return Rgb(10); });
  const double with =
      static_cast<double>(picture.render(records).image.rgb("stderr")[kSide * kSide / 2 + kSide / 2].y);
  for (RadianceRecord& r : records)
    for (float& e : r.stderr_light) e *= 3;
  const double thrice =
      static_cast<double>(picture.render(records).image.rgb("stderr")[kSide * kSide / 2 + kSide / 2].y);
  EXPECT_GT(with, 0);
  // Where records disagree by more than their noise, that is in it too, and does not grow.
  EXPECT_GT(thrice / with, 2.7);
  EXPECT_LT(thrice / with, 3.001);
}

/// What lamps show in gloss does not come from records; whoever finds it, it is the same light.
TEST(GlossPicture, LampsInEveryWayOfDirectLight) {
  const Sheet sheet(true);
  Picture picture(sheet);
  const std::vector<RadianceRecord> dark = picture.records([](const Vec3&) { return Rgb(0); });
  const auto mean = [](const Rendering& made) {
    double sum = 0;
    for (const Rgb& c : made.image.rgb("direct")) sum += static_cast<double>(luminance(c));
    return sum;
  };
  picture.options.light_samples = 64, picture.options.gloss_samples = 64;
  picture.options.direct = DirectBy::traced;
  IrradianceCache none;
  none.records.push_back(irradiance_of(dark.front()));
  resolve(picture.options, sheet.scene.camera[0], none);
  const double traced = mean(render_scene(picture.rays, none, picture.options));
  EXPECT_GT(traced, 0);
  for (const DirectBy direct : {DirectBy::traced, DirectBy::interleaved, DirectBy::shadow_map}) {
    picture.options.direct = direct;
    EXPECT_NEAR(mean(picture.render(dark)) / traced, 1, 0.02) << static_cast<int>(direct);
  }
}

}  // namespace
}  // namespace phos
