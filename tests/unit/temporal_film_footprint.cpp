// Footprints of a film move, turn and change with its records.
#include <gtest/gtest.h>

#include "support/film_records.h"

namespace phos::test {
namespace {

/// A record with a footprint at the anchor of a triangle.
FilmRecord shaped_at(const Scene& scene, std::int32_t birth, std::int32_t end, std::uint64_t item,
                     const Vec3& normal) {
  FilmRecord r;
  r.record = random_cache(1).records[0];
  r.life = on_triangle(birth, end, scene);
  r.record.position = pose_of(scene, r.life.anchor)->position, r.record.normal = normal;
  r.record.irradiance = Rgb(50, 60, 70);
  r.record.footprint =
      std::make_shared<AdaptiveFootprint>(make_frame(normal).x, normal, random_axes(item, 0.3f, 10));
  r.record.radius_m = r.record.footprint->longest_m() / 0.25f;
  return r;
}

/// The directions, in the world, of the axes of a record's footprint.
std::vector<Vec3> axes_of(const IrradianceRecord& r) {
  std::vector<Vec3> axes;
  for (int k = 0; k < AdaptiveFootprint::kAxes; ++k) {
    const Vec2 u = AdaptiveFootprint::direction(k);
    axes.push_back(u.x * r.footprint->x() + u.y * r.footprint->y());
  }
  return axes;
}

TEST(FilmFootprint, MovesAndTurnsWithItsSurface) {
  const Scene flat = one_triangle(2), moved = one_triangle(2, kTurn, kMove);
  const FilmRecord r = shaped_at(flat, 10, 15, 1, {0, 0, 1});
  const Film film = film_of(TemporalGradients::none, {r});
  const IrradianceRecord there = cache_at(film, 10, flat).records.at(0),
                         now = cache_at(film, 11, moved).records.at(0);
  EXPECT_EQ(there.footprint->x(), r.record.footprint->x()) << "nothing is rounded where nothing turns";
  const Vec3 n = glm::normalize(r.record.normal + Vec3(0.1f, 0, 0.2f));
  for (const Vec3& u : axes_of(there)) {
    const Vec3 p = 0.17f * u;
    EXPECT_NEAR(record_error(now, now.position + kTurn * p, kTurn * n),
                record_error(there, there.position + p, n), 1e-5f);
    expect_near(extrapolate(now, now.position + kTurn * p, kTurn * n),
                extrapolate(there, there.position + p, n), 1e-5f);
  }
}

/// docs/methods.md#f8: at the frame where one record ends and the next begins they say the same, where the
/// surface has turned in between and the axes of the next start elsewhere.
TEST(FilmFootprint, ChangesToThatOfTheNextRecord) {
  const Scene first = one_triangle(), second = one_triangle(1, kTurn, kMove);
  FilmRecord a = shaped_at(first, 10, 15, 1, {0, 0, 1});
  const FilmRecord b = shaped_at(second, 15, 20, 2, kTurn * Vec3(0, 0, 1));
  a.change = change_between(a, b);
  const IrradianceRecord last = changed(a, 15);
  EXPECT_NEAR(last.radius_m / last.footprint->longest_m(), 4, 1e-4f) << "zones as large as they were fitted";
  a.life.end = 16;  // one frame more, so that cache_at() shows the end
  const IrradianceRecord end =
      cache_at(film_of(TemporalGradients::interpolated, {a}), 15, second).records.at(0);
  const IrradianceRecord birth =
      cache_at(film_of(TemporalGradients::interpolated, {b}), 15, second).records.at(0);
  const Vec3 n = birth.normal;
  for (const Vec3& u : axes_of(end))
    for (const float step : {0.02f, 0.08f}) {
      const Vec3 p = birth.position + step * u;
      expect_near(extrapolate(end, p, n), extrapolate(birth, p, n), 1e-4f);
      const auto reach = [&](const IrradianceRecord& r) {
        return record_error(r, p, n) * r.radius_m / r.footprint->longest_m();
      };
      EXPECT_NEAR(reach(end), reach(birth), 1e-4f);
      const Vec3 tilted = glm::normalize(n + 0.2f * u);
      expect_near(extrapolate(end, birth.position, tilted), extrapolate(birth, birth.position, tilted),
                  1e-4f);
    }
}

/// The zone along each axis is the mean of the zones of both records halfway between them, and the light at a
/// share of an axis the mean of both lights.
TEST(FilmFootprint, IsHalfwayBetweenBothHalfway) {
  const Scene scene = one_triangle();
  FilmRecord a = shaped_at(scene, 10, 20, 1, {0, 0, 1});
  const FilmRecord b = shaped_at(scene, 20, 29, 2, {0, 0, 1});
  a.change = change_between(a, b);
  const IrradianceRecord half = changed(a, 15);
  const std::vector<Vec3> axes = axes_of(a.record);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const float of_a = a.record.footprint->axes()[k].length_m, of_b = b.record.footprint->axes()[k].length_m,
                length = 0.5f * (of_a + of_b);
    const auto error = [&](const IrradianceRecord& r, float step) {
      return record_error(r, r.position + step * axes[k], r.normal);
    };
    const auto light = [&](const IrradianceRecord& r, float step) {
      return extrapolate(r, r.position + step * axes[k], r.normal);
    };
    EXPECT_NEAR(error(a.record, of_a), 0.25f, 1e-5f);
    EXPECT_NEAR(error(half, length), 0.25f, 1e-5f);
    for (const float share : {0.3f, 1.f})
      expect_near(light(half, share * length),
                  0.5f * (light(a.record, share * of_a) + light(b.record, share * of_b)), 1e-5f);
  }
}

/// A foretold change is a change of light: the zone stays, and light beyond the foretold axes stands.
TEST(FilmFootprint, KeepsItsReachWhereLightIsForetold) {
  const Scene scene = one_triangle();
  FilmRecord a = shaped_at(scene, 10, 20, 1, {0, 0, 1});
  FilmRecord b = shaped_at(scene, 11, 29, 2, {0, 0, 1});
  a.change = change_between(a, b, Reach::stays);
  const IrradianceRecord next = changed(a, 11);
  EXPECT_EQ(next.radius_m, a.record.radius_m);
  for (std::size_t k = 0; k < AdaptiveFootprint::kAxes; ++k) {
    const float length = a.record.footprint->axes()[k].length_m;
    EXPECT_EQ(next.footprint->axes()[k].length_m, length);
    for (const float share : {0.5f, 1.f}) {
      const Vec3 p = a.record.position + share * length * axes_of(a.record)[k];
      expect_near(extrapolate(next, p, a.record.normal), extrapolate(b.record, p, a.record.normal), 1e-4f);
    }
  }
  // Far ahead nothing is negative, and nothing has no length.
  a.change.irradiance = Rgb(-1000);
  AdaptiveFootprint::Axes shrinking = *a.change.footprint;
  for (AdaptiveFootprint::Axis& axis : shrinking) axis.length_m = -1;
  a.change.footprint = std::make_shared<const AdaptiveFootprint::Axes>(shrinking);
  const IrradianceRecord last = changed(a, 19);
  EXPECT_GT(last.footprint->shortest_m(), 0);
  EXPECT_GT(last.radius_m, 0);
  EXPECT_GE(extrapolate(last, last.position + 0.1f * axes_of(last)[3], last.normal).y, 0);
}

}  // namespace
}  // namespace phos::test
