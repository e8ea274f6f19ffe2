// The path tracer against every scene with a closed form (derivations: support/scenes.h), within its own
// standard error.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/sampling.h"
#include "reference/point_irradiance.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/cutouts.h"
#include "support/reference.h"
#include "support/scenes.h"

namespace {

using namespace phos;
using test::AnalyticScene;
using test::expect_within;

using Lit = test::RaysAndLamps;

void check_points(const AnalyticScene& s, std::int64_t samples, double relative) {
  const Lit lit(s.scene);
  std::uint64_t seed = 1;
  for (const test::Check& check : s.checks) {
    const PointIrradiance e =
        estimate_irradiance(lit.rays, lit.luminaires, check.position, check.normal, samples, -1, seed++);
    EXPECT_EQ(e.rejected, 0u);
    expect_within(e.illuminance_lx, e.illuminance_stderr_lx, check.irradiance_lx, relative,
                  text(s.name, " at ", check.position.x, ",", check.position.y, ",", check.position.z));
  }
}

TEST(ReferenceAnalytic, PointLightOverPlane) { check_points(test::point_light_over_plane(), 64, 1e-6); }
TEST(ReferenceAnalytic, ParallelRectangle) { check_points(test::rectangle_light_parallel(), 20000, 0.01); }
TEST(ReferenceAnalytic, PerpendicularRectangle) {
  check_points(test::rectangle_light_perpendicular(), 20000, 0.01);
}
TEST(ReferenceAnalytic, LampsThatAreCutOut) {
  for (const AnalyticScene& s : test::cut_out_lamps()) check_points(s, 40000, 0.01);
}
TEST(ReferenceAnalytic, EmittingEnvironment) { check_points(test::emitting_environment(), 20000, 0.01); }
TEST(ReferenceAnalytic, ThinWalls) { check_points(test::thin_walls(), 64, 1e-6); }
TEST(ReferenceAnalytic, TwoSidedSheet) { check_points(test::two_sided_sheet(), 64, 1e-6); }

TEST(ReferenceAnalytic, Furnace) {
  for (const float albedo : {0.f, 0.1f, 0.5f, 0.9f, 0.99f})
    check_points(test::furnace(albedo), albedo > 0.95f ? 4000 : 8000, 0.02);
}

TEST(ReferenceAnalytic, FurnaceBounceByBounce) {
  const float albedo = 0.9f;
  const AnalyticScene s = test::furnace(albedo);
  const Lit lit(s.scene);
  const test::Check& at = s.checks[0];
  for (const std::int64_t bounces : {0, 1, 2, 3, 6, 20}) {
    const PointIrradiance e =
        estimate_irradiance(lit.rays, lit.luminaires, at.position, at.normal, 8000, bounces, 7);
    // The sensor's own scattering is the first: n bounces are n - 1 reflections at the walls.
    const double expected = bounces == 0 ? 0 : test::furnace_lx(1, albedo, static_cast<int>(bounces) - 1);
    expect_within(e.illuminance_lx, e.illuminance_stderr_lx, expected, 0.02, text(bounces, " bounces"));
  }
}

TEST(ReferenceAnalytic, BlackEmittersKeepDirectLightOnly) {
  const AnalyticScene s = test::furnace(0.9f);
  const Lit lit(s.scene);
  PointOptions options;
  options.path.black_emitters = true;
  const PointIrradiance e =
      estimate_irradiance(lit.rays, lit.luminaires, s.checks[0].position, s.checks[0].normal, options);
  expect_within(e.illuminance_lx, e.illuminance_stderr_lx, 1, 0.02, "furnace of black emitters");
}

/// Area mean over all triangles, from one path at each of `n` points: uniform over the area, as the mean
/// wants.
void check_mean(const AnalyticScene& s, std::int64_t n, double relative) {
  const Lit lit(s.scene);
  const EyePathTracer tracer(lit.rays, lit.luminaires);
  std::vector<double> cdf;
  double area = 0;
  for (std::uint32_t t = 0; t < s.scene.triangle.size(); ++t) cdf.push_back(area += area_m2(s.scene, t));
  EXPECT_NEAR(area, s.area_m2, 1e-5 * area);
  double sum = 0, squares = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    RandomStream random(3, Stage::test, static_cast<std::uint64_t>(i));
    const auto t = static_cast<std::uint32_t>(
        std::lower_bound(cdf.begin(), cdf.end(), random.uniform_double() * area) - cdf.begin());
    const Vec2 w = sample_triangle(random.uniform2());
    const std::uint32_t* v = s.scene.triangle[t].v;
    SurfacePoint sensor;
    sensor.position = (1 - w.x - w.y) * s.scene.position[v[0]] + w.x * s.scene.position[v[1]] +
                      w.y * s.scene.position[v[2]];
    sensor.geometric_normal = geometric_normal(s.scene, t);
    sensor.error_m = 4e-6f * s.scene.bounds.diagonal_m();
    RandomStream path(4, Stage::reference, static_cast<std::uint64_t>(i));
    const double e = luminance(tracer.irradiance(sensor, path));
    sum += e, squares += e * e;
  }
  const double count = static_cast<double>(n), mean = sum / count;
  const double standard_error = std::sqrt((squares / count - mean * mean) / (count - 1));
  expect_within(mean, standard_error, s.mean_irradiance_lx, relative, s.name);
}

TEST(ReferenceAnalytic, IntegratingSphereMean) {
  check_mean(test::integrating_sphere(0.5f, 320), 40000, 0.01);
  check_mean(test::integrating_sphere(0.95f, 1280, 0.5f), 10000, 0.02);
}

TEST(ReferenceAnalytic, UniformBoxMean) {
  check_mean(test::uniform_box(0.5f), 60000, 0.02);
  check_mean(test::uniform_box(0.9f), 30000, 0.02);
}

/// One lamp of several is chosen at each scattering: the same flux in two or in twelve unequal lamps, the
/// same mean.
TEST(ReferenceAnalytic, SeveralLampsInABox) {
  for (const int lamps : {2, 12}) {
    AnalyticScene s = test::uniform_box(0.5f, 100);
    s.scene.light.clear();
    for (int i = 0; i < lamps; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(lamps);
      const float share =
          2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(lamps * lamps);  // adds up to 1
      test::add_point_light(s.scene, {0.3f + 1.4f * t, 0.4f + 0.2f * t, 0.5f + 0.4f * t},
                            100 / (4 * kPi) * share);
    }
    finalize(s.scene);
    check_mean(s, 60000, 0.02);
  }
}

/// Lux of a scaled scene stay what they were: nothing may depend on the unit of length.
TEST(ReferenceAnalytic, AnyScale) {
  for (const float factor : {1e-6f, 1e6f}) {
    check_points(scaled(test::point_light_over_plane(), factor), 64, 1e-6);
    check_points(scaled(test::rectangle_light_parallel(), factor), 4000, 0.02);
    check_points(scaled(test::furnace(0.5f), factor), 4000, 0.02);
    check_points(scaled(test::thin_walls(), factor), 64, 1e-6);
    check_mean(scaled(test::integrating_sphere(0.5f, 320), factor), 10000, 0.02);
  }
}

/// Pictures: L = rho E / pi of the visible surface, pixel by pixel; and its layers.
TEST(ReferenceAnalytic, PictureOfPlane) {
  const AnalyticScene s = test::point_light_over_plane();
  const Lit lit(s.scene);
  ReferenceOptions options;
  options.width = 24, options.height = 16, options.samples = 64, options.illuminance = true;
  const Image image = render_reference(lit.rays, lit.luminaires, s.scene.camera[0], options).image;
  const auto beauty = image.rgb(""), direct = image.rgb("direct"), indirect = image.rgb("indirect"),
             error = image.rgb("stderr");
  int seen = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    EXPECT_EQ(beauty[i], direct[i]);
    EXPECT_EQ(indirect[i], Rgb(0));
    if (image.channel("Z")[i] == 0) continue;
    ++seen;
    const Vec3 p(image.channel("position.X")[i], image.channel("position.Y")[i],
                 image.channel("position.Z")[i]);
    EXPECT_NEAR(p.y, 0, 1e-5);
    // A pixel's mean is its centre's value but for the second order of its size: here below 1 %.
    const double expected = s.irradiance_lx(p, {0, 1, 0});
    if (std::abs(p.x) > 6 || std::abs(p.z) > 6) continue;
    EXPECT_NEAR(image.channel("illuminance.Y")[i], expected,
                0.02 * expected + 4 * image.channel("illuminance_stderr.Y")[i]);
    EXPECT_NEAR(beauty[i].y * kPi / 0.5, expected, 0.02 * expected + 4 * error[i].y * kPi / 0.5);
  }
  EXPECT_GT(seen, 100);
}

/// Each ray in a furnace sees L / (1 - rho), and so does each sample of what is scattered.
TEST(ReferenceAnalytic, PictureOfFurnace) {
  const AnalyticScene s = test::furnace(0.5f, 10);
  const Lit lit(s.scene);
  ReferenceOptions options;
  options.width = options.height = 16, options.samples = 256;
  const ReferencePicture picture = render_reference(lit.rays, lit.luminaires, s.scene.camera[0], options);
  const auto emission = picture.image.rgb("emission"), direct = picture.image.rgb("direct"),
             indirect = picture.image.rgb("indirect"), error = picture.image.rgb("stderr");
  double z2 = 0, mean_direct = 0, mean_indirect = 0;
  for (std::size_t i = 0; i < picture.image.pixels(); ++i) {
    EXPECT_FLOAT_EQ(emission[i].y, 10);
    const double z = (direct[i].y + indirect[i].y - 10) / error[i].y;
    z2 += z * z, mean_direct += direct[i].y, mean_indirect += indirect[i].y;
  }
  const auto n = static_cast<double>(picture.image.pixels());
  EXPECT_NEAR(mean_direct / n, 5,
              5 * picture.error);  // rho L; picture.error bounds 16 standard errors of a mean of 256
  EXPECT_NEAR(mean_indirect / n, 5, 5 * picture.error);
  EXPECT_NEAR(z2 / n, 1, 5 * std::sqrt(2 / n));  // chi-square of n pixels
  EXPECT_FALSE(picture.image.has_layer("specular"));
}

}  // namespace
