// Light of an environment by harmonics against closed forms, sums over the map, and rays.
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "hsh/projection.h"
#include "radiance/brdf/projection.h"
#include "splat/direct/environment_harmonics.h"
#include "splat/picture/render.h"
#include "support/environment.h"
#include "support/one_material.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

Vec3 texel_direction(const Environment& map, int x, int y) {
  const float theta = kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height());
  const float phi = kPi - 2 * kPi * (static_cast<float>(x) + 0.5f) / static_cast<float>(map.width()) +
                    static_cast<float>(map.rotation_rad());
  return {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

/// A map of few bands of SH, positive, without a symmetry.
Environment soft_map(int height, double rotation_rad = 0) {
  const Environment frame = constant_map(height, Rgb(0));
  return map_of(
      height,
      [&](int x, int y) {
        const Vec3 d = texel_direction(frame, x, y);
        return Rgb(3 + d.x + 0.5f * d.y + d.z * d.x, 2 + d.y + 0.6f * d.z * d.y, 2 + d.z - d.x * d.y);
      },
      rotation_rad);
}

/// Sum over texels of value(direction) times luminance times solid angle.
template <class Value>
DVec3 sum_over(const Environment& map, const Value& value) {
  DVec3 sum(0);
  for (int y = 0; y < map.height(); ++y) {
    const double top = std::cos(std::numbers::pi * y / map.height()),
                 bottom = std::cos(std::numbers::pi * (y + 1) / map.height());
    const double sr = 2 * std::numbers::pi / map.width() * (top - bottom);
    for (int x = 0; x < map.width(); ++x) {
      const Vec3 d = texel_direction(map, x, y);
      sum += sr * DVec3(map.luminance(d)) * DVec3(value(d));
    }
  }
  return sum;
}

Scene one_sheet(const Material& material) {
  Scene scene = open_floor(1);
  scene.material[0] = material;
  return scene;
}

SurfacePoint point_facing(const Vec3& normal, float turn) {
  SurfacePoint point;
  const Frame frame = make_frame(glm::normalize(normal));
  point.geometric_normal = point.smooth_normal = point.normal = frame.z;
  point.tangent = std::cos(turn) * frame.x + std::sin(turn) * frame.y;
  return point;
}

std::vector<BrdfTable> table_of(const Scene& scene, double error, std::int64_t max_order) {
  Counters counters;
  return {project_brdf(scene, 0, {error, max_order, 64}, counters)};
}

const Vec3 kNormals[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0.3f, 0.4f, -0.8f}, {-0.7f, -0.2f, 0.1f}};

TEST(EnvironmentProjection, OfAConstantIsOneCoefficient) {
  for (const int height : {2, 8, 33}) {
    const std::vector<float> c = project_environment(constant_map(height, Rgb(1, 2, 4), 0.7), 20);
    ASSERT_EQ(c.size(), 1200u);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(c[static_cast<std::size_t>(k)], std::exp2(k) * std::sqrt(4 * kPi), 1e-5f);
    for (std::size_t i = 3; i < c.size(); ++i) EXPECT_NEAR(c[i], 0, 2e-6f) << height << " " << i;
  }
}

/// A disc of the sun is the mean over its directions, times its luminance and solid angle.
TEST(EnvironmentProjection, OfASunIsTheMeanOverItsDisc) {
  for (const double radius : {0.0046, 0.2, 1.0}) {
    const Environment::Sun sun{glm::normalize(DVec3(0.3, 0.5, -0.7)), radius, Rgb(1, 2, 4)};
    const Environment map(2, 1, {Rgb(0), Rgb(0)}, 0, sun);
    constexpr int kOrder = 8, kSide = 200;
    const std::vector<float> c = project_environment(map, kOrder);
    const Frame frame = environment_frame();
    const HarmonicBasis<double> basis(kOrder);
    std::vector<double> values(kOrder * kOrder), sum(values.size());
    for (int i = 0; i < kSide; ++i)
      for (int k = 0; k < kSide; ++k) {
        const Vec2 u((static_cast<float>(i) + 0.5f) / kSide, (static_cast<float>(k) + 0.5f) / kSide);
        const Vec3 d = frame.to_local(map.sample(u).direction);
        basis.evaluate(BasisKind::sh, static_cast<double>(d.x), static_cast<double>(d.y),
                       static_cast<double>(d.z), values.data());
        for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += values[n] / (kSide * kSide);
      }
    const double lx = map.integral_lx().x;
    for (std::size_t n = 0; n < sum.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(static_cast<double>(c[3 * n + k]), std::exp2(k) * lx * sum[n], 2e-4 * std::exp2(k) * lx)
            << radius << " " << n;
  }
}

TEST(EnvironmentProjection, IsTheIntegralOverTheTexels) {
  // A coarse map: its texels are far from points.
  const Environment map = soft_map(6, 0.4);
  const std::vector<float> c = project_environment(map, 6);
  const Quadrature sphere = sphere_quadrature(300, 600);
  const Frame frame = environment_frame();
  std::vector<double> values(36);
  std::vector<DVec3> sum(36, DVec3(0));
  const HarmonicBasis<double> basis(6);
  for (std::size_t q = 0; q < sphere.size(); ++q) {
    basis.evaluate(BasisKind::sh, sphere.x[q], sphere.y[q], sphere.z[q], values.data());
    const Vec3 d = frame.to_world(Vec3(sphere.x[q], sphere.y[q], sphere.z[q]));
    for (std::size_t i = 0; i < 36; ++i) sum[i] += sphere.weight[q] * values[i] * DVec3(map.luminance(d));
  }
  for (std::size_t i = 0; i < 36; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(c[3 * i + static_cast<std::size_t>(k)], sum[i][k], 0.02) << i << " " << k;
}

TEST(HarmonicLight, ConstantLightIsExactEverywhere) {
  for (const float strength : {1e-12f, 1.f, 1e12f}) {
    for (const EnvironmentBy by : {EnvironmentBy::hsh, EnvironmentBy::sh}) {
      Material phong = make_material(Model::phong, Rgb(0.3f), Rgb(0.5f));
      phong.exponent = 12;
      const Scene scene = one_sheet(phong);
      const std::vector<BrdfTable> tables = table_of(scene, 1e-3, 16);
      const EnvironmentHarmonics e(scene, constant_map(8, Rgb(strength)), by, 10, tables);
      for (const Vec3& n : kNormals) {
        const SurfacePoint p = point_facing(n, 1);
        const Rgb lx = e.irradiance_lx(p.normal);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(lx[c] / strength, kPi, 2e-5f);
        const std::vector<float> h = e.incident({p.tangent, glm::cross(p.normal, p.tangent), p.normal});
        // SH of some bands ring at the horizon for nothing but the constant.
        EXPECT_NEAR(h[0] / strength, std::sqrt(2 * kPi), 2e-5f);
        for (std::size_t i = 3; i < h.size(); ++i) EXPECT_NEAR(h[i] / strength, 0, 2e-5f) << i;
        // The furnace: what the lobe gathers is its albedo.
        const Bsdf bsdf(scene, p);
        const Vec3 wo = glm::normalize(p.normal + 0.8f * p.tangent);
        const auto light = e.light(p, bsdf, wo);
        ASSERT_TRUE(light);
        const Environment fine = constant_map(256, Rgb(1));
        const DVec3 albedo = sum_over(fine, [&](const Vec3& d) {
          return bsdf.evaluate_gloss(wo, d) * std::max(glm::dot(d, p.normal), 0.f);
        });
        EXPECT_NEAR(light->gloss.y / strength, albedo.y, 2e-3 * albedo.y);
      }
    }
  }
}

TEST(HarmonicLight, IrradianceIsTheSumOverTheMap) {
  const Environment map = soft_map(128, 0.4);
  const EnvironmentHarmonics e(one_sheet(make_material(Model::lambert, Rgb(1), Rgb(0))), map,
                               EnvironmentBy::hsh, 10, {});
  for (const Vec3& n : kNormals) {
    const Vec3 up = glm::normalize(n);
    const DVec3 truth = sum_over(map, [&](const Vec3& d) { return Vec3(std::max(glm::dot(d, up), 0.f)); });
    const Rgb lx = e.irradiance_lx(up);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lx[c], truth[c], 5e-4 * truth[c]);
  }
  // A sun of one texel: the cosine alone is cut off at 20 bands.
  const Environment sun = map_of(64, [](int x, int y) { return Rgb(x == 17 && y == 20 ? 1e4f : 0.f); });
  const EnvironmentHarmonics s(one_sheet(make_material(Model::lambert, Rgb(1), Rgb(0))), sun,
                               EnvironmentBy::hsh, 10, {});
  const Vec3 way = texel_direction(sun, 17, 20);
  const double lux = sun.integral_lx().y;
  for (const Vec3& n : kNormals) {
    const Vec3 up = glm::normalize(n);
    EXPECT_NEAR(s.irradiance_lx(up).y, std::max(0.f, glm::dot(up, way)) * lux, 0.01 * lux);
  }
}

TEST(HarmonicLight, GlossIsTheSumOverASoftMap) {
  Material phong = make_material(Model::phong, Rgb(0), Rgb(0.7f, 0.5f, 0.3f));
  phong.exponent = 10;
  const Environment map = soft_map(64, 0.4);
  for (const Material& material : {phong, make_material(Model::ward, Rgb(0.2f), Rgb(0.5f), 0.3f, 0.6f)}) {
    const Scene scene = one_sheet(material);
    const std::vector<BrdfTable> tables = table_of(scene, 1e-3, 20);
    const EnvironmentHarmonics e(scene, map, EnvironmentBy::hsh, 20, tables);
    for (const Vec3& n : kNormals) {
      for (const float slope : {0.f, 0.5f, 1.2f}) {
        const SurfacePoint p = point_facing(n, 0.6f);
        const Bsdf bsdf(scene, p);
        const Vec3 side = std::cos(slope) * p.tangent + std::sin(slope) * glm::cross(p.normal, p.tangent);
        const Vec3 wo = glm::normalize(p.normal + slope * side);
        const DVec3 truth = sum_over(map, [&](const Vec3& d) {
          return bsdf.evaluate_gloss(wo, d) * std::max(glm::dot(d, p.normal), 0.f);
        });
        const auto light = e.light(p, bsdf, wo);
        ASSERT_TRUE(light) << slope;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(light->gloss[c], truth[c], 2e-3 * truth[c]) << n.x << " " << slope;
      }
    }
  }
}

TEST(HarmonicLight, LeavesSharpLobesToRays) {
  Material sharp = make_material(Model::phong, Rgb(0.5f), Rgb(0.5f));
  sharp.exponent = 2000;
  const Scene scene = one_sheet(sharp);
  const EnvironmentHarmonics e(scene, soft_map(16), EnvironmentBy::hsh, 6, {});
  const SurfacePoint p = point_facing({0, 1, 0}, 0);
  EXPECT_FALSE(e.light(p, Bsdf(scene, p), glm::normalize(Vec3(0.3f, 1, 0))));
}

TEST(HarmonicLight, RefusesOrdersOutOfRange) {
  const Scene scene = one_sheet(make_material(Model::lambert, Rgb(1), Rgb(0)));
  for (const int order : {0, 31, -4})
    EXPECT_THROW(EnvironmentHarmonics(scene, soft_map(4), EnvironmentBy::hsh, order, {}), Error);
}

/// Whole pictures: an open floor of one material, by harmonics and by many rays.
TEST(HarmonicLight, PicturesAgreeWithRays) {
  Material phong = make_material(Model::phong, Rgb(0.3f), Rgb(0.5f));
  phong.exponent = 10;
  Scene scene = one_sheet(phong);
  scene.camera.push_back(look_at({0, 1, 2}, {0, 0, 0}, {0, 1, 0}, 0.7f));
  surround(scene, soft_map(64, 0.4));
  const RayScene rays(scene);
  const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
  RenderOptions options;
  options.width = options.height = 8;
  options.pixel_samples = 1;
  options.light_samples = options.gloss_samples = 16384;
  options.splat = SplatBy::cpu;
  resolve(options, scene.camera[0], cache);
  const Image traced = render_scene(rays, cache, options).image;
  options.environment = EnvironmentBy::hsh;
  options.environment_order = 16;
  const Rendering harmonic = render_scene(rays, cache, options, table_of(scene, 1e-4, 16));
  const std::vector<Rgb> a = traced.rgb("direct"), b = harmonic.image.rgb("direct");
  double sum = 0, error = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<double>(a[i].y);
    error += static_cast<double>(std::fabs(a[i].y - b[i].y));
  }
  EXPECT_GT(sum, 0);
  EXPECT_LT(error, 3e-3 * sum);
  const std::span<const float> lx = harmonic.image.channel("illuminance.Y"),
                               traced_lx = traced.channel("illuminance.Y");
  for (std::size_t i = 0; i < lx.size(); ++i) EXPECT_NEAR(lx[i], traced_lx[i], 5e-3f * traced_lx[i]);
  // Lamps are still seen by rays: the harmonics stand for the environment alone.
  EXPECT_EQ(traced.rgb("emission"), harmonic.image.rgb("emission"));
}

}  // namespace
}  // namespace phos::test
