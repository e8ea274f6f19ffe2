// The change of light between two records of a place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/film_records.h"
#include "temporal/change.h"

namespace phos::test {
namespace {

/// docs/methods.md#f5: at the frame where one record ends and the next begins they say the same.
TEST(ChangeBetween, LeadsToTheNextRecord) {
  const Scene first = one_triangle(), second = one_triangle(1, kTurn, kMove);
  const IrradianceCache random = random_cache(2);
  FilmRecord a, b;
  a.record = random.records[0], b.record = random.records[1];
  a.life = on_triangle(10, 16, first), b.life = on_triangle(15, 20, second);
  b.record.normal = kTurn * a.record.normal;
  a.change = change_between(a, b);
  const IrradianceRecord end =
      cache_at(film_of(TemporalGradients::interpolated, {a}), 15, second).records.at(0);
  const IrradianceRecord birth =
      cache_at(film_of(TemporalGradients::interpolated, {b}), 15, second).records.at(0);
  expect_near(end.position, birth.position);
  expect_near(end.normal, birth.normal);
  expect_near(end.irradiance, birth.irradiance);
  for (int c = 0; c < 3; ++c) {
    expect_near(end.rotation_gradient[c], birth.rotation_gradient[c], 2e-6f);
    expect_near(end.translation_gradient[c], birth.translation_gradient[c], 2e-6f);
  }
  EXPECT_NEAR(end.radius_m, birth.radius_m, 1e-6f);
}

/// What rotation of the surface alone does to vectors is no change.
TEST(ChangeBetween, IsNothingWhereLightTurnsWithTheSurface) {
  FilmRecord a, b;
  a.record = b.record = random_cache(1).records[0];
  a.life = on_triangle(10, 15, one_triangle()), b.life = on_triangle(15, 20, one_triangle(1, kTurn, kMove));
  for (int c = 0; c < 3; ++c) {
    b.record.rotation_gradient[c] = kTurn * a.record.rotation_gradient[c];
    b.record.translation_gradient[c] = kTurn * a.record.translation_gradient[c];
  }
  const IrradianceChange change = change_between(a, b);
  EXPECT_EQ(change.irradiance, Rgb(0));
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(glm::length(change.rotation[c]), 1e-6f);
    EXPECT_LT(glm::length(change.translation[c]), 3e-6f);
  }
}

Rgb sky(const Vec3& w) { return Rgb(1 + 0.5f * w.x, 1 + 0.4f * w.y * w.z, 0.5f + 0.3f * w.x * w.y); }

float farthest(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  float most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

/// A record of light and of its change along two axes of the world, in any frame.
RadianceRecord radiance_at(const WorldLight& light, const WorldLight slope[2], const Vec3 axis[2],
                           const Frame& frame) {
  RadianceRecord r = radiance_record(light, Vec3(0), frame, 4);
  for (int k = 0; k < 2; ++k) {
    const std::vector<float> along = projected(slope[k], frame, 4);
    for (std::size_t i = 0; i < along.size(); ++i) {
      r.gradient_x[i] += glm::dot(frame.x, axis[k]) * along[i];
      r.gradient_y[i] += glm::dot(frame.y, axis[k]) * along[i];
    }
  }
  return r;
}

/// Light that goes with the surface is no change, whatever frames the records happened to have.
TEST(RadianceChange, IsNothingWhereLightTurnsWithTheSurface) {
  const Frame frame = make_frame(glm::normalize(Vec3(0.2f, -0.3f, 0.9f)));
  const WorldLight slope[2] = {[](const Vec3& w) { return Rgb(w.z * w.x, w.y, 0); },
                               [](const Vec3& w) { return Rgb(0, w.z, w.x * w.x); }};
  const Vec3 axis[2] = {frame.x, frame.y};
  const glm::quat back = glm::conjugate(kTurn);
  const WorldLight turned_slope[2] = {[&](const Vec3& w) { return slope[0](back * w); },
                                      [&](const Vec3& w) { return slope[1](back * w); }};
  const Vec3 turned_axis[2] = {kTurn * axis[0], kTurn * axis[1]};
  FilmRadianceRecord a, b;
  a.life = on_triangle(10, 15, one_triangle()), b.life = on_triangle(15, 20, one_triangle(1, kTurn, kMove));
  a.record = radiance_at(sky, slope, axis, frame);
  b.record = radiance_at([&](const Vec3& w) { return sky(back * w); }, turned_slope, turned_axis,
                         turned_about_z(make_frame(glm::normalize(kTurn * frame.z)), 1.1f));
  a.record.radius_m = 1, b.record.radius_m = 3;
  const RadianceChange change = change_between(a, b);
  const std::vector<float> none(a.record.light.size());
  EXPECT_LT(farthest(change.light, none), 2e-6f);
  EXPECT_LT(farthest(change.gradient_x, none), 2e-6f);
  EXPECT_LT(farthest(change.gradient_y, none), 2e-6f);
  EXPECT_FLOAT_EQ(change.radius_m, 0.4f);
}

TEST(RadianceChange, LeadsToTheNextRecord) {
  const Scene first = one_triangle(), second = one_triangle(1, kTurn, kMove);
  const Frame frame = make_frame(glm::normalize(Vec3(0.2f, -0.3f, 0.9f)));
  FilmRadianceRecord a, b;
  a.life = on_triangle(10, 16, first), b.life = on_triangle(15, 20, second);
  a.record = radiance_record(sky, Vec3(0), frame, 4);
  const auto later = [](const Vec3& w) { return Rgb(2 + w.x * w.z, w.y * w.y, 1 - 0.2f * w.x); };
  b.record = radiance_record(later, Vec3(0), make_frame(glm::normalize(kTurn * frame.z)), 4);
  a.change = change_between(a, b);
  const RadianceFilm film{film_info(TemporalGradients::interpolated), {a}};
  const RadianceRecord end = cache_at(film, 15, second).records.at(0);
  expect_near(end.frame.x, kTurn * frame.x);
  expect_near(end.frame.y, kTurn * frame.y);
  expect_near(end.frame.z, kTurn * frame.z);
  EXPECT_LT(farthest(end.light, projected(later, end.frame, 4)), 5e-6f);
  // Half way it is half of each, in the axes of then.
  const RadianceRecord middle = cache_at(film, 12, first).records.at(0);
  const std::vector<float> other = projected([&](const Vec3& w) { return later(kTurn * w); }, frame, 4);
  for (std::size_t i = 0; i < other.size(); ++i)
    EXPECT_NEAR(middle.light[i], 0.6f * a.record.light[i] + 0.4f * other[i], 5e-6f) << i;
}

/// The zone at the end of a record's life is the zone of the next record, on its surface, which has turned.
TEST(RadianceChange, FootprintsLeadToTheNextOne) {
  const Scene first = one_triangle(), second = one_triangle(1, kTurn, kMove);
  const Frame frame = make_frame(glm::normalize(Vec3(0.2f, -0.3f, 0.9f)));
  const auto lengths = [](std::uint64_t item) {
    return AdaptiveFootprint(Vec3(1, 0, 0), Vec3(0, 0, 1), test::random_axes(item, 1, 0)).lengths_m();
  };
  FilmRadianceRecord a, b;
  a.life = on_triangle(10, 15, first), b.life = on_triangle(15, 20, second);
  a.record = test::radiance_record(sky, Vec3(0), frame, 3);
  b.record = test::radiance_record(sky, Vec3(0), make_frame(glm::normalize(kTurn * frame.z)), 3);
  a.record.footprint_m = lengths(1), b.record.footprint_m = lengths(2);
  for (RadianceRecord* r : {&a.record, &b.record}) r->radius_m = 4 * irradiance_of(*r).footprint->longest_m();
  a.change = change_between(a, b);
  const IrradianceRecord end = irradiance_of(changed(a, 15)), next = irradiance_of(b.record);
  for (int k = 0; k < AdaptiveFootprint::kAxes; ++k) {
    const Vec2 u = AdaptiveFootprint::direction(k);
    const Vec3 to = 0.3f * (u.x * end.footprint->x() + u.y * end.footprint->y());
    EXPECT_NEAR(record_error(end, end.position + to, end.normal),
                record_error(next, next.position + kTurn * to, next.normal), 1e-4)
        << k;
  }
  const RadianceFilm film{film_info(TemporalGradients::interpolated), {a}};
  const RadianceRecord middle = cache_at(film, 12, first).records.at(0);
  for (std::size_t k = 0; k < middle.footprint_m->size(); ++k)
    EXPECT_NEAR((*middle.footprint_m)[k], (*a.record.footprint_m)[k] + 2 * (*a.change.footprint_m)[k], 1e-5f);
  // Neighbours and bounds do not change the zone.
  EXPECT_FALSE(change_between(a, b, Reach::stays).footprint_m);
}

TEST(RadianceChange, OfAnotherOrderIsAsFarAsTheFirstGoes) {
  FilmRadianceRecord a, b;
  a.life.birth = 10, a.life.end = b.life.birth = 12, b.life.end = 14;
  for (const auto& [first, second] : {std::pair(2, 4), std::pair(4, 2)}) {
    a.record = radiance_record(sky, Vec3(0), Frame(), first);
    b.record = radiance_record(sky, Vec3(0), Frame(), second);
    const RadianceChange change = change_between(a, b);
    ASSERT_EQ(change.light.size(), a.record.light.size());
    for (std::size_t i = 0; i < change.light.size(); ++i)
      EXPECT_NEAR(change.light[i], i < b.record.light.size() ? 0 : -a.record.light[i] / 2, 1e-6f);
  }
}

}  // namespace
}  // namespace phos::test
