// Records with footprints, drawn: as the functions of the cache blend them, among others that have none.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "core/random.h"
#include "splat/cpu/splatter.h"
#include "splat/cpu/splatter_kernel.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

constexpr float kAccuracy = 0.25f;

/// Three in four records get axes of a tenth to all of their reach, and light that bends along and about
/// them.
void shape(std::vector<IrradianceRecord>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i % 4 == 0) continue;
    IrradianceRecord& r = records[i];
    RandomStream random(7, Stage::test, i);
    const auto signed_light = [&] { return r.irradiance * (2 * random.uniform() - 1); };
    AdaptiveFootprint::Axes axes;
    for (AdaptiveFootprint::Axis& axis : axes)
      axis = {kAccuracy * r.radius_m * (0.1f + 0.9f * random.uniform()), signed_light(), signed_light(),
              signed_light(), signed_light()};
    const Frame frame = make_frame(r.normal);
    r.footprint = std::make_shared<AdaptiveFootprint>(frame.x, r.normal, axes);
    r.radius_m = r.footprint->longest_m() / kAccuracy;
  }
}

struct View {
  Scene scene;
  RayScene rays{scene};
  GBuffer g = trace_gbuffer(rays, scene.camera[0], 75, 55, {0.5f, 0.5f});
  std::vector<IrradianceRecord> records;

  explicit View(Scene s) : scene(std::move(s)) {
    const float size = scene.bounds.diagonal_m();
    records = test::records_in_view(rays, scene.camera[0], 300, 0.1f * size, 0.6f * size);
    shape(records);
  }
};

void expect_alike(const SplatBuffer& drawn, const SplatBuffer& expected) {
  const test::SplatDifference d = test::difference(drawn, expected);
  EXPECT_TRUE(d.finite);
  EXPECT_LE(d.other_records, 4u) << "only rounding at the border of validity";
  EXPECT_GE(d.drawn, 2000u);
  EXPECT_LT(d.relative, 1e-4);
}

/// On the CPU as one by one, and by OpenGL as on the CPU.
void expect_the_same(const View& view) {
  const Camera& camera = view.scene.camera[0];
  const SplatBuffer by_cpu = splat_on_cpu(view.records, kAccuracy, view.g, camera);
  expect_alike(by_cpu, test::splat_one_by_one(view.records, kAccuracy, view.g));
  GlRenderer gl(view.scene);
  const SplatBuffer by_gl = gl.splat(view.records, kAccuracy, view.g, camera);
  expect_alike(by_gl, by_cpu);
  const SplatBuffer again = gl.splat(view.records, kAccuracy, view.g, camera);
  EXPECT_EQ(0, std::memcmp(by_gl.light.data(), again.light.data(), again.light.size() * sizeof(Vec4)));
}

TEST(SplatFootprint, OnFlatSurfacesAsTheCacheReads) { expect_the_same(View(test::cornell())); }

TEST(SplatFootprint, OnRoundSurfacesAsTheCacheReads) {
  expect_the_same(View(std::move(test::furnace(0.5f).scene)));
}

#ifdef PHOS_SPLAT_AVX2
TEST(SplatFootprint, BothKernelsGiveTheSameBits) {
  if (best_splat_kernels().footprint == splat_footprint_plain)
    GTEST_SKIP() << "this machine has only the plain kernel";
  const View view(std::move(test::furnace(0.5f).scene));
  SplatTile plain{};
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const std::size_t from = i * view.g.position.size() / kTilePixels;
    const Vec3 p(view.g.position[from]), n(view.g.normal[from]);
    plain.px[i] = p.x, plain.py[i] = p.y, plain.pz[i] = p.z;
    plain.nx[i] = n.x, plain.ny[i] = n.y, plain.nz[i] = n.z;
  }
  SplatTile wide = plain;
  const SplatRule rule{1 / kAccuracy, kLeastWeight, 0.01f};
  for (const IrradianceRecord& r : view.records) {
    if (!r.footprint) continue;
    const PackedRecord record = pack_record(r);
    const PackedFootprint footprint = pack_footprint(r);
    splat_footprint_plain(plain, record, footprint, 0, kTilePixels, rule);
    splat_footprint_avx2(wide, record, footprint, 0, kTilePixels, rule);
  }
  EXPECT_GT(*std::max_element(plain.error[3], plain.error[3] + kTilePixels), 3);
  EXPECT_EQ(0, std::memcmp(&plain, &wide, sizeof plain));
}
#endif

/// Nothing is not a number where a record's middle is seen, or where its axes are as short as floats go.
TEST(SplatFootprint, OfNoLengthAndInItsMiddle) {
  View view(test::cornell());
  IrradianceRecord r = view.records[1];
  const auto pixel = static_cast<std::size_t>(75 * 30 + 40);
  r.position = Vec3(view.g.position[pixel]), r.normal = Vec3(view.g.normal[pixel]);
  AdaptiveFootprint::Axes axes = r.footprint->axes();
  axes[3].length_m = 1e-38f;
  r.footprint = std::make_shared<AdaptiveFootprint>(make_frame(r.normal).x, r.normal, axes);
  const SplatBuffer drawn = splat_on_cpu(std::vector{r}, kAccuracy, view.g, view.scene.camera[0]);
  EXPECT_TRUE(test::difference(drawn, drawn).finite);
  EXPECT_NEAR(drawn.light[pixel].x / drawn.light[pixel].w / r.irradiance.x, 1, 1e-4);
  const SplatBuffer by_gl =
      GlRenderer(view.scene).splat(std::vector{r}, kAccuracy, view.g, view.scene.camera[0]);
  EXPECT_TRUE(test::difference(drawn, by_gl).finite);
  EXPECT_NEAR(by_gl.light[pixel].x / by_gl.light[pixel].w / r.irradiance.x, 1, 1e-4);
}

}  // namespace
}  // namespace phos
