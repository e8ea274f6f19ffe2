// Radiance records are placed where glossy surfaces want them, with the bands that those want.
#include "place/radiance_placement.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "place/growth.h"
#include "place/modes.h"
#include "place/on_surfaces.h"
#include "radiance/tree.h"
#include "support/glossy_room.h"
#include "support/radiance_records.h"

namespace phos {
namespace {

using test::FlatRadiance;
using test::Parlour;
constexpr float kSide = test::kParlourSide;

struct Studio {
  Parlour parlour;
  RayScene rays{parlour.scene};
  Counters counters;
  GlossTables tables{parlour.scene, {}, GlossBy::automatic, {}, counters};
  RecordOptions options = [&] {
    RecordOptions o;
    o.min_radius_m = static_cast<double>(parlour.scene.bounds.diagonal_m()) / 20;  // few records
    o.resolve(parlour.scene.bounds.diagonal_m() / 4);
    return o;
  }();
  std::vector<RadianceRun> runs;

  RadianceCache place(PlacementOptions placement, PlacementSource source = {}, RadianceCache cache = {}) {
    cache.accuracy = options.accuracy;
    resolve(placement, parlour.scene, source, options.accuracy);
    runs = place_radiance(
        cache, tables, [&](int order) { return std::make_unique<FlatRadiance>(rays, order); }, rays, options,
        placement, source, counters);
    return cache;
  }
};

/// Points on the floor, beneath and upon the plate, and on a wall, in turn.
std::vector<SurfaceSample> points_about(std::size_t n) {
  std::vector<SurfaceSample> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(4, Stage::test, i);
    const float u = random.uniform(), v = random.uniform();
    const SurfaceSample at[] = {{{kSide * u, 0, kSide * v}, {0, 1, 0}},
                                {{0.5f + u, 0.3f, 0.5f + v}, {0, -1, 0}},
                                {{0.5f + u, 0.3f, 0.5f + v}, {0, 1, 0}},
                                {{0, kSide * u, kSide * v}, {1, 0, 0}}};
    points.push_back(at[i % 4]);
  }
  return points;
}

TEST(MaterialAt, OfTheNearestSurface) {
  const Parlour p;
  const RayScene rays(p.scene);
  EXPECT_EQ(material_at(rays, {0.7f, 0, 0.9f}, {0, 1, 0}), p.floor);
  EXPECT_EQ(material_at(rays, {0.7f, 0.3f, 0.9f}, {0, 1, 0}), p.plate);
  EXPECT_EQ(material_at(rays, {0.7f, 0.3f, 0.9f}, {0, -1, 0}), p.plate);
  EXPECT_EQ(material_at(rays, {0.7f, 0.3f + 1e-6f, 0.9f}, {0, 1, 0}), p.plate) << "rounded";
  EXPECT_EQ(material_at(rays, {0, 0.7f, 0.9f}, {1, 0, 0}), p.walls);
  EXPECT_FALSE(material_at(rays, {0.7f, 0.15f, 0.9f}, {0, 1, 0}));
  EXPECT_FALSE(material_at(rays, {0.7f, 0.3f, 0.2f}, {0, 1, 0})) << "beside the plate";
}

TEST(MaterialAt, InScenesOfAnySize) {
  const Parlour p;
  for (const float factor : {1e-6f, 1e6f}) {
    const Scene scene = test::scaled(p.scene, factor);
    const RayScene rays(scene);
    EXPECT_EQ(material_at(rays, factor * Vec3(0.7f, 0, 0.9f), {0, 1, 0}), p.floor) << factor;
    EXPECT_EQ(material_at(rays, factor * Vec3(0.7f, 0.3f, 0.9f), {0, 1, 0}), p.plate) << factor;
    EXPECT_FALSE(material_at(rays, factor * Vec3(0.7f, 0.15f, 0.9f), {0, 1, 0})) << factor;
  }
}

/// Two sheets nearer to each other than places may lie beside their surface.
TEST(MaterialAt, TellsNearSurfacesApart) {
  Scene scene;
  for (const float height : {1e-5f, 0.f, 2e-5f}) {
    test::begin_instance(scene, "sheet", test::add_lambert(scene, text(height), 0.5f));
    test::add_quad(scene, {0, height, 0}, {0, 0, 1}, {1, 0, 0});
  }
  finalize(scene);
  const RayScene rays(scene);
  EXPECT_EQ(material_at(rays, {0.3f, 1e-5f, 0.6f}, {0, 1, 0}), 0u);
  EXPECT_EQ(material_at(rays, {0.3f, 0, 0.6f}, {0, 1, 0}), 1u);
  EXPECT_EQ(material_at(rays, {0.3f, 2e-5f, 0.6f}, {0, 1, 0}), 2u);
}

TEST(RadiancePlacement, EachMaterialHasItsOwnBandsAndOthersHaveNone) {
  Studio studio;
  const Parlour& p = studio.parlour;
  const int of_floor = studio.tables.order(p.floor), of_plate = studio.tables.order(p.plate);
  ASSERT_GT(of_floor, 0);
  ASSERT_GT(of_plate, of_floor);
  const std::vector<SurfaceSample> points = points_about(2000);
  const PlacementSource at{.points_given = true, .points = points};
  const auto expect_right = [&](const RadianceCache& cache, const char* what) {
    std::map<int, std::size_t> count;
    for (const RadianceRecord& r : cache.records) {
      const auto material = material_at(studio.rays, r.position, r.frame.z);
      ASSERT_TRUE(material) << what;
      EXPECT_EQ(r.order(), studio.tables.order(*material)) << what;
      ++count[r.order()];
    }
    EXPECT_GT(count[of_floor], 5u) << what;
    EXPECT_GT(count[of_plate], 2u) << what;
    ASSERT_EQ(studio.runs.size(), 2u);
    std::size_t kept = 0;
    for (const RadianceRun& run : studio.runs) {
      EXPECT_EQ(run.report.uncovered, 0u) << what;
      kept += run.report.kept;
    }
    EXPECT_EQ(kept, cache.records.size()) << what;
  };
  expect_right(studio.place({.passes = 20, .place = Place::given}, at), "given");
  expect_right(studio.place({.place = Place::view, .width = 60}), "view");
  expect_right(studio.place({.place = Place::surface}), "surface");
  EXPECT_LT(*studio.runs[1].report.uncovered_share, kSurfaceShare);
  EXPECT_EQ(studio.runs[0].report.sides, 4u);
  expect_right(studio.place({.place = Place::every}, at), "every");
  EXPECT_EQ(studio.runs[0].report.kept, 500u) << "on the floor";
  EXPECT_EQ(studio.runs[1].report.kept, 1000u) << "on both sides of the plate";
}

/// What a camera sees of surfaces without a diffuse part is covered too.
TEST(RadiancePlacement, EveryVisiblePointIsCovered) {
  Studio studio;
  const RadianceCache cache = studio.place({.place = Place::view, .width = 64, .height = 64});
  std::map<int, RadianceTree> trees;
  for (const RadianceRecord& r : cache.records) {
    auto [tree, fresh] =
        trees.try_emplace(r.order(), RadianceTree(studio.parlour.scene.bounds, cache.accuracy, r.order()));
    tree->second.insert(r);
  }
  RadianceTree::Worker worker;
  std::map<std::uint32_t, int> seen;
  for (int i = 0; i < 64 * 64; ++i) {
    const Vec2 st = (Vec2(i % 64, i / 64) + Vec2(0.5f)) / 64.f;
    const Camera::Ray ray = studio.parlour.scene.camera[0].ray(st, 1);
    SurfacePoint point;
    if (!trace(studio.rays, {ray.origin, ray.direction}, point)) continue;
    const int order = studio.tables.order(point.material);
    if (order == 0) continue;
    ++seen[point.material];
    const Frame frame = make_frame(point.smooth_normal);
    EXPECT_GT(trees.at(order).interpolate(point.position, frame, order, worker), 0);
  }
  EXPECT_EQ(seen.size(), 2u);
}

TEST(RadiancePlacement, AddsToWhatThereIsAndLeavesItAsItWas) {
  Studio studio;
  const RadianceCache first = studio.place({.place = Place::view, .width = 40});
  const RadianceCache both = studio.place({.place = Place::surface}, {}, first);
  ASSERT_GT(both.records.size(), first.records.size());
  for (std::size_t i = 0; i < first.records.size(); ++i) {
    EXPECT_EQ(both.records[i].position, first.records[i].position);
    EXPECT_EQ(both.records[i].radius_m, first.records[i].radius_m);
    EXPECT_EQ(both.records[i].gradient_x, first.records[i].gradient_x);
  }
  const RadianceCache again = studio.place({.place = Place::view, .width = 40}, {}, both);
  EXPECT_EQ(again.records.size(), both.records.size()) << "nothing is left to cover";
}

TEST(RadiancePlacement, TheSameRecordsForAnyNumberOfThreads) {
  Studio studio;
  const std::vector<SurfaceSample> points = points_about(500);
  const auto all = [&](int threads) {
    set_threads(threads);
    std::vector<RadianceRecord> records;
    const auto take = [&](const RadianceCache& cache) {
      records.insert(records.end(), cache.records.begin(), cache.records.end());
    };
    take(studio.place({.place = Place::given}, {.points_given = true, .points = points}));
    take(studio.place({.place = Place::view, .width = 40}));
    take(studio.place({.place = Place::surface}));
    set_threads(0);
    return records;
  };
  const std::vector<RadianceRecord> one = all(1);
  for (const int threads : {2, 5}) {
    const std::vector<RadianceRecord> other = all(threads);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].position, other[i].position);
      EXPECT_EQ(one[i].radius_m, other[i].radius_m);
      EXPECT_EQ(one[i].order(), other[i].order());
    }
  }
}

/// Radii that neighbours and bounds settle are those of the radiance records too; where a bound raised one,
/// its gradients are reduced as those of irradiance are.
TEST(RadiancePlacement, FinalRadiiAndGradients) {
  Bounds box;
  box.include(Vec3(0)), box.include(Vec3(1));
  RadiusRules rules(box, {0.5f, 100});
  const auto made = [](float x, float radius_m) {
    auto full = std::make_shared<RadianceRecord>(
        test::radiance_record([](const Vec3&) { return Rgb(1); }, {x, 0, 0}, Frame{}, 3, radius_m));
    full->gradient_x.assign(27, 3.f), full->gradient_y.assign(27, -5.f);
    Made m{irradiance_of(*full)};
    m.radiance = full;
    return m;
  };
  rules.keep(made(50, 7).record);
  rules.add(made(0, 10), [](std::size_t, float) {});
  rules.add(made(1, 0.01f), [](std::size_t, float) {});
  std::vector<IrradianceRecord> records;
  std::vector<RadianceRecord> radiance;
  rules.finish(records, &radiance);
  ASSERT_EQ(records.size(), 2u);
  ASSERT_EQ(radiance.size(), 2u) << "the one that was there is not new";
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(radiance[i].radius_m, records[i].radius_m);
  EXPECT_FLOAT_EQ(radiance[0].radius_m, 1.01f);
  EXPECT_EQ(radiance[0].gradient_x, std::vector<float>(27, 3.f));
  EXPECT_EQ(radiance[1].radius_m, 0.5f);
  EXPECT_FLOAT_EQ(radiance[1].gradient_x[7], 3 * 0.01f / 0.5f);
  EXPECT_FLOAT_EQ(radiance[1].gradient_y[26], -5 * 0.01f / 0.5f);
  const IrradianceRecord e = irradiance_of(radiance[1]);
  EXPECT_NEAR(records[1].translation_gradient[0].x, e.translation_gradient[0].x, 1e-6f);
}

/// A footprint has looked in bounds: neighbours do not clamp it, and a limit shortens all its axes alike.
TEST(RadiancePlacement, FootprintsKeepTheirShapeAndGradients) {
  Bounds box;
  box.include(Vec3(0)), box.include(Vec3(1));
  RadiusRules rules(box, {0.1f, 100});
  for (const float x : {0.f, 1.f}) {
    auto full = std::make_shared<RadianceRecord>(test::radiance_record(
        [](const Vec3&) { return Rgb(1); }, {x, 0, 0}, Frame{}, 3, x == 0 ? 10.f : 0.2f));
    full->gradient_x.assign(27, 3.f);
    full->footprint_m = {2, 1.5f, 1, 1, 1, 1, 1, 1.5f};
    Made made{irradiance_of(*full)};
    made.radiance = full;
    rules.add(made, [](std::size_t, float) { ADD_FAILURE() << "clamped"; });
  }
  rules.limit(0, 4);
  std::vector<IrradianceRecord> records;
  std::vector<RadianceRecord> radiance;
  rules.finish(records, &radiance);
  ASSERT_EQ(radiance.size(), 2u);
  EXPECT_EQ(radiance[0].radius_m, 4);
  EXPECT_EQ(radiance[1].radius_m, 0.2f);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(radiance[i].radius_m, records[i].radius_m);
    EXPECT_EQ(radiance[i].gradient_x, std::vector<float>(27, 3.f));
    EXPECT_EQ(radiance[i].footprint_m->at(0), 2);
  }
  const IrradianceRecord limited = irradiance_of(radiance[0]);
  EXPECT_NEAR(record_error(limited, {1, 0, 0}, {0, 0, 1}), 0.25, 1e-6) << "4 m along the longest axis";
  EXPECT_NEAR(record_error(limited, {0, 1, 0}, {0, 0, 1}), 0.5, 1e-6)
      << "2 m along an axis of half its length";
}

TEST(RadiancePlacement, OrdersThatNobodyReadsAreRefused) {
  Studio studio;
  const std::vector<int> orders = studio.tables.orders();
  EXPECT_NO_THROW(require_same_orders(test::random_radiance(orders), studio.tables, "a.radiance"));
  EXPECT_NO_THROW(require_same_orders({}, studio.tables, "a.radiance"));
  try {
    require_same_orders(test::random_radiance({orders[0], orders[0] + 1}), studio.tables, "a.radiance");
    FAIL() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::mismatch);
    EXPECT_NE(std::string(e.what()).find(text("order ", orders[0] + 1)), std::string::npos) << e.what();
  }
  EXPECT_THROW(require_same_orders(test::random_radiance({orders[0]}), {}, "a.radiance"), Error);
}

}  // namespace
}  // namespace phos
