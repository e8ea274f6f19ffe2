#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "record/tree.h"
#include "support/hand_photons.h"
#include "support/records.h"

namespace phos {
namespace {

IrradianceCache placed(const test::Lit& lit, const RecordOptions& options, std::int64_t candidates = 5000) {
  IrradianceCache cache;
  cache.accuracy = options.accuracy;
  Counters counters;
  test::place_at_photons(cache, lit.photons, *lit.rays, options, {.max_candidates = candidates}, 1, counters);
  return cache;
}

void expect_finite(const IrradianceCache& cache) {
  for (const IrradianceRecord& r : cache.records) {
    ASSERT_TRUE(is_finite(r.irradiance) && is_finite(r.stderr_lx) && r.radius_m > 0 &&
                std::isfinite(r.radius_m));
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]));
    }
  }
}

TEST(Extremes, AnySizeOfTheSceneGivesTheSameLux) {
  const test::AnalyticScene s = test::furnace(0.5f);
  std::size_t records = 0;
  for (const float scale : {1.f, 1e-6f, 1e6f}) {
    const test::AnalyticScene t = test::scaled(s, scale);
    const test::Lit lit = test::light_up(t.scene, 100000);
    const RecordOptions options = test::all_light(t.scene);
    const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
    for (const test::Check& check : t.checks) {
      const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
      EXPECT_NEAR(r.irradiance.y, t.mean_irradiance_lx, 4.5f * r.stderr_lx.y) << scale;
    }
    const IrradianceCache cache = placed(lit, options);
    expect_finite(cache);
    if (scale == 1) records = cache.records.size();
    EXPECT_NEAR(static_cast<double>(cache.records.size()) / static_cast<double>(records), 1, 0.1) << scale;
  }
}

TEST(Extremes, AnyPowerOfTheLights) {
  for (const float luminance : {1e-12f, 1e12f}) {
    const test::AnalyticScene s = test::furnace(0.5f, luminance);
    const test::Lit lit = test::light_up(s.scene, 50000);
    const DensityEstimator maker(lit.photons, *lit.rays, test::all_light(s.scene), 1);
    for (const test::Check& check : s.checks) {
      const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
      EXPECT_NEAR(static_cast<double>(r.irradiance.y) / s.mean_irradiance_lx, 1,
                  4.5 * static_cast<double>(r.stderr_lx.y) / s.mean_irradiance_lx);
      EXPECT_GT(r.irradiance.y, 0);
    }
  }
}

/// A floor and photons put on it by hand.
class ByHand : public ::testing::Test {
 protected:
  ByHand() : scene_(test::point_light_over_plane()), rays_(scene_.scene) {}

  IrradianceCache place(const PhotonMap& map, std::span<const SurfaceSample> points = {}) {
    RecordOptions options;
    options.resolve(scene_.scene.bounds.diagonal_m() / 4);
    IrradianceCache cache;
    cache.accuracy = options.accuracy;
    points.empty() ? test::place_at_photons(cache, map, rays_, options, {}, 1, counters_)
                   : test::place_at_points(cache, map, rays_, options, {}, 1, points, counters_);
    expect_finite(cache);
    return cache;
  }

  test::AnalyticScene scene_;
  RayScene rays_;
  Counters counters_;
};

TEST_F(ByHand, NoPhotonIsAnEmptyCache) { EXPECT_TRUE(place(test::photons_on_floor({})).records.empty()); }

TEST_F(ByHand, NoPhotonAtGivenPointsIsZeroWithAnErrorAndARadius) {
  const SurfaceSample points[] = {{{0, 0, 0}, {0, 1, 0}}, {{3, 0, 1}, {0, 1, 0}}, {{3, 0, 1}, {0, 1, 0}}};
  for (const std::vector<Vec3>& places : {std::vector<Vec3>{}, {{-7, 0, -7}}}) {
    const IrradianceCache cache = place(test::photons_on_floor(places), points);
    ASSERT_GE(cache.records.size(), 1u);
    for (const IrradianceRecord& r : cache.records) {
      EXPECT_EQ(r.irradiance, Rgb(0));
      EXPECT_GT(r.radius_m, 0);
      EXPECT_EQ(r.stderr_lx.x > 0, !places.empty());
    }
    RecordTree tree(scene_.scene.bounds, cache.accuracy);
    for (const IrradianceRecord& r : cache.records) tree.insert(r);
    for (const SurfaceSample& p : points) EXPECT_TRUE(tree.covered(p.position, p.normal));
  }
}

TEST_F(ByHand, OneTwoThreePhotons) {
  for (const std::vector<Vec3>& places :
       {std::vector<Vec3>{{0, 0, 0}}, {{0, 0, 0}, {0.1f, 0, 0}}, {{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}}) {
    EXPECT_GE(place(test::photons_on_floor(places)).records.size(), 1u);
  }
}

TEST_F(ByHand, CoincidentAndCollinearPhotonsAreCounted) {
  const IrradianceCache same = place(test::photons_on_floor(std::vector<Vec3>(500, Vec3(0.5f, 0, 0.5f))));
  EXPECT_GE(same.records.size(), 1u);
  EXPECT_GE(counters_["records with degenerate hull"], 1u);
  std::vector<Vec3> line;
  for (int i = 0; i < 500; ++i) line.push_back({0.002f * static_cast<float>(i), 0, 0});
  const std::uint64_t before = counters_["records with degenerate hull"];
  EXPECT_GE(place(test::photons_on_floor(line)).records.size(), 1u);
  EXPECT_GT(counters_["records with degenerate hull"], before);
}

/// The back of a lit wall and another wall 1 cm behind it stay dark: what leaks is a stated figure, zero.
TEST(ThinWalls, NothingLeaksThrough) {
  for (const float gap : {0.01f, 0.001f}) {
    const test::AnalyticScene s = test::thin_walls(1000, gap);
    const test::Lit lit = test::light_up(s.scene, 300000);
    RecordOptions options = test::all_light(s.scene);
    options.min_photons = 20000, options.max_photons = 20000;  // zones of half a metre: a slab of centimetres
    const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
    double leak = 0, lit_lx = 0;
    for (const test::Check& check : s.checks) {
      const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
      if (check.irradiance_lx > 0) {
        lit_lx = std::max(lit_lx, static_cast<double>(r.irradiance.y));
        EXPECT_NEAR(static_cast<double>(r.irradiance.y) / check.irradiance_lx, 1,
                    0.2);  // the mean of a wide zone
      } else {
        leak = std::max(leak, static_cast<double>(r.irradiance.y));
      }
    }
    EXPECT_EQ(leak, 0) << "of " << lit_lx << " lx, gap " << gap;
  }
}

/// Each face of a sheet has its own light, a hundredfold apart.
TEST(TwoSidedSheet, FacesDoNotMix) {
  const test::AnalyticScene s = test::two_sided_sheet(1000, 10);
  const test::Lit lit = test::light_up(s.scene, 300000);
  const DensityEstimator maker(lit.photons, *lit.rays, test::all_light(s.scene), 1);
  for (const test::Check& check : s.checks) {
    const IrradianceRecord r = test::record_at(maker, check.position, check.normal);
    EXPECT_NEAR(static_cast<double>(r.irradiance.y) / check.irradiance_lx, 1, 0.12);
  }
}

TEST(Determinism, RecordsAreTheSameForAnyNumberOfThreads) {
  const test::AnalyticScene s = test::uniform_box(0.5f);
  const test::Lit lit = test::light_up(s.scene, 50000);
  std::vector<IrradianceCache> caches;
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    caches.push_back(placed(lit, test::all_light(s.scene)));
  }
  set_threads(0);
  for (const IrradianceCache& c : caches) {
    ASSERT_EQ(c.records.size(), caches[0].records.size());
    EXPECT_EQ(
        std::memcmp(c.records.data(), caches[0].records.data(), c.records.size() * sizeof(IrradianceRecord)),
        0);
  }
}

/// Points that a cache misses are covered after one more round, and a further round adds nothing.
TEST(Rounds, PointsAreCoveredAndThenNothingIsAdded) {
  const test::AnalyticScene s = test::uniform_box(0.5f);
  const test::Lit lit = test::light_up(s.scene, 50000);
  const RecordOptions options = test::all_light(s.scene);
  IrradianceCache cache = placed(lit, options, 200);
  std::vector<SurfaceSample> points;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    RandomStream random(14, Stage::test, i);
    const Vec2 u = random.uniform2();
    if (i % 2 == 0) {
      points.push_back({{2 * u.x, 0, 1.5f * u.y}, {0, 1, 0}});
    } else {
      points.push_back({{0, u.x, 1.5f * u.y}, {1, 0, 0}});
    }
  }
  const std::vector<IrradianceRecord> before = cache.records;
  Counters counters;
  const PlacementReport first =
      test::place_at_points(cache, lit.photons, *lit.rays, options, {.passes = 10}, 1, points, counters);
  EXPECT_GT(first.kept, 0u);
  EXPECT_EQ(first.uncovered, 0u);
  ASSERT_EQ(cache.records.size(), before.size() + first.kept);
  EXPECT_EQ(std::memcmp(cache.records.data(), before.data(), before.size() * sizeof(IrradianceRecord)), 0);
  const PlacementReport second =
      test::place_at_points(cache, lit.photons, *lit.rays, options, {.passes = 10}, 1, points, counters);
  EXPECT_EQ(second.kept, 0u);
  EXPECT_EQ(second.uncovered, 0u);
}

}  // namespace
}  // namespace phos
