#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "splat/cpu/splatter_kernel.h"
#include "splat/tiles.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

constexpr float kAccuracy = 0.25f;

class CpuSplat : public ::testing::Test {
 protected:
  test::AnalyticScene s = test::furnace(0.5f);
  RayScene rays{s.scene};
  Camera camera = s.scene.camera[0];
  GBuffer g = trace_gbuffer(rays, camera, 75, 53, {0.5f, 0.5f});

  void expect_as_one_by_one(const std::vector<IrradianceRecord>& records, std::size_t drawn_at_least) const {
    const SplatBuffer buffer = splat_on_cpu(records, kAccuracy, g, camera);
    const test::SplatDifference d = test::difference(test::splat_one_by_one(records, kAccuracy, g), buffer);
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.other_records, 2u) << "only rounding at the border of validity";
    EXPECT_GE(d.drawn, drawn_at_least);
    EXPECT_LT(d.relative, 1e-4);
  }
};

TEST_F(CpuSplat, IsEveryRecordAtEveryPixel) {
  expect_as_one_by_one(test::records_in_view(rays, camera, 300, 0.2f, 1.5f), 2500);
}

TEST_F(CpuSplat, DrawsOnCurvedSurfaces) {
  s = test::integrating_sphere(0.5f, 1280);
  for (std::size_t i = 0; i < s.scene.normal.size(); ++i)
    s.scene.normal[i] = -glm::normalize(s.scene.position[i]);
  const RayScene sphere(s.scene);
  camera = s.scene.camera[0];
  g = trace_gbuffer(sphere, camera, 75, 53, {0.5f, 0.5f});
  expect_as_one_by_one(test::records_in_view(sphere, camera, 300, 0.2f, 1.5f), 2500);
}

TEST_F(CpuSplat, DrawsRecordsThatContainTheEye) {
  expect_as_one_by_one(test::records_in_view(rays, camera, 20, 8, 30), g.position.size() - 500);
}

TEST_F(CpuSplat, DrawsRecordsOutsideThePictureThatReachIntoIt) {
  Camera wide = camera;
  wide.yfov_rad = 2.6f;
  std::vector<IrradianceRecord> records = test::records_in_view(rays, wide, 400, 0.2f, 6);
  const Projection projection(camera, g.width, g.height);
  std::erase_if(records, [&](const IrradianceRecord& r) {
    return !projection.sphere_bounds(r.position, 1e-9).empty();
  });
  ASSERT_GT(records.size(), 50u);
  expect_as_one_by_one(records, 500);
}

TEST_F(CpuSplat, IsZeroWithoutRecords) {
  const SplatBuffer buffer = splat_on_cpu({}, kAccuracy, g, camera);
  ASSERT_EQ(buffer.light.size(), g.position.size());
  for (const Vec4& v : buffer.light) EXPECT_EQ(v, Vec4(0));
  for (const Vec4& v : buffer.error) EXPECT_EQ(v, Vec4(0));
}

TEST_F(CpuSplat, IsTheSameForAnyNumberOfThreads) {
  const std::vector<IrradianceRecord> records = test::records_in_view(rays, camera, 500, 0.2f, 3);
  set_threads(1);
  const SplatBuffer one = splat_on_cpu(records, kAccuracy, g, camera);
  set_threads(2);
  const SplatBuffer two = splat_on_cpu(records, kAccuracy, g, camera);
  EXPECT_EQ(0, std::memcmp(one.light.data(), two.light.data(), one.light.size() * sizeof(Vec4)));
  EXPECT_EQ(0, std::memcmp(one.error.data(), two.error.data(), one.error.size() * sizeof(Vec4)));
}

TEST_F(CpuSplat, WeighsUpToTheBorderAndNotBeyond) {
  // Looking down on the floor y = 0; one record in the middle of the picture.
  camera = test::look_at({1, 0.9f, 0.7f}, {1, 0, 0.7f}, {0, 0, 1}, 1);
  g = trace_gbuffer(rays, camera, 75, 75, {0.5f, 0.5f});
  IrradianceRecord r;
  r.position = Vec3(g.position[37 * 75 + 37]), r.normal = {0, 1, 0};
  r.irradiance = Rgb(1, 2, 3), r.radius_m = 1;
  const SplatBuffer buffer = splat_on_cpu(std::vector{r}, kAccuracy, g, camera);
  int valid = 0;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    if (g.normal[i].y < 0.5f) continue;
    const float distance = glm::distance(Vec3(g.position[i]), r.position);
    const float weight = std::max(0.f, 1 - distance / kAccuracy);
    ASSERT_NEAR(buffer.light[i].w, weight, 2e-6);
    ASSERT_NEAR(buffer.light[i].z, 3 * weight, 1e-5);
    ASSERT_TRUE(distance < 1.0001f * kAccuracy || buffer.error[i].w == 0);
    valid += buffer.error[i].w > 0;
  }
  EXPECT_GT(valid, 100);
  EXPECT_FLOAT_EQ(buffer.light[37 * 75 + 37].w, 1);
}

TEST_F(CpuSplat, LeavesTheOtherSideAndTheBackgroundAlone) {
  const test::AnalyticScene walls = test::thin_walls();
  const RayScene wall_rays(walls.scene);
  camera = test::look_at({0, 0, 8}, {0, 0, 0}, {0, 1, 0}, 0.9f);
  g = trace_gbuffer(wall_rays, camera, 64, 64, {0.5f, 0.5f});
  IrradianceRecord back;
  back.position = {0, 0, 0}, back.normal = {0, 0, -1}, back.irradiance = Rgb(5), back.radius_m = 100;
  IrradianceRecord raised = back;
  raised.position = {0, 0, 2}, raised.normal = {0, 0, 1};  // in front of the wall
  const SplatBuffer buffer = splat_on_cpu(std::vector{back, raised}, kAccuracy, g, camera);
  for (std::size_t i = 0; i < g.position.size(); ++i) EXPECT_EQ(buffer.error[i].w, 0);
  raised.position.z = 0;
  const SplatBuffer lit = splat_on_cpu(std::vector{raised}, kAccuracy, g, camera);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    EXPECT_EQ(lit.error[i].w > 0, g.covered(i));
    drawn += lit.error[i].w > 0;
  }
  EXPECT_GT(drawn, 300u);
  EXPECT_LT(drawn, g.position.size());
}

TEST_F(CpuSplat, HoldsExtrapolationBetweenZeroAndTwice) {
  IrradianceRecord r;
  r.position = {1, 0, 0.7f}, r.normal = {0, 1, 0}, r.irradiance = Rgb(10), r.radius_m = 4;
  r.translation_gradient[0] = {1e4f, 0, 0};
  camera = test::look_at({1, 0.9f, 0.7f}, {1, 0, 0.7f}, {0, 0, 1}, 1);
  g = trace_gbuffer(rays, camera, 64, 64, {0.5f, 0.5f});
  const SplatBuffer buffer = splat_on_cpu(std::vector{r}, kAccuracy, g, camera);
  bool low = false, high = false;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    if (buffer.light[i].w == 0) continue;
    const float e = buffer.light[i].x / buffer.light[i].w;
    ASSERT_GE(e, 0);
    ASSERT_LE(e, 20.001f);
    low |= e<0.001f, high |= e> 19.99f;
  }
  EXPECT_TRUE(low && high);
}

TEST_F(CpuSplat, KernelsGiveTheSameBits) {
#ifdef PHOS_SPLAT_AVX2
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  const std::vector<IrradianceRecord> records = test::records_in_view(rays, camera, 40, 0.5f, 20);
  std::vector<PackedRecord> packed;
  std::vector<TileRecord> list;
  for (const IrradianceRecord& r : records) {
    list.push_back({static_cast<std::uint32_t>(packed.size())});
    packed.push_back(pack_record(r));
  }
  auto plain = std::make_unique<SplatTile>(), fast = std::make_unique<SplatTile>();
  std::memset(plain.get(), 0, sizeof(SplatTile));
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const std::size_t from = i * g.position.size() / kTilePixels;
    plain->px[i] = g.position[from].x, plain->py[i] = g.position[from].y, plain->pz[i] = g.position[from].z;
    plain->nx[i] = g.normal[from].x, plain->ny[i] = g.normal[from].y, plain->nz[i] = g.normal[from].z;
  }
  *fast = *plain;
  splat_tile_plain(*plain, packed.data(), list.data(), list.size(), {1 / kAccuracy, kLeastWeight, 0.01f});
  splat_tile_avx2(*fast, packed.data(), list.data(), list.size(), {1 / kAccuracy, kLeastWeight, 0.01f});
  EXPECT_EQ(0, std::memcmp(plain.get(), fast.get(), sizeof(SplatTile)));
  EXPECT_GT(*std::max_element(plain->error[3], plain->error[3] + kTilePixels), 3);
#else
  GTEST_SKIP() << "not an x86-64 build";
#endif
}

TEST_F(CpuSplat, TilesNeverHideARecordThatCounts) {
  const TileGrid grid(g, 16);
  const std::vector<IrradianceRecord> records = test::records_in_view(rays, camera, 100, 0.1f, 5);
  std::size_t hidden = 0;
  for (const IrradianceRecord& r : records) {
    for (std::size_t i = 0; i < g.position.size(); ++i) {
      const int x = static_cast<int>(i) % g.width, y = static_cast<int>(i) / g.width;
      const bool in = grid.touches(r, kAccuracy, x / 16, y / 16);
      hidden += !in;
      const float eps = record_error(r, Vec3(g.position[i]), Vec3(g.normal[i]));
      ASSERT_TRUE(in || eps >= kAccuracy);
    }
  }
  EXPECT_GT(hidden, records.size() * g.position.size() / 4) << "or the tiles are of no use";
}

}  // namespace
}  // namespace phos
