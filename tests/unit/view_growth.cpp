// The cache that grows with a walk: its records are those of placement, pages get all changes, and wishes
// that are none are refused.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <map>
#include <thread>

#include "place/placement.h"
#include "support/complaint.h"
#include "support/estimators.h"
#include "support/records.h"
#include "support/surface_points.h"
#include "view/growth/grower.h"
#include "view/growth/points_to_grow.h"
#include "view/limits.h"
#include "view/message/reader.h"
#include "view/message/writer.h"

namespace phos {
namespace {

constexpr float kBeside = 1e-4f;

std::vector<SurfaceSample> samples(const RayScene& rays, std::size_t n) {
  std::vector<SurfaceSample> points;
  for (const SurfacePoint& p : test::surface_points(rays, n, test::Spread::by_area))
    points.push_back({p.position, p.smooth_normal});
  return points;
}

/// The box with a cache of a few records.
struct Box {
  Box() : scene(test::cornell()), rays(scene), estimator(rays) {
    resolved.resolve(scene.bounds.diagonal_m() / 4);
    cache.accuracy = resolved.accuracy;
    Counters counters;
    place_every(cache, estimator, rays, resolved, samples(rays, 5), counters);
  }
  std::unique_ptr<GrownCache> grown() const {
    return std::make_unique<GrownCache>(cache, estimator, rays, resolved, kBeside);
  }

  Scene scene;
  RayScene rays;
  test::DistanceEstimator estimator;
  RecordOptions resolved;
  IrradianceCache cache;
};

void expect_same(const IrradianceRecord& a, const IrradianceRecord& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.radius_m, b.radius_m);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(a.translation_gradient[c], b.translation_gradient[c]);
}

TEST(GrownCache, ItsRecordsAreThoseOfPlacementAtTheirPlaces) {
  const Box box;
  const std::unique_ptr<GrownCache> grown = box.grown();
  const std::vector<SurfaceSample> points = samples(box.rays, 2000);
  std::size_t made = 0;
  for (std::size_t begin = 0; begin < points.size(); begin += 100)
    made += grown->grow(std::span(points).subspan(begin, 100), begin < 1000 ? 1 : 0.7);
  const std::vector<IrradianceRecord> records = grown->records();
  ASSERT_EQ(records.size(), made);
  EXPECT_EQ(grown->size(), made);
  EXPECT_GT(made, 50u);

  std::vector<SurfaceSample> places;
  for (const IrradianceRecord& r : records) places.push_back({r.position, r.normal});
  IrradianceCache placed = box.cache;
  Counters counters;
  place_every(placed, box.estimator, box.rays, box.resolved, places, counters);
  ASSERT_EQ(placed.records.size(), box.cache.records.size() + made);
  for (std::size_t i = 0; i < made; ++i)
    expect_same(records[i], placed.records[box.cache.records.size() + i]);
}

TEST(GrownCache, OnePointAtATimeGivesTheSame) {
  const Box box;
  const std::unique_ptr<GrownCache> together = box.grown(), alone = box.grown();
  const std::vector<SurfaceSample> points = samples(box.rays, 400);
  together->grow(points, 1);
  for (const SurfaceSample& p : points) alone->grow({&p, 1}, 1);
  const std::vector<IrradianceRecord> a = together->records(), b = alone->records();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i]);
}

TEST(GrownCache, CoversPointsAndThenMakesNoMore) {
  const Box box;
  const std::unique_ptr<GrownCache> grown = box.grown();
  const std::vector<SurfaceSample> points = points_to_grow(box.rays, samples(box.rays, 3000), kBeside);
  std::vector<std::size_t> sizes;
  for (const double share : {1.0, 0.7, 0.5}) {
    while (grown->grow(points, share) > 0) {
    }
    sizes.push_back(grown->size());
  }
  EXPECT_GT(sizes[0], 20u);
  EXPECT_GT(sizes[1], sizes[0]);
  EXPECT_GT(sizes[2], sizes[1]);
  IrradianceCache all = box.cache;
  const std::vector<IrradianceRecord> records = grown->records();
  all.records.insert(all.records.end(), records.begin(), records.end());
  RecordTree half(box.scene.bounds, box.cache.accuracy / 2);
  for (const IrradianceRecord& r : all.records) half.insert(r);
  for (const SurfaceSample& p : points) EXPECT_TRUE(half.covered(p.position, p.normal));
}

TEST(GrownCache, LeavesOutPointsInTheAir) {
  const Box box;
  const std::unique_ptr<GrownCache> grown = box.grown();
  const Vec3 middle = box.scene.bounds.centre();
  EXPECT_EQ(grown->grow(std::vector<SurfaceSample>{{middle, Vec3(0, 1, 0)}}, 1), 0u);
}

TEST(GrownCache, PutsPointsOnTheirSurfaces) {
  const Box box;
  std::vector<SurfaceSample> points = samples(box.rays, 50);
  for (SurfaceSample& p : points) p.position += 0.5f * kBeside * p.normal;
  for (const SurfaceSample& p : points_to_grow(box.rays, points, kBeside)) {
    Hit hit;
    ASSERT_TRUE(box.rays.intersect({p.position + 0.01f * p.normal, -p.normal, 0, 1}, hit));
    EXPECT_NEAR(hit.distance_m, 0.01f, 1e-6f);
  }
}

TEST(GrowthLog, EveryChangeHasANumber) {
  GrowthLog log;
  std::vector<IrradianceRecord> records(5);
  for (IrradianceRecord& r : records) r.radius_m = 1;
  log.update({records.begin(), records.begin() + 3});
  EXPECT_EQ(log.since(0, 10).rows, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(log.since(0, 2).rows, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(log.since(0, 2).more);
  EXPECT_EQ(log.since(2, 2).rows, (std::vector<std::uint32_t>{2}));
  EXPECT_FALSE(log.since(2, 2).more);
  const std::uint32_t before = log.serial();
  records[1].radius_m = 0.5f;
  log.update(records);
  EXPECT_EQ(log.since(before, 10).rows, (std::vector<std::uint32_t>{1, 3, 4}));
  EXPECT_EQ(log.since(0, 10).rows, (std::vector<std::uint32_t>{0, 2, 1, 3, 4}));
  EXPECT_EQ(log.since(log.serial(), 10).rows.size(), 0u);
  EXPECT_EQ(log.since(log.serial() + 7, 10).rows.size(), 0u);
  records[2].translation_gradient[1] = Vec3(1, 0, 0);
  log.update(records);
  EXPECT_EQ(log.since(log.serial() - 1, 10).rows, (std::vector<std::uint32_t>{2}));
}

/// A wish as a page writes it.
std::string a_wish(const std::vector<SurfaceSample>& points, std::uint32_t since = 0, float share = 1,
                   bool save = false) {
  MessageWriter message(MessageKind::wish);
  message.add("wish", "since", std::vector<std::uint32_t>{since});
  message.add("wish", "share", std::vector<float>{share});
  message.add("wish", "save", std::vector<std::uint32_t>{save ? 1u : 0u});
  std::vector<Vec3> position, normal;
  for (const SurfaceSample& p : points) position.push_back(p.position), normal.push_back(p.normal);
  message.add("point", "position", position);
  message.add("point", "normal", normal);
  return message.message();
}

const Bounds kCube{Vec3(0), Vec3(1)};

TEST(GrowthWish, IsRead) {
  const GrowthWish wish =
      read_growth_wish(a_wish({{Vec3(0.5f), {0, 2, 0}}, {Vec3(1), {0, 0, -1}}}, 7, 0.5f, true), kCube, 2);
  EXPECT_EQ(wish.since, 7u);
  EXPECT_EQ(wish.share, 0.5);
  EXPECT_TRUE(wish.save);
  ASSERT_EQ(wish.points.size(), 2u);
  EXPECT_EQ(wish.points[0].position, Vec3(0.5f));
  EXPECT_EQ(wish.points[0].normal, Vec3(0, 1, 0));
}

TEST(GrowthWish, WhatIsNoneIsRefused) {
  const SurfaceSample good{Vec3(0.5f), {0, 1, 0}};
  const auto says = [](const std::string& message, const char* words) {
    const std::string said = test::complaint_of([&] { read_growth_wish(message, kCube, 3); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  constexpr float kInf = std::numeric_limits<float>::infinity(),
                  kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {kInf, -kInf, kNan}) {
    says(a_wish({good, {{0.5f, bad, 0.5f}, {0, 1, 0}}}), "not finite");
    says(a_wish({good, {Vec3(0.5f), {0, bad, 0}}}), "not finite");
    says(a_wish({good}, 0, bad), "not finite");
  }
  for (const float far : {-0.02f, 1.02f, 1e30f})
    says(a_wish({good, {{0.5f, far, 0.5f}, {0, 1, 0}}}), "far off");
  says(a_wish({good, {Vec3(0.5f), Vec3(0)}}), "without a direction");
  for (const float share : {0.f, 0.49f, 1.01f, -1.f}) says(a_wish({good}, 0, share), "share");
  says(a_wish({good, good, good, good}), "4 points");
  says(MessageWriter(MessageKind::wish).message(), "0 wishes");
  says(MessageWriter(MessageKind::question).message(), "kind");
  EXPECT_EQ(test::complaint_of([&] { read_growth_wish(a_wish({good}), Bounds(), 3); }).find("message"), 0u);
}

TEST(GrowthWish, OfTheGreatestSizeFitsIntoAMessage) {
  const std::vector<SurfaceSample> most(kMostPointsAsked.as<std::size_t>(), {Vec3(0.5f), {0, 1, 0}});
  EXPECT_LE(a_wish(most).size(), kMostQuestionBytes.as<std::size_t>());
}

/// A page: it has the records that the answers gave it.
struct Page {
  /// Asks until nothing waits.
  void ask(Grower& grower, const std::vector<SurfaceSample>& points, float share = 1, bool save = false) {
    take(grower.answer(a_wish(points, since, share, save)));
    for (int tries = 0; tries < 2000 && (waiting > 0 || more || (save && saves == 0)); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      take(grower.answer(a_wish({}, since)));
    }
    EXPECT_EQ(waiting, 0u);
  }
  void take(const std::string& bytes) {
    const MessageReader answer(bytes, MessageKind::grown);
    const auto of = [&](const char* name) { return answer.numbers("growth", name)[0]; };
    since = of("serial"), more = of("more") != 0, state = of("state"), waiting = of("waiting");
    count = of("records"), saves = of("saves"), save_failed = of("save_failed");
    const std::vector<std::uint32_t> row = answer.numbers("record", "row");
    const std::vector<float> inverse = answer.floats("record", "inverse_radius");
    for (std::size_t i = 0; i < row.size(); ++i) inverse_radius[row[i]] = inverse[i];
  }
  std::uint32_t since = 0, state = 0, waiting = 0, count = 0, saves = 0, save_failed = 0;
  bool more = false;
  std::map<std::uint32_t, float> inverse_radius;  // by row
};

GrowerParts parts_of(const Box& box) {
  GrowerParts parts;
  parts.scene = box.scene.bounds;
  parts.most_points = 100;
  parts.make = [&box] { return std::shared_ptr<GrownCache>(box.grown()); };
  return parts;
}

TEST(Grower, PagesShareOneCacheAndHaveAllChanges) {
  const Box box;
  GrowerParts parts = parts_of(box);
  parts.reach = 2;
  Grower grower(std::move(parts));
  Page first, second;
  const std::vector<SurfaceSample> points = samples(box.rays, 2000);
  for (std::size_t begin = 0; begin < points.size(); begin += 100)
    (begin % 200 == 0 ? first : second)
        .ask(grower, {points.begin() + static_cast<std::ptrdiff_t>(begin),
                      points.begin() + static_cast<std::ptrdiff_t>(begin + 100)});
  Page late;
  for (Page* page : {&first, &second, &late}) page->ask(grower, {});
  const std::vector<IrradianceRecord> records = grower.grown().records;
  ASSERT_GT(records.size(), 50u);
  for (const Page* page : {&first, &second, &late}) {
    ASSERT_EQ(page->inverse_radius.size(), records.size());
    EXPECT_EQ(page->count, records.size());
    EXPECT_EQ(page->state, static_cast<std::uint32_t>(GrowthState::growing));
    for (const auto& [row, inverse] : page->inverse_radius)
      EXPECT_FLOAT_EQ(inverse, 0.5f / records[row].radius_m);
  }
  EXPECT_GT(grower.grown().counters["distances measured"], records.size() - 1);

  const std::unique_ptr<GrownCache> alone = box.grown();
  for (std::size_t begin = 0; begin < points.size(); begin += 100)
    alone->grow(read_growth_wish(a_wish({points.begin() + static_cast<std::ptrdiff_t>(begin),
                                         points.begin() + static_cast<std::ptrdiff_t>(begin + 100)}),
                                 box.scene.bounds, 100)
                    .points,
                1);
  const std::vector<IrradianceRecord> expected = alone->records();
  ASSERT_EQ(records.size(), expected.size());
  for (std::size_t i = 0; i < records.size(); ++i) expect_same(records[i], expected[i]);
}

TEST(Grower, BadWishesChangeNothing) {
  const Box box;
  Grower grower(parts_of(box));
  const std::vector<SurfaceSample> many(101, {box.scene.bounds.centre(), {0, 1, 0}});
  EXPECT_NE(test::complaint_of([&] { grower.answer(a_wish(many)); }), "");
  EXPECT_NE(test::complaint_of([&] { grower.answer("nonsense"); }), "");
  Page page;
  page.ask(grower, samples(box.rays, 100));
  EXPECT_GT(page.count, 0u);
}

TEST(Grower, SavesWhatHasGrownOnce) {
  const Box box;
  std::atomic<int> saves{0};
  std::vector<std::size_t> sizes;
  GrowerParts parts = parts_of(box);
  parts.save = [&](const Grown& grown) { sizes.push_back(grown.records.size()), ++saves; };
  Grower grower(std::move(parts));
  Page page;
  page.ask(grower, samples(box.rays, 100));
  page.ask(grower, {}, 1, true);
  EXPECT_EQ(page.saves, 1u);
  for (int i = 0; i < 3; ++i) page.ask(grower, {}, 1, true);
  grower.stop();
  ASSERT_EQ(saves.load(), 1);
  EXPECT_EQ(sizes[0], grower.grown().records.size());
}

TEST(Grower, AFailureToSaveIsToldAndGrowthGoesOn) {
  const Box box;
  std::atomic<int> warned{0};
  GrowerParts parts = parts_of(box);
  parts.save = [](const Grown&) { throw Error(ExitCode::bad_input, "x", "disk is full"); };
  parts.warn = [&](const std::string& line) { warned += line == "x: disk is full"; };
  Grower grower(std::move(parts));
  Page page;
  page.take(grower.answer(a_wish({}, 0, 1, true)));
  for (int tries = 0; tries < 2000 && page.save_failed == 0; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    page.ask(grower, {});
  }
  EXPECT_EQ(page.save_failed, 1u);
  EXPECT_EQ(warned.load(), 1);
  page.ask(grower, samples(box.rays, 100));
  EXPECT_GT(page.count, 0u);
}

TEST(Grower, AnErrorEndsTheGrowthAlone) {
  const Box box;
  std::atomic<int> warned{0};
  GrowerParts parts = parts_of(box);
  parts.make = []() -> std::shared_ptr<GrownCache> { throw Error(ExitCode::usage, "", "no photons"); };
  parts.warn = [&](const std::string& line) { warned += line == "no photons"; };
  Grower grower(std::move(parts));
  Page page;
  for (int tries = 0; tries < 2000 && page.state != static_cast<std::uint32_t>(GrowthState::ended); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    page.take(grower.answer(a_wish({})));
  }
  page.ask(grower, samples(box.rays, 100));
  EXPECT_EQ(page.state, static_cast<std::uint32_t>(GrowthState::ended));
  EXPECT_EQ(page.count, 0u);
  EXPECT_EQ(warned.load(), 1);
}

/// A page that asks and never waits cannot fill the memory: the oldest points are dropped.
TEST(Grower, AFloodIsBounded) {
  const Box box;
  std::atomic<bool> go{false};
  GrowerParts parts = parts_of(box);
  parts.make = [&] {
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::shared_ptr<GrownCache>(box.grown());
  };
  Grower grower(std::move(parts));
  Page page;
  const std::vector<SurfaceSample> points = samples(box.rays, 100);
  for (int i = 0; i < 1000; ++i) page.take(grower.answer(a_wish(points)));
  EXPECT_EQ(page.waiting, 1600u);
  go = true;
  page.ask(grower, {});
  EXPECT_GT(page.count, 0u);
}

}  // namespace
}  // namespace phos
