// Drawing by EGL, and beside OSMesa in one process.
#include <gtest/gtest.h>

#include "splat/gl/probe.h"
#include "splat/gl/renderer.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

class Egl : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    try {
      description_ = try_gl(GlBy::egl);
    } catch (const NoGl& e) {
      GTEST_SKIP() << e.what();
    }
  }
  void TearDown() override { choose_gl(GlBy::osmesa); }
  std::string description_;
};

TEST_F(Egl, SaysWhatDraws) {
  EXPECT_NE(description_.find(", OpenGL 4."), std::string::npos) << description_;
  EXPECT_NE(description_.find(", EGL 1."), std::string::npos) << description_;
}

TEST_F(Egl, DrawsWhatOsmesaDraws) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Camera& camera = scene.camera[0];
  const float size = scene.bounds.diagonal_m();
  const std::vector<IrradianceRecord> records =
      test::records_in_view(rays, camera, 800, 0.05f * size, 0.6f * size);
  GlRenderer osmesa(scene);
  choose_gl(GlBy::egl);
  GlRenderer egl(scene);
  EXPECT_EQ(egl.description(), description_);
  EXPECT_NE(osmesa.description(), description_);
  // The two by turns: each takes the thread from the other.
  const GBuffer g = osmesa.rasterise(camera, 150, 110, {0.5f, 0.5f});
  const GBuffer by_egl = egl.rasterise(camera, 150, 110, {0.5f, 0.5f});
  std::size_t other = 0;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    if (g.covered(i) != by_egl.covered(i) || (g.covered(i) && g.hit[i].triangle != by_egl.hit[i].triangle)) {
      ++other;
    } else if (g.covered(i)) {
      EXPECT_LT(glm::distance(Vec3(g.position[i]), Vec3(by_egl.position[i])), 1e-4f * size) << i;
    }
  }
  EXPECT_LE(other, g.position.size() / 200) << "only pixels on edges";
  const test::SplatDifference d =
      test::difference(osmesa.splat(records, 0.25, g, camera), egl.splat(records, 0.25, g, camera));
  EXPECT_TRUE(d.finite);
  EXPECT_LE(d.other_records, 4u) << "only rounding at the border of validity";
  EXPECT_GE(d.drawn, 9000u);
  EXPECT_LT(d.relative, 1e-3);
  EXPECT_EQ(g.position, osmesa.rasterise(camera, 150, 110, {0.5f, 0.5f}).position);
}

TEST_F(Egl, OneEndsWhileTheOtherGoesOn) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const Camera& camera = s.scene.camera[0];
  GlRenderer osmesa(s.scene);
  const GBuffer before = osmesa.rasterise(camera, 40, 30, {0.5f, 0.5f});
  choose_gl(GlBy::egl);
  for (int i = 0; i < 3; ++i) {
    GlRenderer egl(s.scene);
    EXPECT_EQ(egl.rasterise(camera, 64, 16, {0.5f, 0.5f}).position.size(), 64u * 16u);
  }
  EXPECT_EQ(before.position, osmesa.rasterise(camera, 40, 30, {0.5f, 0.5f}).position);
}

}  // namespace
}  // namespace phos
