// Where records are placed: in order, at every point, where a camera looks, on every surface.
#include "place/placement.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "place/growth.h"
#include "place/modes.h"
#include "place/placement_options.h"
#include "place/view_candidates.h"
#include "record/tree.h"
#include "scene/material/bsdf.h"
#include "scene/picture.h"
#include "support/estimators.h"
#include "support/scenes.h"

namespace phos {
namespace {

/// Radii that leave few records.
RecordOptions resolved_for(const Scene& scene) {
  RecordOptions options;
  options.min_radius_m = static_cast<double>(scene.bounds.diagonal_m()) / 20;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

/// A scene, and caches placed in it.
struct Studio {
  explicit Studio(Scene s)
      : scene(std::move(s)), rays(scene), estimator(rays), options(resolved_for(scene)) {}

  IrradianceCache place(PlacementOptions placement, const PlacementSource& source = {}) {
    IrradianceCache cache;
    cache.accuracy = options.accuracy;
    resolve(placement, scene, source, options.accuracy);
    counters = {};
    report = extend_cache(cache, estimator, rays, options, placement, source, counters);
    return cache;
  }

  Scene scene;
  RayScene rays;
  test::DistanceEstimator estimator;
  RecordOptions options;
  PlacementReport report;
  Counters counters;
};

bool same_bytes(const IrradianceCache& a, const IrradianceCache& b) {
  return a.records.size() == b.records.size() &&
         std::memcmp(a.records.data(), b.records.data(), a.records.size() * sizeof(IrradianceRecord)) == 0;
}

std::vector<SurfaceSample> points_on_floor(std::size_t n) {
  std::vector<SurfaceSample> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(3, Stage::test, i);
    points.push_back({{2 * random.uniform(), 0, 1.5f * random.uniform()}, {0, 1, 0}});
  }
  return points;
}

TEST(Placement, EveryPointHasItsRecordInOrder) {
  Studio studio(test::furnace(0.5f).scene);
  std::vector<SurfaceSample> points = points_on_floor(300);
  points.push_back(points.front());
  const IrradianceCache cache =
      studio.place({.place = Place::every}, {.points_given = true, .points = points});
  ASSERT_EQ(cache.records.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(cache.records[i].position, points[i].position);
  EXPECT_EQ(studio.report.kept, points.size());
  EXPECT_EQ(studio.counters["distances measured"], points.size());

  const IrradianceCache fewer =
      studio.place({.place = Place::given}, {.points_given = true, .points = points});
  EXPECT_LT(fewer.records.size(), points.size());
  EXPECT_EQ(studio.report.uncovered, 0u);
}

TEST(Placement, TheSameRecordsForAnyNumberOfThreads) {
  Studio studio(test::cornell());
  const std::vector<SurfaceSample> points = points_on_floor(500);
  const PlacementSource at{.points_given = true, .points = points};
  const auto all = [&] {
    std::vector<IrradianceCache> caches;
    caches.push_back(studio.place({.place = Place::every}, at));
    caches.push_back(studio.place({.place = Place::given}, at));
    caches.push_back(studio.place({.place = Place::view, .width = 60}));
    caches.push_back(studio.place({.place = Place::surface}));
    return caches;
  };
  set_threads(1);
  const std::vector<IrradianceCache> one = all();
  set_threads(2);
  const std::vector<IrradianceCache> two = all();
  set_threads(0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_GT(one[i].records.size(), 10u);
    EXPECT_TRUE(same_bytes(one[i], two[i])) << i;
  }
}

TEST(Placement, AddsToWhatThereIsAndLeavesItAsItWas) {
  Studio studio(test::cornell());
  IrradianceCache cache = studio.place({.place = Place::view, .width = 40});
  const IrradianceCache before = cache;
  PlacementOptions surface{.place = Place::surface};
  Counters counters;
  extend_cache(cache, studio.estimator, studio.rays, studio.options, surface, {}, counters);
  ASSERT_GT(cache.records.size(), before.records.size());
  cache.records.resize(before.records.size());
  EXPECT_TRUE(same_bytes(cache, before));
}

// --- view

TEST(ViewPlacement, EveryPixelIsCovered) {
  Studio studio(test::cornell());
  const IrradianceCache cache = studio.place({.place = Place::view, .width = 120, .height = 100});
  EXPECT_EQ(studio.report.uncovered, 0u);
  RecordTree tree(studio.scene.bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  std::size_t seen = 0, open = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 120; ++x) {
      for (int s = 0; s < 4; ++s) {
        const Vec2 st = (Vec2(x, y) + r2_point(s, Vec2(0.5f))) / Vec2(120, 100);
        const Camera::Ray ray = studio.scene.camera[0].ray(st, 1.2f);
        SurfacePoint p;
        if (!trace(studio.rays, {ray.origin, ray.direction}, p) || !Bsdf(studio.scene, p).has_diffuse())
          continue;
        ++seen;
        open += !tree.covered(p.position, p.smooth_normal);
      }
    }
  }
  EXPECT_EQ(studio.report.candidates, seen);
  EXPECT_EQ(open, 0u);
}

TEST(ViewPlacement, GoesFromCoarseToFine) {
  const Scene scene = test::furnace(0.5f).scene;
  const RayScene rays(scene);
  const Candidates candidates = view_candidates(rays, {scene.camera[0], 64, 64});
  ASSERT_EQ(candidates.count, 4u * 64 * 64);
  // The first 16 are of a regular grid, one in each sixteenth of the picture.
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 0; i < 16; ++i) {
    std::vector<RecordSite> sites;
    candidates.sites(i, sites);
    ASSERT_EQ(sites.size(), 1u);
    const Vec4 clip = scene.camera[0].view_projection(1, 0.01f, 10.f) * Vec4(sites[0].position, 1);
    cells.insert({static_cast<int>((clip.x / clip.w + 1) * 2), static_cast<int>((1 - clip.y / clip.w) * 2)});
  }
  EXPECT_EQ(cells.size(), 16u);
}

/// Black surfaces show their illuminance; black lamps and mirrors have none to show.
TEST(ViewPlacement, TakesBlackSurfacesButNoLamps) {
  for (const bool lamp : {false, true}) {
    for (const Model model : {Model::lambert, Model::mirror}) {
      test::AnalyticScene s = test::point_light_over_plane(2, 1000, 0);
      s.scene.material[0].model = model;
      if (lamp) s.scene.material[0].emission = Rgb(1);
      const RayScene rays(s.scene);
      const Candidates candidates = view_candidates(rays, {s.scene.camera[0], 16, 16});
      std::vector<RecordSite> sites;
      for (std::size_t i = 0; i < candidates.count; ++i) candidates.sites(i, sites);
      EXPECT_EQ(!sites.empty(), !lamp && model == Model::lambert) << lamp;
    }
  }
}

/// Any block of 4^k places can be walked over, each next to the one before.
TEST(ViewPlacement, CanBeWalkedOver) {
  const Scene scene = test::furnace(0.5f).scene;
  const RayScene rays(scene);
  const Candidates candidates = view_candidates(rays, {scene.camera[0], 64, 64});
  ASSERT_TRUE(candidates.coarse_to_fine);
  for (const int k : {2, 4, 6}) {
    const std::size_t count = std::size_t{1} << 2 * k, first = 3 * count;
    std::set<std::size_t> visited;
    double way = 0;
    Vec2 last(0);
    for (std::size_t j = 0; j < count; ++j) {
      visited.insert(grid_order(j, k));
      std::vector<RecordSite> sites;
      candidates.sites(first + grid_order(j, k), sites);
      ASSERT_EQ(sites.size(), 1u);
      const Vec4 clip = scene.camera[0].view_projection(1, 0.01f, 10.f) * Vec4(sites[0].position, 1);
      const Vec2 seen = 0.5f * Vec2(clip) / clip.w;
      if (j > 0) way += static_cast<double>(glm::length(seen - last));
      last = seen;
    }
    EXPECT_EQ(visited.size(), count);
    // A Z-curve: 1.7 sides of a cell of the grid, on the mean.
    EXPECT_LT(way / static_cast<double>(count), 2.2 / (1 << k));
  }
}

/// A camera that looks at a mirror, which shows the wall behind the camera.
Scene mirror_room() {
  Scene scene;
  test::begin_instance(scene, "wall", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-5, -5, 4}, {0, 10, 0}, {10, 0, 0});  // behind the camera, front towards -z
  Material mirror;
  mirror.name = "mirror", mirror.model = Model::mirror, mirror.ks = Rgb(0.9f);
  scene.material.push_back(mirror);
  test::begin_instance(scene, "mirror", 1);
  test::add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
  test::add_point_light(scene, {0, 3, 2}, 100);
  scene.camera.push_back(test::look_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0.5f));
  finalize(scene);
  return scene;
}

TEST(ViewPlacement, FollowsMirrors) {
  Studio studio(mirror_room());
  const IrradianceCache cache = studio.place({.place = Place::view, .width = 32, .height = 32});
  ASSERT_FALSE(cache.records.empty());
  for (const IrradianceRecord& r : cache.records) {
    EXPECT_EQ(r.position.z, 4.f);
    // Seen from 1 m before the mirror the wall is 5 m away.
    EXPECT_LE(std::fabs(r.position.x), 5 * std::tan(0.25f) * 1.001f);
  }
}

TEST(ViewPlacement, FootprintOfAPixel) {
  const Camera eye = test::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.9f);
  const View view{eye, 400, 200};
  // At the centre, straight on: the height of the picture at 2 m over its pixels.
  const double side = 2 * 2 * std::tan(0.45) / 200;
  EXPECT_NEAR(pixel_side_m(view, {0.5f, 0.5f}, 2, 1), side, 1e-4 * side);
  // A plane turned by 60 degrees: twice the area.
  EXPECT_NEAR(pixel_side_m(view, {0.5f, 0.5f}, 2, 0.5f), side * std::sqrt(2.), 1e-4 * side);
  // Off the axis on a plane across it, all pixels cover the same.
  const Vec2 st(0.9f, 0.8f);
  const Camera::Ray ray = eye.ray(st, 2);
  EXPECT_NEAR(pixel_side_m(view, st, 2 / -ray.direction.z, -ray.direction.z), side, 1e-3 * side);
  EXPECT_LT(pixel_side_m(view, {0.5f, 0.5f}, 2, 0), 5 * side);

  Camera flat = eye;
  flat.perspective = false, flat.ymag_m = 3;
  EXPECT_NEAR(pixel_side_m({flat, 400, 200}, st, 17, 1), 6. / 200, 1e-6);
}

TEST(ViewPlacement, PixelsBoundTheRadius) {
  Studio studio(test::cornell());
  studio.options.min_radius_m = 1e-6, studio.options.max_radius_m = 1e6;
  const std::int64_t pixels = 50;
  const auto limits = [&](double least, double most) {
    return studio.place({.place = Place::view,
                         .width = pixels,
                         .height = pixels,
                         .min_radius_pixels = least,
                         .max_radius_pixels = most});
  };
  const View view{studio.scene.camera[0], pixels, pixels};
  const auto pixels_of = [&](const IrradianceRecord& r) {
    const Vec3 eye(view.camera.to_world[3]), away = r.position - eye;
    const Vec4 clip = view.camera.view_projection(1, 0.01f, 10.f) * Vec4(r.position, 1);
    const Vec2 st(0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w);
    const float distance = glm::length(away);
    return static_cast<double>(r.radius_m /
                               pixel_side_m(view, st, distance, glm::dot(away, r.normal) / distance));
  };
  double least = 1e9, most = 0;
  for (const IrradianceRecord& r : limits(0, 0).records)
    least = std::min(least, pixels_of(r)), most = std::max(most, pixels_of(r));
  EXPECT_LT(least, 2);
  EXPECT_GT(most, 10);
  for (const IrradianceRecord& r : limits(3, 8).records) {
    EXPECT_GE(pixels_of(r), 3 * 0.98);  // the left wall's smooth normal is not quite its own
    EXPECT_LE(pixels_of(r), 8 * 1.02);
  }
  EXPECT_GT(studio.report.clamped_to_least, 0u);
}

TEST(ViewPlacement, NoRecordServesLessThanAPixel) {
  const Scene scene = test::cornell();
  const auto least = [&](PlacementOptions placement, double accuracy) {
    placement.place = Place::view;
    resolve(placement, scene, {}, accuracy);
    return *placement.min_radius_pixels;
  };
  EXPECT_EQ(least({}, 0.2), 5);
  EXPECT_EQ(least({}, 1), 1);
  EXPECT_EQ(least({.min_radius_pixels = 0}, 0.2), 0);
  EXPECT_EQ(least({.min_radius_pixels = 2}, 0.2), 2);
  EXPECT_EQ(least({.max_radius_pixels = 3}, 0.2), 3);
}

TEST(ViewPlacement, TheSizeFollowsTheCamera) {
  Camera camera;
  camera.aspect = 2;
  std::int64_t width = 0, height = 0;
  resolve_size(camera, 1000, width, height);
  EXPECT_EQ(width, 1000);
  EXPECT_EQ(height, 500);
  width = 0, height = 30;
  resolve_size(camera, 1000, width, height);
  EXPECT_EQ(width, 60);
  width = 65536, height = 65536;
  EXPECT_THROW(resolve_size(camera, 1000, width, height), Error);
}

// --- radii

TEST(RadiusRules, NeighboursBeforeBounds) {
  // Two records 1 m apart with radii 10 m and 0.01 m, the least radius 0.5 m: the small one is raised to it,
  // but clamps the other by what it was.
  Bounds box;
  box.include(Vec3(0)), box.include(Vec3(1));
  RadiusRules rules(box, {0.5f, 100});
  IrradianceRecord wide, narrow;
  wide.radius_m = 10, narrow.radius_m = 0.01f, narrow.position = {1, 0, 0};
  narrow.translation_gradient[0] = {3, 0, 0};
  EXPECT_EQ(rules.add({wide}, [](std::size_t, float) { FAIL(); }), 10.f);
  std::size_t shrunk = 9;
  EXPECT_EQ(rules.add({narrow},
                      [&](std::size_t i, float radius_m) {
                        shrunk = i;
                        EXPECT_FLOAT_EQ(radius_m, 1.01f);
                      }),
            0.5f);
  EXPECT_EQ(shrunk, 0u);
  std::vector<IrradianceRecord> records;
  rules.finish(records);
  EXPECT_FLOAT_EQ(records[0].radius_m, 1.01f);
  EXPECT_EQ(records[1].radius_m, 0.5f);
  EXPECT_FLOAT_EQ(records[1].translation_gradient[0].x, 3 * 0.01f / 0.5f);
  EXPECT_EQ(rules.clamped_to_neighbour(), 1u);
  EXPECT_EQ(rules.raised_to_least(), 1u);
}

TEST(RadiusRules, ASitesOwnBoundsHoldWithinThoseOfAll) {
  Bounds box;
  box.include(Vec3(0));
  RadiusRules rules(box, {0.1f, 10});
  const auto radius = [&](float made_m, float site_least_m, float site_most_m) {
    IrradianceRecord r;
    r.radius_m = made_m;
    r.position = Vec3(static_cast<float>(rules.size()) * 1000, 0, 0);
    return rules.add({r, 0, site_least_m, site_most_m}, [](std::size_t, float) {});
  };
  EXPECT_EQ(radius(1, 2, 3), 2.f);
  EXPECT_EQ(radius(5, 2, 3), 3.f);
  EXPECT_EQ(radius(1, 0.01f, 0.02f), 0.1f);
  EXPECT_EQ(radius(100, 50, kInfinity), 10.f);
  EXPECT_EQ(radius(1, 0, kInfinity), 1.f);
  const auto brighter = [&](float made_m) {
    Made made;
    made.record.radius_m = made_m;
    made.site_least_m = 2, made.site_most_m = 3, made.least_share = 0.5f;
    return within_bounds_m(made_m, made, {0.1f, 10});
  };
  EXPECT_EQ(brighter(0.7f), 1.f);
  EXPECT_EQ(brighter(1.5f), 1.5f);
  EXPECT_EQ(brighter(5), 3.f);
}

// --- what goes with what

TEST(Placement, TheFirstThatThereIs) {
  const Scene scene = test::cornell();
  const std::vector<SurfaceSample> points = points_on_floor(1);
  const PhotonMap photons = PhotonMap::build({}, {});
  const auto chosen = [&](const PlacementSource& source) {
    PlacementOptions placement;
    resolve(placement, scene, source, 0.2);
    return placement.place;
  };
  EXPECT_EQ(chosen({.photons = &photons, .points_given = true, .points = points}), Place::given);
  EXPECT_EQ(chosen({.photons = &photons}), Place::photons);
  EXPECT_EQ(chosen({}), Place::surface);
}

TEST(Placement, WhatDoesNotGoTogether) {
  const Scene scene = test::cornell();
  const PlacementSource none, points{.points_given = true};
  const auto refused = [&](PlacementOptions placement, const PlacementSource& source) {
    try {
      resolve(placement, scene, source, 0.2);
    } catch (const Error& e) {
      return e.where();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refused({.place = Place::photons}, none), "--place");
  EXPECT_EQ(refused({.place = Place::given}, none), "--place");
  EXPECT_EQ(refused({.place = Place::every}, none), "--place");
  EXPECT_EQ(refused({.place = Place::view}, points), "--at");
  EXPECT_EQ(refused({.place = Place::surface}, points), "--at");
  EXPECT_EQ(refused({.place = Place::surface, .part = "1/2"}, none), "--part");
  EXPECT_EQ(refused({.place = Place::view, .error = 0.01}, none), "--placement-error");
  EXPECT_EQ(refused({.place = Place::given, .part = "1/2"}, points), "--part");
  EXPECT_EQ(refused({.place = Place::surface, .min_radius_pixels = 1}, none), "--min-radius-pixels");
  EXPECT_EQ(refused({.place = Place::surface, .max_radius_pixels = 1}, none), "--max-radius-pixels");
  EXPECT_EQ(refused({.place = Place::view, .min_radius_pixels = 3, .max_radius_pixels = 2}, none),
            "--min-radius-pixels");
  EXPECT_NE(refused({.place = Place::view, .camera = "no such"}, none), "accepted");
  for (const char* part : {"0/2", "3/2", "1", "1/", "/2", "1/2/3", "-1/2", " 1/2", "1/x", "1/1048577"})
    EXPECT_EQ(refused({.place = Place::every, .part = part}, points), "--part") << part;
  EXPECT_EQ(refused({.place = Place::every, .part = "2/3"}, points), "accepted");
}

}  // namespace
}  // namespace phos
