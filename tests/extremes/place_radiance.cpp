// Radiance records in scenes of any size, of nothing to place them for, and beside surfaces that want none.
#include "place/radiance_placement.h"

#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "place/modes.h"
#include "place/radiance_report.h"
#include "scene/lamp/luminaires.h"
#include "support/gathered.h"
#include "support/glossy_room.h"

namespace phos {
namespace {

struct Placed {
  RadianceCache cache;
  std::vector<RadianceRun> runs;
  Counters counters;
};

/// Of the light of the first bounce.
Placed placed_in(const Scene& scene, PlacementOptions placement, PlacementSource source = {}) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RecordOptions options = test::gather_options(scene, Quantity::indirect, 1, 64);
  options.min_radius_m = static_cast<double>(scene.bounds.diagonal_m()) / 20;
  Placed placed;
  const GlossTables tables(scene, {}, GlossBy::automatic, {}, placed.counters);
  placed.cache.accuracy = options.accuracy;
  resolve(placement, scene, source, options.accuracy);
  placed.runs = place_radiance(
      placed.cache, tables,
      [&](int order) {
        return std::make_unique<RadianceEstimator>(rays, lights, GatherSource(), options, order,
                                                   RadianceGradient::hybrid, 1);
      },
      rays, options, placement, source, placed.counters);
  return placed;
}

/// A room of a millionth and of a million times the size: records of the same light at the same places.
TEST(RadiancePlacement, ScenesOfAnySize) {
  const test::Parlour parlour;
  for (const Place place : {Place::view, Place::surface}) {
    const PlacementOptions placement{.place = place, .width = place == Place::view ? 32 : 0};
    const Placed expected = placed_in(parlour.scene, placement);
    const auto count = static_cast<double>(expected.cache.records.size());
    ASSERT_GT(count, 20);
    for (const float factor : {1e-6f, 1e6f}) {
      const Placed other = placed_in(test::scaled(parlour.scene, factor), placement);
      EXPECT_NEAR(static_cast<double>(other.cache.records.size()), count, 0.1 * count) << factor;
      ASSERT_EQ(other.runs.size(), 2u);
      double light = 0, expected_light = 0;
      for (const RadianceRecord& r : other.cache.records) {
        ASSERT_TRUE(is_finite(r));
        light += static_cast<double>(r.light[1]) / static_cast<double>(other.cache.records.size());
      }
      for (const RadianceRecord& r : expected.cache.records)
        expected_light += static_cast<double>(r.light[1]) / count;
      EXPECT_NEAR(light, expected_light, 0.05 * expected_light) << factor;
    }
  }
}

/// A camera that looks away, points in the air and none at all: no records, and nothing is left open.
TEST(RadiancePlacement, NothingWantsARecord) {
  test::Parlour parlour;
  parlour.scene.camera[0] = test::look_at({1, 1, 1}, {1, 1.9f, 1.1f}, {0, 0, 1}, 0.3f);
  for (const Placed& placed : {placed_in(parlour.scene, {.place = Place::view, .width = 16}),
                               placed_in(parlour.scene, {.place = Place::given}, {.points_given = true})}) {
    EXPECT_TRUE(placed.cache.records.empty());
    for (const RadianceRun& run : placed.runs) EXPECT_EQ(run.report.uncovered, 0u);
  }
  const std::vector<SurfaceSample> air(10, {{1, 1, 1}, {0, 1, 0}});
  EXPECT_TRUE(placed_in(parlour.scene, {.place = Place::given}, {.points_given = true, .points = air})
                  .cache.records.empty());
  EXPECT_TRUE(placed_in(parlour.scene, {.place = Place::every}, {.points_given = true, .points = air})
                  .cache.records.empty());
}

/// A scene without gloss has no runs at all.
TEST(RadiancePlacement, NoGloss) {
  const Placed placed = placed_in(test::cornell(), {.place = Place::surface});
  EXPECT_TRUE(placed.runs.empty());
  EXPECT_TRUE(placed.cache.records.empty());
  EXPECT_EQ(report_of(placed.cache, placed.runs).figures.find("relative_error")->as_number(), 0);
}

}  // namespace
}  // namespace phos
