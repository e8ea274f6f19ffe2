// Records that fade, drawn: as the functions of the cache blend them, on the CPU and by OpenGL.
#include <gtest/gtest.h>

#include <cstring>

#include "core/random.h"
#include "splat/cpu/splatter.h"
#include "splat/cpu/splatter_kernel.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/gloss_view.h"
#include "support/splat_records.h"

namespace phos {
namespace {

constexpr float kAccuracy = 0.25f;

/// Weights of all sizes, some of them 1.
template <class Record>
void fade(std::vector<Record>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    RandomStream random(5, Stage::test, i);
    records[i].weight = i % 4 == 0 ? 1.f : std::max(0.01f, random.uniform());
  }
}

TEST(SplatWeights, ByEveryMeansTheSame) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Camera& camera = scene.camera[0];
  const float size = scene.bounds.diagonal_m();
  const GBuffer g = trace_gbuffer(rays, camera, 75, 55, {0.5f, 0.5f});
  std::vector<IrradianceRecord> records = test::records_in_view(rays, camera, 200, 0.1f * size, 0.6f * size);
  const SplatBuffer whole = splat_on_cpu(records, kAccuracy, g, camera);
  fade(records);
  GlRenderer gl(scene);
  const SplatBuffer by_cpu = splat_on_cpu(records, kAccuracy, g, camera);
  EXPECT_GT(test::difference(by_cpu, whole).relative, 0.1);
  for (const SplatBuffer& other :
       {test::splat_one_by_one(records, kAccuracy, g), gl.splat(records, kAccuracy, g, camera)}) {
    const test::SplatDifference d = test::difference(by_cpu, other);
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.other_records, 4u) << "only rounding at the border of validity";
    EXPECT_GE(d.drawn, 2000u);
    EXPECT_LT(d.relative, 1e-4);
  }
}

/// One record of a weight near nothing gives its own light wherever it reaches.
TEST(SplatWeights, AloneIsItsOwn) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Camera& camera = scene.camera[0];
  const GBuffer g = trace_gbuffer(rays, camera, 75, 55, {0.5f, 0.5f});
  std::vector<IrradianceRecord> records =
      test::records_in_view(rays, camera, 1, 2 * scene.bounds.diagonal_m(), 2 * scene.bounds.diagonal_m());
  for (int c = 0; c < 3; ++c) records[0].rotation_gradient[c] = records[0].translation_gradient[c] = Vec3(0);
  records[0].weight = 0.01f;
  GlRenderer gl(scene);
  for (const SplatBuffer& drawn :
       {splat_on_cpu(records, kAccuracy, g, camera), gl.splat(records, kAccuracy, g, camera)}) {
    std::size_t covered = 0;
    for (std::size_t i = 0; i < drawn.light.size(); ++i) {
      if (drawn.error[i].w == 0) continue;
      ++covered;
      EXPECT_GT(drawn.light[i].w, 0);
      EXPECT_LE(drawn.light[i].w, 0.01f);
      EXPECT_NEAR(drawn.light[i].x / drawn.light[i].w / records[0].irradiance.x, 1, 1e-5);
    }
    EXPECT_GT(covered, 200u);
  }
}

#ifdef PHOS_SPLAT_AVX2
TEST(SplatWeights, BothKernelsGiveTheSameBits) {
  if (best_splat_kernels().discs == splat_tile_plain)
    GTEST_SKIP() << "this machine has only the plain kernel";
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  std::vector<IrradianceRecord> records = test::records_in_view(rays, scene.camera[0], 20, 0.5f, 3);
  fade(records);
  std::vector<PackedRecord> packed;
  std::vector<TileRecord> list;
  for (const IrradianceRecord& r : records)
    list.push_back({static_cast<std::uint32_t>(packed.size())}), packed.push_back(pack_record(r));
  SplatTile plain{};
  for (int i = 0; i < kTilePixels; ++i) {
    const Vec3 p =
        records[static_cast<std::size_t>(i) % 20].position + 0.01f * Vec3(static_cast<float>(i % 7));
    const Vec3 n = records[static_cast<std::size_t>(i) % 20].normal;
    plain.px[i] = p.x, plain.py[i] = p.y, plain.pz[i] = p.z, plain.nx[i] = n.x, plain.ny[i] = n.y,
    plain.nz[i] = n.z;
  }
  SplatTile wide = plain;
  splat_tile_plain(plain, packed.data(), list.data(), list.size(), {1 / kAccuracy, kLeastWeight, 0.01f});
  splat_tile_avx2(wide, packed.data(), list.data(), list.size(), {1 / kAccuracy, kLeastWeight, 0.01f});
  EXPECT_GT(plain.light[3][0], 0);
  EXPECT_EQ(0, std::memcmp(&plain, &wide, sizeof plain));
}
#endif

TEST(SplatWeights, OfGloss) {
  const test::GlossView box{test::glossy_cornell(), 90, 70};
  std::vector<RadianceRecord> records = box.records(60, 0.1f, 0.8f);
  const GlossBuffer whole = box.draw(box.cache(records));
  fade(records);
  const GlossCache faded = box.cache(records);
  GlRenderer gl(box.scene);
  const GlossBuffer looked_up = box.look_up(faded), by_cpu = box.draw(faded),
                    by_gl = gl.splat_gloss(faded, test::GlossView::kAccuracy, box.rays, box.g, box.camera,
                                           test::GlossView::kMiddle);
  std::size_t drawn = 0;
  float most = 0, other = 0;
  for (std::size_t i = 0; i < looked_up.light.size(); ++i)
    if (looked_up.light[i].w > 0)
      most = std::max(most, max_component(Rgb(looked_up.light[i]) / looked_up.light[i].w));
  for (std::size_t i = 0; i < looked_up.light.size(); ++i) {
    const Vec4 &a = looked_up.light[i], &b = by_cpu.light[i], &c = by_gl.light[i];
    if (looked_up.error[i].w != by_cpu.error[i].w || !(a.w > 0)) continue;
    ++drawn;
    for (const Vec4& v : {b, c}) {
      EXPECT_NEAR(v.w, a.w, 1e-4f);
      EXPECT_LT(max_component(glm::abs(Rgb(v) - Rgb(a))), 3e-4f * most);
    }
    other = std::max(other, std::fabs(whole.light[i].w - b.w));
  }
  EXPECT_GT(drawn, 500u);
  EXPECT_GT(other, 0.1f);
}

}  // namespace
}  // namespace phos
