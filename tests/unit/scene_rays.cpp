// Hits, the points they stand for, holes, normals and visibility.
#include "scene/rays.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/quad.h"

using namespace phos;
using namespace phos::test;

namespace {

Scene floor_scene() {
  Scene scene;
  scene.material.resize(1);
  add_quad(scene, 1, 1, 0, true, 0);
  return scene;
}

Ray down(float x, float y, float z = 1) { return {Vec3(x, y, z), Vec3(0, 0, -1), 0, kInfinity}; }

/// Leaves numbers beyond what rays may have where the next call has its variables.
[[gnu::noinline]] void litter_stack() {
  volatile unsigned char mess[1 << 14];
  for (volatile unsigned char& c : mess) c = 0x7f;
}

}  // namespace

TEST(Rays, FindTheNearestPoint) {
  Scene scene = floor_scene();
  add_quad(scene, 1, 1, 0.5f, true, 0);
  const RayScene rays(scene);
  SurfacePoint p;
  ASSERT_TRUE(trace(rays, down(0.3f, -0.2f), p));
  EXPECT_NEAR(glm::length(p.position - Vec3(0.3f, -0.2f, 0.5f)), 0, 1e-6f);
  EXPECT_NEAR(p.distance_m, 0.5f, 1e-6f);
  EXPECT_EQ(p.instance, 1u);
  EXPECT_TRUE(p.front);
  EXPECT_EQ(p.geometric_normal, Vec3(0, 0, 1));
  ASSERT_TRUE(trace(rays, {Vec3(0.3f, -0.2f, -3), Vec3(0, 0, 1), 0, kInfinity}, p));
  EXPECT_FALSE(p.front);
  EXPECT_EQ(p.instance, 0u);
  EXPECT_EQ(p.geometric_normal, Vec3(0, 0, -1));
  EXPECT_EQ(p.smooth_normal, Vec3(0, 0, -1));
  EXPECT_FALSE(trace(rays, down(3, 0), p));
  Hit hit;
  EXPECT_FALSE(rays.intersect({Vec3(0, 0, 1), Vec3(0, 0, -1), 0, 0.4f}, hit));
  EXPECT_TRUE(rays.intersect({Vec3(0, 0, 1), Vec3(0, 0, -1), 0.6f, kInfinity}, hit));
  EXPECT_NEAR(hit.distance_m, 1, 1e-6f);
  EXPECT_NE(rays.native(), nullptr);
}

TEST(Rays, AnEmptySceneIsNotAnError) {
  const Scene scene;
  const RayScene rays(scene);
  Hit hit;
  EXPECT_FALSE(rays.intersect(down(0, 0), hit));
  EXPECT_FALSE(rays.occluded(down(0, 0)));
}

TEST(Rays, InstructionSetsAgreeAndUnknownOnesAreRefused) {
  const Scene scene = floor_scene();
  const RayScene best(scene), oldest(scene, {"sse2"});
  SurfacePoint a, b;
  ASSERT_TRUE(trace(best, down(0.37f, 0.11f), a) && trace(oldest, down(0.37f, 0.11f), b));
  EXPECT_LT(glm::length(a.position - b.position), 1e-6f);
  EXPECT_THROW(RayScene(scene, {"abacus"}), Error);
}

TEST(Rays, PacketsThatAreNotFullAreTheirRays) {
  const Scene scene = floor_scene();
  for (const char* isa : {"", "sse2"}) {
    const RayScene rays(scene, {isa});
    for (std::size_t n = 1; n <= 17; ++n) {
      const std::vector<Ray> ray(n, down(0.3f, -0.2f));
      std::vector<Hit> hit(n);
      litter_stack();
      rays.intersect(ray, hit);
      for (const Hit& h : hit) EXPECT_NEAR(h.distance_m, 1, 1e-6f) << isa << ", " << n << " rays";
    }
  }
}

TEST(Rays, PassThroughMaskedTexels) {
  Scene scene = floor_scene();
  Texture t;
  t.width = 2, t.height = 1;
  t.nearest = true;
  t.texels = {Vec4(1, 1, 1, 0), Vec4(1)};  // left half is a hole
  scene.texture = {t};
  scene.material.resize(2);
  scene.material[1].base_colour.texture = 0;
  add_quad(scene, 1, 1, 0.5f, true, 1);
  for (const auto mode : {Material::Alpha::opaque, Material::Alpha::mask}) {
    scene.material[1].alpha_mode = mode;
    const RayScene rays(scene);
    SurfacePoint p;
    ASSERT_TRUE(trace(rays, down(-0.5f, 0), p));
    EXPECT_EQ(p.instance, mode == Material::Alpha::opaque ? 1u : 0u);
    EXPECT_EQ(p.triangle / 2, p.instance);
    EXPECT_EQ(rays.occluded({Vec3(-0.5f, 0, 1), Vec3(0, 0, -1), 0, 0.8f}), mode == Material::Alpha::opaque);
    ASSERT_TRUE(trace(rays, down(0.5f, 0), p));
    EXPECT_EQ(p.instance, 1u);
    EXPECT_TRUE(rays.occluded({Vec3(0.5f, 0, 1), Vec3(0, 0, -1), 0, 0.8f}));
  }
  // What is blended is there, in part: light passes straight through the rest of it.
  scene.material[1].alpha_mode = Material::Alpha::blend;
  const RayScene rays(scene);
  EXPECT_EQ(rays.transmittance({Vec3(-0.5f, 0, 1), Vec3(0, 0, -1), 0, 0.8f}), Rgb(1));
  EXPECT_EQ(rays.transmittance({Vec3(0.5f, 0, 1), Vec3(0, 0, -1), 0, 0.8f}), Rgb(0));
  EXPECT_TRUE(rays.occluded({Vec3(-0.5f, 0, 1), Vec3(0, 0, -1), 0, 0.8f})) << "panes too";
}

TEST(Rays, InterpolateNormalsColoursAndCoordinates) {
  Scene scene = floor_scene();
  for (std::size_t i = 0; i < 4; ++i) {
    scene.normal[i] = glm::normalize(Vec3(scene.position[i].x, 0, 1));
    scene.colour.push_back(Vec4(scene.position[i].x > 0 ? 1 : 0, 1, 1, 1));
  }
  Texture t;
  t.width = t.height = 1;
  t.texels = {Vec4(1)};
  scene.texture = {t};
  scene.material[0].base_colour.texture = 0;
  const RayScene rays(scene);
  SurfacePoint p;
  ASSERT_TRUE(trace(rays, down(0.5f, 0.2f), p));
  EXPECT_NEAR(p.colour.x, 0.75f, 1e-5f);
  EXPECT_NEAR(p.uv0.x, 0.75f, 1e-5f);
  EXPECT_NEAR(p.uv0.y, 0.4f, 1e-5f);
  EXPECT_NEAR(p.smooth_normal.x / p.smooth_normal.z, 0.5f, 1e-4f);
  EXPECT_EQ(p.geometric_normal, Vec3(0, 0, 1));
  EXPECT_NEAR(glm::dot(p.tangent, p.normal), 0, 1e-6f);
  EXPECT_NEAR(glm::length(p.tangent), 1, 1e-6f);
}

TEST(Rays, ShadingNormalsStayOnTheSeenSide) {
  Scene scene = floor_scene();
  for (Vec3& n : scene.normal) n = glm::normalize(Vec3(1, 0, -0.2f));  // a crease, past the horizon
  SurfacePoint p;
  ASSERT_TRUE(trace(RayScene(scene), down(0, 0), p));
  EXPECT_GT(glm::dot(p.smooth_normal, p.geometric_normal), 0.04f);
  EXPECT_GT(p.smooth_normal.x, 0.9f);
  for (Vec3& n : scene.normal) n = Vec3(0, 0, -1);  // turned inside out
  ASSERT_TRUE(trace(RayScene(scene), down(0, 0), p));
  EXPECT_EQ(p.smooth_normal, Vec3(0, 0, 1));
  for (Vec3& n : scene.normal) n = glm::normalize(Vec3(1, 0, 0.3f));
  const Vec3 away = glm::normalize(Vec3(1, 0, -0.1f));  // sees the back of the shading normal
  ASSERT_TRUE(trace(RayScene(scene), {Vec3(-0.5f, 0, 0.05f), away, 0, kInfinity}, p));
  EXPECT_GT(glm::dot(p.normal, -away), 0);
  EXPECT_LT(glm::dot(p.smooth_normal, -away), 0);
}

TEST(Rays, NormalMapsTiltAlongTheTexture) {
  // The map leans towards +u; on this floor u grows along x. Green leans up the picture, which is +y here.
  Scene scene = floor_scene();
  Texture t;
  t.width = t.height = 1;
  scene.texture = {t};
  scene.material[0].normal.texture = 0;
  for (const bool tangents : {false, true}) {
    if (tangents) scene.tangent.assign(4, Vec4(1, 0, 0, 1));
    scene.texture[0].texels = {Vec4(0.8f, 0.5f, 0.9f, 1)};
    SurfacePoint front, back;
    ASSERT_TRUE(trace(RayScene(scene), down(0, 0.1f), front));
    EXPECT_NEAR(front.normal.x, 0.6f, 1e-5f);
    EXPECT_NEAR(front.normal.z, 0.8f, 1e-5f);
    EXPECT_EQ(front.smooth_normal, Vec3(0, 0, 1));
    EXPECT_NEAR(glm::dot(front.tangent, front.normal), 0, 1e-6f);
    ASSERT_TRUE(trace(RayScene(scene), {Vec3(0, 0.1f, -1), Vec3(0, 0, 1), 0, kInfinity}, back));
    EXPECT_NEAR(back.normal.x, -0.6f, 1e-5f);
    EXPECT_NEAR(back.normal.z, -0.8f, 1e-5f);
    scene.texture[0].texels = {Vec4(0.5f, 0.8f, 0.9f, 1)};
    ASSERT_TRUE(trace(RayScene(scene), down(0, 0.1f), front));
    EXPECT_NEAR(front.normal.y, 0.6f, 1e-5f);
  }
}

TEST(Rays, SeeWhatNothingHides) {
  Scene scene = floor_scene();
  add_quad(scene, 1, 1, 2, false, 0);
  add_quad(scene, 0.2f, 0.2f, 1, true, 0);
  const RayScene rays(scene);
  SurfacePoint low, high, side;
  ASSERT_TRUE(trace(rays, down(0, 0.1f, 0.5f), low));
  ASSERT_TRUE(trace(rays, {Vec3(0, 0.1f, 1.5f), Vec3(0, 0, 1), 0, kInfinity}, high));
  ASSERT_TRUE(trace(rays, {Vec3(0.9f, 0.1f, 1.5f), Vec3(0, 0, 1), 0, kInfinity}, side));
  EXPECT_FALSE(rays.visible(low, high));
  EXPECT_FALSE(rays.visible(low, high.position, high.error_m));
  EXPECT_TRUE(rays.visible(low, side) && rays.visible(side, low));
  EXPECT_TRUE(rays.visible(low, side.position, side.error_m));
  EXPECT_TRUE(rays.visible(low, low.position, 0));
}
