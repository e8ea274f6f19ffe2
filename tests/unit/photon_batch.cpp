// Paths that advance side by side leave the photons of paths one after the other, whatever share of them is
// aimed at mirrors.
#include "photon/path_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "support/mirrors.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr std::uint64_t kPaths = 3000;

/// The rows of a column in the order of turns.
template <class Column>
Column in_order(const Column& column, const std::vector<std::uint32_t>& turn) {
  std::vector<std::size_t> row(column.size());
  std::iota(row.begin(), row.end(), std::size_t{0});
  if (!turn.empty())
    std::stable_sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) { return turn[a] < turn[b]; });
  Column sorted;
  for (const std::size_t i : row) sorted.push_back(column[i]);
  return sorted;
}

void expect_equal(const PathSums& a, const PathSums& b) {
  EXPECT_EQ(a.emitted.units, b.emitted.units);
  EXPECT_EQ(a.stored.units, b.stored.units);
  EXPECT_EQ(a.escaped.units, b.escaped.units);
  EXPECT_EQ(a.absorbed.units, b.absorbed.units);
  EXPECT_EQ(a.escaped_paths, b.escaped_paths);
}

void expect_same_paths(const Scene& scene, std::uint64_t aimed_paths) {
  const RayScene rays(scene);
  const Emitter emitter(scene, 0.1, kPaths, 1);
  std::optional<CausticAim> aim;
  if (aimed_paths > 0) aim.emplace(rays);
  const PathTracer tracer(rays, emitter, aim ? &*aim : nullptr, kPaths, aimed_paths, 1, true);
  ASSERT_TRUE(tracer.steps_alike());
  PathPart one_by_one, together;
  for (std::uint64_t path = 100; path < kPaths; ++path) tracer.trace(path, one_by_one);
  trace_paths(tracer, 100, kPaths, together);
  ASSERT_EQ(together.turn.size(), together.photons.size()) << "the scene is too small for batches";
  EXPECT_GT(one_by_one.photons.size(), 1000u);
  for_columns(
      [&](const auto& expected, const auto& column) { EXPECT_EQ(in_order(column, together.turn), expected); },
      one_by_one.photons, together.photons);
  const Flights &expected = one_by_one.photons.flights, &flights = together.photons.flights;
  EXPECT_EQ(expected.size() > 0, aimed_paths > 0);
  EXPECT_EQ(in_order(flights.from, together.flight_turn), expected.from);
  EXPECT_EQ(in_order(flights.flux, together.flight_turn), expected.flux);
  EXPECT_EQ(in_order(flights.direction, together.flight_turn), expected.direction);
  EXPECT_EQ(in_order(flights.length, together.flight_turn), expected.length);
  expect_equal(together.sums, one_by_one.sums);
  EXPECT_EQ(together.aimed.stored.units, one_by_one.aimed.stored.units);
  EXPECT_EQ(together.rays.size(), one_by_one.rays.size());
}

TEST(PathBatch, OfDiffuseSurfaces) { expect_same_paths(integrating_sphere(0.7f, 5000).scene, 0); }

TEST(PathBatch, WithPathsAimedAtMirrors) {
  Scene scene = integrating_sphere(0.7f, 5000).scene;
  begin_instance(scene, "mirror", add_mirror(scene, "mirror", 0.9f));
  add_quad(scene, {-0.2f, -0.5f, -0.2f}, {0, 0, 0.4f}, {0.4f, 0.2f, 0});
  add_quad(scene, {-0.4f, 0.5f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f});
  finalize(scene);
  for (const std::uint64_t aimed : {std::uint64_t{500}, kPaths, 2 * kPaths + 1})
    expect_same_paths(scene, aimed);
}

}  // namespace
}  // namespace phos::test
