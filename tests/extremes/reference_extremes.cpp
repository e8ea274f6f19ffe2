// The path tracer where numbers are large, small or degenerate: a right answer or a counted event, never a
// NaN.
#include <gtest/gtest.h>

#include "core/float_traps.h"
#include "reference/point_irradiance.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/scenes.h"

namespace {

using namespace phos;

PointIrradiance measure(const Scene& scene, const Vec3& p, const Vec3& n, std::int64_t samples) {
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  return estimate_irradiance(rays, luminaires, p, n, samples);
}

ReferencePicture picture(const Scene& scene, std::int64_t samples) {
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  ReferenceOptions options;
  options.width = options.height = 16, options.samples = samples;
  return render_reference(rays, luminaires, scene.camera[0], options);
}

void expect_finite(const Image& image) {
  for (const auto& [name, values] : image.channels())
    for (const float v : values) ASSERT_TRUE(std::isfinite(v)) << name;
}

TEST(ReferenceExtremes, AnyPower) {
  for (const float power : {1e-12f, 1e12f}) {
    for (const float factor : {1e-6f, 1.f, 1e6f}) {
      // Same candela at every size: lux from 1e-24 to 1e24 times the original's.
      test::AnalyticScene s = test::point_light_over_plane(2 * factor, 1000 * power);
      for (const test::Check& at : s.checks) {
        const PointIrradiance e = measure(s.scene, at.position, at.normal, 4);
        EXPECT_NEAR(e.illuminance_lx / at.irradiance_lx, 1, 1e-5) << power << " x " << factor;
      }
    }
    const test::AnalyticScene lamp = test::rectangle_light_parallel(2, 3, 1.5f, 1000 * power);
    const PointIrradiance e = measure(lamp.scene, lamp.checks[1].position, lamp.checks[1].normal, 4000);
    EXPECT_NEAR(e.illuminance_lx, lamp.checks[1].irradiance_lx, 4 * e.illuminance_stderr_lx);
    EXPECT_LT(e.illuminance_stderr_lx, 0.02 * e.illuminance_lx);
    const ReferencePicture image = picture(lamp.scene, 16);
    expect_finite(image.image);
    EXPECT_GT(image.error, 0);
  }
}

TEST(ReferenceExtremes, AlbedoNearlyOne) {
  const test::AnalyticScene s = test::furnace(0.999f);
  const PointIrradiance e = measure(s.scene, s.checks[0].position, s.checks[0].normal, 600);
  EXPECT_NEAR(e.illuminance_lx, s.checks[0].irradiance_lx, 4 * e.illuminance_stderr_lx);
  EXPECT_LT(e.illuminance_stderr_lx, 0.1 * e.illuminance_lx);
  EXPECT_EQ(e.rejected, 0u);
}

/// Nothing absorbs: the answer is infinite, but every path ends.
TEST(ReferenceExtremes, AlbedoOneEnds) {
  const NoFloatTraps traps;  // the closed form is infinite
  const test::AnalyticScene s = test::furnace(1.f);
  const PointIrradiance e = measure(s.scene, {0.8f, 0, 0.5f}, {0, 1, 0}, 50);
  EXPECT_TRUE(std::isfinite(e.illuminance_lx));
  EXPECT_GT(e.illuminance_lx, 10);
}

TEST(ReferenceExtremes, LampTouchesTheSurface) {
  test::AnalyticScene s = test::point_light_over_plane();
  s.scene.light[0].position = Vec3(0);  // in the floor itself: lit edge-on
  finalize(s.scene);
  const PointIrradiance e = measure(s.scene, {0, 0, 0}, {0, 1, 0}, 64);
  EXPECT_TRUE(std::isfinite(e.illuminance_lx));
  expect_finite(picture(s.scene, 16).image);
}

/// A lamp a millionth of its size above the floor: the floor sees nothing else. E = pi L.
TEST(ReferenceExtremes, LampLiesOnTheFloor) {
  const test::AnalyticScene s = test::rectangle_light_parallel(1, 1, 2e-5f, 1000, 0);
  const PointIrradiance e = measure(s.scene, {0.5f, 0, 0.5f}, {0, 1, 0}, 4000);
  EXPECT_NEAR(e.illuminance_lx, kPi * 1000, 4 * e.illuminance_stderr_lx + 1e-3 * kPi * 1000);
  EXPECT_EQ(e.rejected, 0u);
}

/// A room far from the origin: positions are coarse there (1 mm at 1e4 m), and walls still neither leak nor
/// shade themselves.
TEST(ReferenceExtremes, FarFromTheOrigin) {
  test::AnalyticScene s = test::furnace(0.5f);
  const Vec3 shift(8192, -8192, 8192);
  for (Vec3& p : s.scene.position) p += shift;
  s.scene.light.clear();
  s.scene.bounds = {};
  finalize(s.scene);
  for (const test::Check& at : s.checks) {
    const PointIrradiance e = measure(s.scene, at.position + shift, at.normal, 2000);
    EXPECT_NEAR(e.illuminance_lx, at.irradiance_lx, 4 * e.illuminance_stderr_lx + 0.01 * at.irradiance_lx);
  }
}

TEST(ReferenceExtremes, GrazingNormals) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const Vec3 n = glm::normalize(Vec3(1, 1e-7f, 0));
  const PointIrradiance e = measure(s.scene, {1, 0.5f, 0.7f}, n, 4000);
  EXPECT_NEAR(e.illuminance_lx, s.mean_irradiance_lx, 4 * e.illuminance_stderr_lx);
}

TEST(ReferenceExtremes, DirectionsOfAllMaterialsStayFinite) {
  for (const Model model : {Model::metallic_roughness, Model::phong, Model::ward, Model::plastic,
                            Model::conductor, Model::dielectric, Model::thin_dielectric, Model::mirror}) {
    for (const float small : {0.f, 1e-6f, 1.f}) {
      test::AnalyticScene s = test::uniform_box(0.5f);
      Material& m = s.scene.material[0];
      m.model = model;
      m.kd = Rgb(model == Model::phong || model == Model::ward ? 0.4f : 0.5f);
      m.ks = Rgb(0.5f);
      m.alpha_x = m.alpha_y = m.roughness = small;
      m.exponent = small > 0 ? 1 / small : 0;
      m.metallic = 0.5f;
      finalize(s.scene);
      const ReferencePicture image = picture(s.scene, 64);
      expect_finite(image.image);
      EXPECT_EQ(image.counters["non-finite sample"], 0u) << static_cast<int>(model) << " " << small;
    }
  }
}

TEST(ReferenceExtremes, OneSampleHasNoErrorToState) {
  const ReferencePicture image = picture(test::cornell(), 1);
  EXPECT_EQ(image.error, 0);
  for (const float v : image.image.channel("stderr.G")) EXPECT_EQ(v, 0);
}

TEST(ReferenceExtremes, ManyLamps) {
  Scene scene = test::point_light_over_plane(2, 0).scene;
  scene.light.clear();
  for (int i = 0; i < 1000; ++i) test::add_point_light(scene, {0, 2, 0}, 1);
  finalize(scene);
  const PointIrradiance e = measure(scene, {0, 0, 0}, {0, 1, 0}, 100);
  EXPECT_NEAR(e.illuminance_lx, 250, 0.01);  // equal lamps: the choice among them adds no noise
}

}  // namespace
