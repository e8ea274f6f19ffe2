// Energy in a closed room with glossy and diffuse walls: what they absorb is what the lamp emits, by photons
// and by irradiance and radiance records. The light that gloss sends on (concentrated on other gloss, and on
// paint) is a good part of it.
#include <gtest/gtest.h>

#include "core/random.h"
#include "estimate/gather.h"
#include "estimate/radiance_density.h"
#include "estimate/radiance_gather.h"
#include "place/modes.h"
#include "place/radiance_placement.h"
#include "place/two_level.h"
#include "radiance/gloss_cache.h"
#include "scene/lamp/luminaires.h"
#include "support/energy.h"
#include "support/gathered.h"

namespace phos {
namespace {

constexpr std::int64_t kPaths = 100'000;
constexpr int kOrder = test::Absorption::kOrder;

/// Mean over runs of other photons, places and rays, and its standard error.
struct Closure {
  double mean = 0, error = 0;
};
Closure closure(int runs, const std::function<double(std::uint64_t seed)>& absorbed_lm) {
  double sum = 0, squares = 0;
  for (int i = 0; i < runs; ++i) {
    const double share = absorbed_lm(static_cast<std::uint64_t>(i + 1)) / 100;
    sum += share, squares += share * share;
  }
  const double mean = sum / runs;
  return {mean, std::sqrt(std::max(0., squares / runs - mean * mean) / (runs - 1))};
}

double by_hull(const Scene& room, const Scene& transport, std::uint64_t seed) {
  const test::Lit lit = test::light_up(transport, kPaths, seed);
  RecordOptions options;
  options.resolve(room.bounds.diagonal_m() / 4);
  const DensityEstimator irradiance(lit.photons, *lit.rays, options, seed);
  const RadianceDensityEstimator radiance(lit.photons, *lit.rays, options, kOrder, RadianceGradient::none,
                                          seed);
  return test::absorbed_lm(room, irradiance, radiance, 8, seed);
}

double by_gathering(const test::Lit& lit, const GatherSource& source, const Scene& room, std::uint64_t seed) {
  const Luminaires lights(*lit.scene);
  const RecordOptions options = test::gather_options(room, Quantity::indirect, -1, 128);
  const GatherEstimator irradiance(*lit.rays, lights, source, options, seed);
  const RadianceEstimator radiance(*lit.rays, lights, source, options, kOrder, RadianceGradient::none, seed);
  return test::absorbed_lm(room, irradiance, radiance, 4, seed);
}

/// Rays that land on gloss are followed.
double by_following(const Scene& room, const Scene& transport, std::uint64_t seed) {
  const test::Lit lit = test::light_up(transport, kPaths, seed);
  const CoarseLevel coarse(*lit.rays, lit.photons, test::gather_options(room, Quantity::indirect, -1, 128),
                           seed);
  return by_gathering(lit, coarse.source(), room, seed);
}

/// Rays that land on gloss read radiance records of photons.
double by_reading(const Scene& room, std::uint64_t seed) {
  const test::Lit lit = test::light_up(room, kPaths, seed);
  const RecordOptions options = test::gather_options(room, Quantity::indirect, -1, 128);
  const CoarseLevel coarse(*lit.rays, lit.photons, options, seed);
  Counters counters;
  static const GlossTables tables(room, {}, GlossBy::cached, {}, counters);
  RecordOptions wide = options;
  wide.accuracy = 0.4;
  RadianceCache cache;
  cache.accuracy = wide.accuracy;
  const auto estimator_of = [&](int order) {
    return std::make_unique<RadianceDensityEstimator>(lit.photons, *lit.rays, wide, order,
                                                      RadianceGradient::analytic, seed);
  };
  PlacementSource where{.photons = &lit.photons, .seed = seed};
  PlacementOptions placement;
  resolve(placement, room, where, wide.accuracy);
  place_radiance(cache, tables, estimator_of, *lit.rays, wide, placement, where, counters);
  GlossCache gloss(room.bounds, cache.accuracy, tables);
  for (const RadianceRecord& r : cache.records) gloss.insert(r);
  GatherSource source = coarse.source();
  source.gloss = &gloss;
  return by_gathering(lit, source, room, seed);
}

/// In the integers that photons are counted in.
TEST(Energy, PhotonsAreConservedExactly) {
  const test::Lit lit = test::light_up(test::glossy_room(), 20'000);
  const PhotonTotals& t = lit.photons.totals;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_GT(t.emitted_sum.units[c], 0);
    EXPECT_EQ(t.emitted_sum.units[c], t.absorbed_sum.units[c] + t.escaped_sum.units[c]);
  }
}

/// Each photon, times what the wall absorbs of light from there.
TEST(Energy, WhatWallsAbsorbOfPhotonsIsAll) {
  const test::Lit lit = test::light_up(test::glossy_room(), kPaths);
  std::vector<test::Absorption> share;
  for (std::uint32_t m = 0; m < lit.scene->material.size(); ++m) share.emplace_back(*lit.scene, m);
  double sum = 0;
  for (std::size_t i = 0; i < lit.photons.size(); ++i) {
    const Vec3 n = decode_octahedral(lit.photons.normal[i]), w = decode_octahedral(lit.photons.direction[i]);
    const std::size_t wall = n.y > 0.5f ? 1 : n.x < -0.5f ? 2 : n.z > 0.5f ? 3 : 0;
    sum += static_cast<double>(share[wall].of(glm::dot(n, w)) * lit.photons.flux[i].y);
  }
  EXPECT_NEAR(sum / 100, 1, 0.006);  // 100,000 paths of very different lengths
}

TEST(Energy, RecordsOfPhotonsCloseIt) {
  const Scene room = test::glossy_room();
  const Closure c = closure(4, [&](std::uint64_t seed) { return by_hull(room, room, seed); });
  EXPECT_NEAR(c.mean, 1, 4 * c.error + 0.001);
  EXPECT_LT(c.error, 0.005);
}

TEST(Energy, RecordsOfRaysCloseIt) {
  const Scene room = test::glossy_room();
  const Closure c = closure(4, [&](std::uint64_t seed) { return by_following(room, room, seed); });
  EXPECT_NEAR(c.mean, 1, 4 * c.error + 0.001);
  EXPECT_LT(c.error, 0.005);
}

/// Radiance records that are read by the rays of others.
TEST(Energy, RecordsThatReadRecordsCloseIt) {
  const Scene room = test::glossy_room();
  const Closure c = closure(3, [&](std::uint64_t seed) { return by_reading(room, seed); });
  EXPECT_NEAR(c.mean, 1, 4 * c.error + 0.001);
  EXPECT_LT(c.error, 0.005);
}

/// The same figures without what gloss sends on: a third is missing.
TEST(Energy, WithoutGlossItIsShort) {
  const Scene room = test::glossy_room(), dull = test::without_gloss(room);
  for (const auto& absorbed : {by_hull, by_following}) {
    const double share = absorbed(room, dull, 1) / 100;
    EXPECT_LT(share, 0.7);
    EXPECT_GT(share, 0.6);
  }
}

}  // namespace
}  // namespace phos
