#include <gtest/gtest.h>

#include "core/random.h"
#include "scene/lamp/luminaires.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr int kWidth = 120, kHeight = 90;

struct Lit {
  GBuffer g;
  std::vector<Rgb> lx;
};

Lit light_up(const Scene& scene, const Camera& camera, int light_samples, int map_size = 512) {
  const RayScene rays(scene);
  Lit lit{trace_gbuffer(rays, camera, kWidth, kHeight, {0.5f, 0.5f}), {}};
  lit.lx = GlRenderer(scene).direct_illuminance(lit.g, light_samples, map_size);
  for (const Rgb& e : lit.lx) EXPECT_TRUE(is_finite(e) && e.x >= 0);
  return lit;
}

/// Share of the pixels of non-emitting surface off by more than `relative` of the greatest irradiance of the
/// picture.
double share_off(const test::AnalyticScene& s, const Lit& lit, double relative) {
  double greatest = 0, off = 0, count = 0;
  std::vector<double> expected(lit.lx.size(), 0);
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (!lit.g.covered(i) || s.scene.material_of(lit.g.hit[i].triangle).emits()) continue;
    expected[i] = s.irradiance_lx(Vec3(lit.g.position[i]), Vec3(lit.g.normal[i]));
    greatest = std::max(greatest, expected[i]);
    ++count;
  }
  EXPECT_GT(count, 500);
  EXPECT_GT(greatest, 0);
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (!lit.g.covered(i) || s.scene.material_of(lit.g.hit[i].triangle).emits()) continue;
    off += std::fabs(double(lit.lx[i].y) - expected[i]) > relative * greatest;
  }
  return off / count;
}

TEST(ShadowMaps, PointLightOverAPlane) {
  const test::AnalyticScene s = test::point_light_over_plane();
  EXPECT_EQ(share_off(s, light_up(s.scene, s.scene.camera[0], 1), 1e-4), 0);
}

TEST(ShadowMaps, SpotsWithHardEdges) {
  for (const double cosine : {0.8, 0.5}) {
    test::AnalyticScene s = test::point_light_over_plane();
    Light& spot = s.scene.light[0];
    spot.kind = Light::Kind::spot, spot.direction = {0, -1, 0};
    spot.cos_inner = spot.cos_outer = cosine;
    const Lit lit = light_up(s.scene, s.scene.camera[0], 1);
    int within = 0, beyond = 0;
    for (std::size_t i = 0; i < lit.lx.size(); ++i) {
      if (!lit.g.covered(i)) continue;
      const Vec3 p(lit.g.position[i]);
      const double along = static_cast<double>(glm::normalize(p - spot.position).y) * -1;
      if (std::fabs(along - cosine) < 1e-4) continue;
      const bool in = along > cosine;
      ++(in ? within : beyond);
      const double expected = in ? s.irradiance_lx(p, Vec3(lit.g.normal[i])) : 0;
      EXPECT_NEAR(static_cast<double>(lit.lx[i].y), expected, 1e-4 * expected);
    }
    EXPECT_GT(within, 100);
    EXPECT_GT(beyond, 100);
  }
}

TEST(ShadowMaps, AreaLights) {
  // 64 points instead of the integral: within 3 % of the brightest.
  test::AnalyticScene s = test::rectangle_light_parallel();
  EXPECT_LT(share_off(s, light_up(s.scene, s.scene.camera[0], 64, 256), 0.03), 0.01);
  s = test::rectangle_light_perpendicular();
  EXPECT_LT(share_off(s, light_up(s.scene, s.scene.camera[0], 64, 256), 0.1), 0.02)
      << "nearly singular at the edge";
}

TEST(ShadowMaps, ThinWallsKeepTheLightOut) {
  test::AnalyticScene s = test::thin_walls();
  EXPECT_EQ(share_off(s, light_up(s.scene, s.scene.camera[0], 1, 1024), 1e-3), 0);
  // From behind, the second wall is dark; what is seen of the first would be too.
  const Lit behind = light_up(s.scene, test::look_at({0.5f, 0.5f, -3}, {0, 0, 0}, {0, 1, 0}, 0.8f), 1, 1024);
  for (const Rgb& e : behind.lx) EXPECT_EQ(e.x, 0);
}

TEST(ShadowMaps, EachSideOfASheetHasItsOwnLight) {
  const test::AnalyticScene s = test::two_sided_sheet();
  EXPECT_EQ(share_off(s, light_up(s.scene, s.scene.camera[0], 1), 1e-4), 0);
  const Camera below = test::look_at({0, -2, 3}, {0, 0, 0}, {0, 1, 0}, 0.8f);
  EXPECT_EQ(share_off(s, light_up(s.scene, below, 1), 1e-4), 0);
}

/// A floor with a block on it.
Scene block_on_floor() {
  Scene scene;
  const std::uint32_t grey = test::add_lambert(scene, "grey", 0.5f);
  test::begin_instance(scene, "floor", grey);
  test::add_quad(scene, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0});
  test::begin_instance(scene, "block", grey);
  test::add_room(scene, {-0.5f, 0.001f, -0.4f}, {0.4f, 0.9f, 0.5f});
  test::begin_instance(scene, "ball", grey);
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 24; ++j) {
      const auto at = [](int a, int b) {
        const float t = kPi * static_cast<float>(a) / 12, p = kPi * static_cast<float>(b) / 12;
        return Vec3(1.3f, 0.5f, 0.8f) +
               0.4f * Vec3(std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p));
      };
      if (i > 0) test::add_triangle(scene, at(i, j), at(i, j + 1), at(i + 1, j));
      if (i < 11) test::add_triangle(scene, at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  scene.camera.push_back(test::look_at({1.5f, 2.5f, 4}, {0, 0.2f, 0}, {0, 1, 0}, 0.8f));
  return scene;
}

/// The same light by traced visibility; the pixels that differ by more than 2 % of the brightest are a share,
/// and the sum over the picture differs by a share.
void expect_as_traced(Scene scene, const Light& light, double pixels, double sum) {
  scene.light.push_back(light);
  finalize(scene);
  const Camera camera = scene.camera[0];
  const Lit lit = light_up(scene, camera, 1, 1024);
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  double greatest = 0, traced_sum = 0, drawn_sum = 0, off = 0, dark = 0, count = 0;
  std::vector<double> traced(lit.lx.size(), 0);
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (!lit.g.covered(i)) continue;
    ++count;
    const Ray ray = pixel_ray(camera, kWidth, kHeight, static_cast<int>(i) % kWidth,
                              static_cast<int>(i) / kWidth, {0.5f, 0.5f});
    const SurfacePoint point = rays.surface(ray, lit.g.hit[i]);
    Illumination from;
    if (luminaires.illuminate(0, point.position, 0, {0, 0}, from) &&
        glm::dot(from.direction, point.geometric_normal) > 0) {
      const bool far = light.kind == Light::Kind::directional;
      const bool clear = far ? !rays.occluded({point.leave(from.direction), from.direction})
                             : rays.visible(point, from.position, from.error_m);
      if (clear)
        traced[i] =
            double(from.value.x) * std::max(0.0, double(glm::dot(from.direction, point.smooth_normal)));
    }
    dark += traced[i] == 0;
    greatest = std::max(greatest, traced[i]);
    traced_sum += traced[i], drawn_sum += double(lit.lx[i].x);
  }
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (lit.g.covered(i)) off += std::fabs(double(lit.lx[i].x) - traced[i]) > 0.02 * greatest;
  }
  EXPECT_GT(dark / count, 0.05) << "there are shadows";
  EXPECT_LT(off / count, pixels);
  EXPECT_NEAR(drawn_sum / traced_sum, 1, sum);
}

TEST(ShadowMaps, AgreeWithTracedShadows) {
  Light light;
  light.position = {-1, 2.5f, 1}, light.intensity = Rgb(800);
  {
    SCOPED_TRACE("point");
    expect_as_traced(block_on_floor(), light, 0.02, 0.01);
  }
  light.kind = Light::Kind::spot;
  light.direction = glm::normalize(Vec3(0.4f, -1, -0.35f));
  for (const float outer : {0.6f, 1.3f}) {
    SCOPED_TRACE("spot");
    light.cos_outer = std::cos(outer), light.cos_inner = std::cos(0.5f * outer);
    expect_as_traced(block_on_floor(), light, 0.02, 0.01);
  }
  light.kind = Light::Kind::directional;
  SCOPED_TRACE("directional");
  expect_as_traced(block_on_floor(), light, 0.02, 0.01);
}

TEST(ShadowMaps, AreaLightsCastSoftShadows) {
  const Scene scene = test::cornell();
  const Lit lit = light_up(scene, scene.camera[0], 32, 512);
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  constexpr int kSide = 8;  // traced samples: a jittered grid per pixel
  double traced_sum = 0, drawn_sum = 0, greatest = 0, off = 0, count = 0;
  std::vector<double> traced(lit.lx.size(), 0);
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (!lit.g.covered(i) || scene.material_of(lit.g.hit[i].triangle).emits()) continue;
    const Ray ray = pixel_ray(scene.camera[0], kWidth, kHeight, static_cast<int>(i) % kWidth,
                              static_cast<int>(i) / kWidth, {0.5f, 0.5f});
    const SurfacePoint point = rays.surface(ray, lit.g.hit[i]);
    RandomStream random(1, Stage::test, i);
    for (std::size_t light = 0; light < luminaires.size(); ++light) {
      for (int k = 0; k < kSide * kSide; ++k) {
        const Vec2 cell(static_cast<float>(k % kSide), static_cast<float>(k / kSide));
        Illumination from;
        if (!luminaires.illuminate(light, point.position, random.uniform(),
                                   (cell + random.uniform2()) / float{kSide}, from)) {
          continue;
        }
        const float cosine = glm::dot(from.direction, point.smooth_normal);
        if (cosine <= 0 || glm::dot(from.direction, point.geometric_normal) <= 0) continue;
        if (!rays.visible(point, from.position, from.error_m)) continue;
        traced[i] += double(from.value.y * cosine / from.density) / (kSide * kSide);
      }
    }
    greatest = std::max(greatest, traced[i]);
    traced_sum += traced[i], drawn_sum += double(lit.lx[i].y), ++count;
  }
  for (std::size_t i = 0; i < lit.lx.size(); ++i) {
    if (!lit.g.covered(i) || scene.material_of(lit.g.hit[i].triangle).emits()) continue;
    off += std::fabs(double(lit.lx[i].y) - traced[i]) > 0.1 * greatest;
  }
  EXPECT_GT(count, 1000);
  EXPECT_NEAR(drawn_sum / traced_sum, 1, 0.03);
  EXPECT_LT(off / count, 0.03);
}

TEST(ShadowMaps, NoLightNoIlluminance) {
  Scene scene = block_on_floor();
  finalize(scene);
  for (const Rgb& e : light_up(scene, scene.camera[0], 4).lx) EXPECT_EQ(e, Rgb(0));
}

}  // namespace
}  // namespace phos
