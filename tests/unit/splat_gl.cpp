#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "splat/cpu/splatter.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

/// Share of pixels that show something else, and the greatest differences at the others.
struct SurfaceDifference {
  double other = 0, position_m = 0, normal = 0, albedo = 0;
};

SurfaceDifference compare(const GBuffer& a, const GBuffer& b) {
  SurfaceDifference d;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    if (a.covered(i) != b.covered(i) || (a.covered(i) && a.hit[i].triangle != b.hit[i].triangle)) {
      d.other += 1 / static_cast<double>(a.position.size());
      continue;
    }
    if (!a.covered(i)) continue;
    d.position_m = std::max(d.position_m, double(glm::distance(Vec3(a.position[i]), Vec3(b.position[i]))));
    d.normal = std::max(d.normal, double(glm::distance(Vec3(a.normal[i]), Vec3(b.normal[i]))));
    d.albedo = std::max(d.albedo, double(glm::distance(Vec3(a.albedo[i]), Vec3(b.albedo[i]))));
    EXPECT_EQ(a.albedo[i].w, b.albedo[i].w);
  }
  return d;
}

void expect_as_traced(const Scene& scene, const Camera& camera, const Vec2& subpixel, double other) {
  const RayScene rays(scene);
  GlRenderer gl(scene);
  const GBuffer traced = trace_gbuffer(rays, camera, 150, 100, subpixel);
  const SurfaceDifference d = compare(traced, gl.rasterise(camera, 150, 100, subpixel));
  EXPECT_LE(d.other, other);
  EXPECT_LT(d.position_m, 1e-4 * double(scene.bounds.diagonal_m()));
  EXPECT_LT(d.normal, 1e-3);
  EXPECT_LT(d.albedo, 1e-3);
}

TEST(GlRaster, SeesWhatRaysSee) {
  const Scene scene = test::cornell();
  ASSERT_FALSE(scene.camera.empty());
  expect_as_traced(scene, scene.camera[0], {0.5f, 0.5f}, 0.005);
  expect_as_traced(scene, scene.camera[0], {0.1f, 0.95f}, 0.005);
}

TEST(GlRaster, SeesSmoothNormalsAndParallelViews) {
  test::AnalyticScene s = test::integrating_sphere(0.5f, 320);
  for (std::size_t i = 0; i < s.scene.normal.size(); ++i)
    s.scene.normal[i] = -glm::normalize(s.scene.position[i]);
  expect_as_traced(s.scene, s.scene.camera[0], {0.5f, 0.5f}, 0.005);
  Camera parallel = s.scene.camera[0];
  parallel.perspective = false, parallel.ymag_m = 0.7f;
  expect_as_traced(s.scene, parallel, {0.3f, 0.6f}, 0.005);
}

TEST(GlRaster, LosesNothingNearTheEye) {
  test::AnalyticScene s = test::furnace(0.5f);
  Camera near = test::look_at({1, 1e-4f, 0.7f}, {1.5f, 0, 0.7f}, {0, 1, 0}, 1.2f);  // a hair above the floor
  expect_as_traced(s.scene, near, {0.5f, 0.5f}, 0.01);
}

/// A quad with a texture of holes before another; half of the first is open.
TEST(GlRaster, LooksThroughHoles) {
  Scene scene;
  Texture checks;
  checks.width = checks.height = 2, checks.nearest = true;
  checks.texels = {Vec4(1, 1, 1, 1), Vec4(1, 1, 1, 0), Vec4(1, 1, 1, 0), Vec4(1, 1, 1, 1)};
  scene.texture.push_back(checks);
  test::begin_instance(scene, "wall", test::add_lambert(scene, "wall", 0.25f));
  test::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const std::uint32_t mask = test::add_lambert(scene, "mask", 0.75f);
  scene.material[mask].alpha_mode = Material::Alpha::mask;
  scene.material[mask].base_colour.texture = 0;
  scene.material[mask].base_colour.scale = Vec2(4, 4);
  scene.material[mask].base_colour.rotation_rad = 0.3f;
  test::begin_instance(scene, "mask", mask);
  test::add_quad(scene, {-0.5f, -0.5f, 0.5f}, {1, 0, 0}, {0, 1, 0});
  scene.uv0.assign(8, Vec2(0));
  for (std::size_t i = 4; i < 8; ++i) scene.uv0[i] = Vec2(scene.position[i]) + 0.5f;
  finalize(scene);
  const Camera camera = test::look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.5f);
  const RayScene rays(scene);
  const GBuffer traced = trace_gbuffer(rays, camera, 120, 120, {0.5f, 0.5f});
  const GBuffer drawn = GlRenderer(scene).rasterise(camera, 120, 120, {0.5f, 0.5f});
  EXPECT_LT(compare(traced, drawn).other, 0.03) << "but for the texels' edges";
  std::size_t kept = 0, through = 0;
  for (std::size_t y = 40; y < 80; ++y) {
    for (std::size_t x = 40; x < 80; ++x) (drawn.albedo[y * 120 + x].x > 0.5f ? kept : through) += 1;
  }
  EXPECT_GT(kept, 500u);
  EXPECT_GT(through, 500u);
}

class GlSplat : public ::testing::Test {
 protected:
  void expect_as_on_cpu(const Scene& scene, const Camera& camera,
                        const std::vector<IrradianceRecord>& records, std::size_t drawn_at_least) {
    const RayScene rays(scene);
    const GBuffer g = trace_gbuffer(rays, camera, 150, 110, {0.5f, 0.5f});
    GlRenderer gl(scene);
    const SplatBuffer by_cpu = splat_on_cpu(records, 0.25, g, camera),
                      by_gl = gl.splat(records, 0.25, g, camera);
    const test::SplatDifference d = test::difference(by_cpu, by_gl);
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.other_records, 4u) << "only rounding at the border of validity";
    EXPECT_GE(d.drawn, drawn_at_least);
    EXPECT_LT(d.relative, 1e-4);
    const SplatBuffer again = gl.splat(records, 0.25, g, camera);
    EXPECT_EQ(0, std::memcmp(by_gl.light.data(), again.light.data(), again.light.size() * sizeof(Vec4)));
  }
};

TEST_F(GlSplat, AgreesWithTheCpu) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const float size = scene.bounds.diagonal_m();
  expect_as_on_cpu(scene, scene.camera[0],
                   test::records_in_view(rays, scene.camera[0], 800, 0.05f * size, 0.6f * size), 9000);
}

TEST_F(GlSplat, AgreesFromInsideTheSpheres) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const Camera& camera = s.scene.camera[0];
  expect_as_on_cpu(s.scene, camera, test::records_in_view(rays, camera, 60, 4, 60), 15000);
}

TEST_F(GlSplat, AgreesForParallelViews) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  Camera camera = s.scene.camera[0];
  camera.perspective = false, camera.ymag_m = 0.3f;
  expect_as_on_cpu(s.scene, camera, test::records_in_view(rays, camera, 200, 0.1f, 2), 5000);
}

TEST_F(GlSplat, NothingComesFromNothing) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const GBuffer g = trace_gbuffer(rays, s.scene.camera[0], 20, 10, {0.5f, 0.5f});
  GlRenderer gl(s.scene);
  for (const Vec4& v : gl.splat({}, 0.2, g, s.scene.camera[0]).light) EXPECT_EQ(v, Vec4(0));
}

TEST(GlRenderer, TwoAtATimeAndManySizes) {
  const test::AnalyticScene s = test::furnace(0.5f), plane = test::point_light_over_plane();
  GlRenderer a(s.scene);
  EXPECT_NE(std::strstr(a.description(), "OpenGL 4.5"), nullptr) << a.description();
  const GBuffer first = a.rasterise(s.scene.camera[0], 40, 30, {0.5f, 0.5f});
  {
    GlRenderer b(plane.scene);
    EXPECT_EQ(b.rasterise(plane.scene.camera[0], 64, 16, {0.5f, 0.5f}).position.size(), 64u * 16u);
    EXPECT_EQ(a.rasterise(s.scene.camera[0], 10, 90, {0.5f, 0.5f}).position.size(), 900u);
  }
  EXPECT_EQ(first.position, a.rasterise(s.scene.camera[0], 40, 30, {0.5f, 0.5f}).position);
}

TEST(GlRenderer, SaysHowToDoWithoutIt) {
  const test::AnalyticScene s = test::furnace(0.5f);
  setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  try {
    GlRenderer gl(s.scene);
    ADD_FAILURE() << "expected an error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("--splat cpu"), std::string::npos) << e.what();
  }
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  GlRenderer gl(s.scene);
  EXPECT_THROW(gl.rasterise(s.scene.camera[0], 20000, 2, {0.5f, 0.5f}), Error);
}

TEST(GlRendererDeathTest, SaysSoIfTheDriverHasNoContext) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // the driver starts once per process
  const auto try_softpipe = [] {
    setenv("GALLIUM_DRIVER", "softpipe", 1);
    const test::AnalyticScene s = test::furnace(0.5f);
    try {
      GlRenderer gl(s.scene);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s\n", e.what());
      std::exit(static_cast<int>(e.code()));
    }
    std::exit(0);
  };
  EXPECT_EXIT(try_softpipe(), ::testing::ExitedWithCode(3), "--splat cpu");
}

}  // namespace
}  // namespace phos
