// The records of a film at a frame: those that live then, faded, and moved with their surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/film_records.h"
#include "support/run.h"
#include "temporal/film/file.h"

namespace phos::test {
namespace {

std::string scratch_file(const std::string& name) { return scratch("film") + "/" + name; }

TEST(CacheAt, HasThoseThatLiveThen) {
  const Film film = random_film(30, false, TemporalGradients::none);
  const Scene scene;
  for (std::int64_t frame = 9; frame < 31; ++frame) {
    const IrradianceCache cache = cache_at(film, frame, scene);
    std::vector<Vec3> expected;
    for (const FilmRecord& r : film.records)
      if (r.life.birth <= frame && frame < r.life.end) expected.push_back(r.record.position);
    ASSERT_EQ(cache.records.size(), expected.size()) << frame;
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(cache.records[i].position, expected[i]);
    EXPECT_EQ(cache.accuracy, film.info.accuracy);
    EXPECT_EQ(cache.quantity, Quantity::all);
  }
}

/// docs/methods.md#f1, with a floor: what is there must count where it is alone.
TEST(CacheAt, WeightsFallWithAgeUnlessInterpolated) {
  for (const TemporalGradients gradients : kAllGradients) {
    FilmRecord r = still(10, 18);
    r.life.rate = 0.0125f;  // of 0.1: nothing is left at age 8
    const Film film = film_of(gradients, {r, still(18, 30)});
    for (std::int64_t frame = 10; frame < 18; ++frame) {
      const float age = static_cast<float>(frame - 10);
      EXPECT_NEAR(cache_at(film, frame, {}).records.at(0).weight,
                  gradients == TemporalGradients::interpolated ? 1 : 1 - age / 8, 1e-6f);
    }
    r.life.rate = 1;
    EXPECT_NEAR(cache_at(film_of(gradients, {r, still(18, 30)}), 15, {}).records.at(0).weight,
                gradients == TemporalGradients::interpolated ? 1 : 0.01f, 1e-6f);
  }
}

TEST(CacheAt, PlacesFadeInAndOut) {
  // Frames 10 to 29 and fades of 2: the chain's own beginning and end, not those of its records.
  const Film film = film_of(TemporalGradients::interpolated, {still(15, 16), still(16, 18), still(18, 22),
                                                              still(10, 14, 1), still(25, 30, 2)});
  const auto weights = [&](std::int64_t frame) {
    std::vector<float> w;
    for (const IrradianceRecord& r : cache_at(film, frame, {}).records) w.push_back(r.weight);
    return w;
  };
  const float third = 1.f / 3;
  EXPECT_EQ(weights(10), std::vector<float>{1}) << "it was there before the film";
  EXPECT_EQ(weights(11), std::vector<float>{1});
  EXPECT_FLOAT_EQ(weights(12).at(0), 2 * third);
  EXPECT_FLOAT_EQ(weights(13).at(0), third);
  EXPECT_TRUE(weights(14).empty());
  EXPECT_FLOAT_EQ(weights(15).at(0), third);
  EXPECT_FLOAT_EQ(weights(16).at(0), 2 * third) << "its second record";
  EXPECT_EQ(weights(17), std::vector<float>{1});
  EXPECT_EQ(weights(19), std::vector<float>{1});
  EXPECT_FLOAT_EQ(weights(20).at(0), 2 * third);
  EXPECT_FLOAT_EQ(weights(21).at(0), third);
  EXPECT_FLOAT_EQ(weights(25).at(0), third);
  EXPECT_EQ(weights(29), std::vector<float>{1}) << "it is there after the film";
}

/// A gap in a chain is an end and a beginning; what is shorter than its fades never counts in full.
TEST(CacheAt, GapsFadeAndShortLivesStayFaint) {
  const Film film = film_of(TemporalGradients::interpolated, {still(12, 16), still(18, 19)});
  EXPECT_FLOAT_EQ(cache_at(film, 15, {}).records.at(0).weight, 1.f / 3);
  EXPECT_FLOAT_EQ(cache_at(film, 13, {}).records.at(0).weight, 2.f / 3);
  EXPECT_TRUE(cache_at(film, 17, {}).records.empty());
  EXPECT_FLOAT_EQ(cache_at(film, 18, {}).records.at(0).weight, 1.f / 9);
}

TEST(CacheAt, ExtrapolatedLightAndRadiiStayPositive) {
  FilmRecord r = still(10, 18);
  r.change.irradiance = {-4, 1, -5};
  r.change.radius_m = -0.5f;
  const Film film = film_of(TemporalGradients::extrapolated, {r});
  for (std::int64_t frame = 10; frame < 18; ++frame) {
    const float age = static_cast<float>(frame - 10);
    const IrradianceRecord now = cache_at(film, frame, {}).records.at(0);
    EXPECT_FLOAT_EQ(now.irradiance.x, std::max(0.f, 10 - 4 * age));
    EXPECT_FLOAT_EQ(now.irradiance.y, 20 + age);
    EXPECT_FLOAT_EQ(now.irradiance.z, std::max(0.f, 30 - 5 * age));
    EXPECT_FLOAT_EQ(now.radius_m, std::max(0.125f, 1 - 0.5f * age));
  }
}

/// Of a file, what is alive is read alone.
TEST(CacheAt, OfAFileIsTheSame) {
  const Scene scene = one_triangle();
  for (const TemporalGradients gradients : kAllGradients) {
    const std::string e = scratch_file("at.irradiance"), l = scratch_file("at.radiance");
    const Film film = random_film(30, true, gradients);
    write_film(e, film, irradiance_provenance());
    const RadianceFilm lobes = random_radiance_film({2, 4, 4, 1, 3, 4, 2}, true, gradients);
    write_film(l, lobes, radiance_provenance());
    const Container irradiance = Container::open(e), radiance = Container::open(l);
    const auto lives = [&](const auto& records, std::int64_t at) {
      std::vector<std::int32_t> all;
      for (const auto& r : records) {
        const std::uint32_t on = r.life.anchor.triangle;
        const bool shown = on == kNoTriangle || on < scene.triangle.size();
        if (shown && r.life.birth <= at && at < r.life.end) all.push_back(r.life.end - r.life.birth);
      }
      return all;
    };
    for (std::int64_t frame = 9; frame < 31; ++frame) {
      EXPECT_EQ(lives_at(irradiance, frame, scene), lives(film.records, frame)) << frame;
      EXPECT_EQ(lives_at(radiance, frame, scene), lives(lobes.records, frame)) << frame;
      const IrradianceCache a = cache_at(film, frame, scene), b = read_film_at(irradiance, frame, scene);
      ASSERT_EQ(a.records.size(), b.records.size());
      EXPECT_EQ(a.quantity, b.quantity);
      EXPECT_EQ(a.accuracy, b.accuracy);
      for (std::size_t i = 0; i < a.records.size(); ++i) {
        EXPECT_EQ(a.records[i].irradiance, b.records[i].irradiance);
        EXPECT_EQ(a.records[i].normal, b.records[i].normal);
        EXPECT_EQ(a.records[i].weight, b.records[i].weight);
      }
      const RadianceCache c = cache_at(lobes, frame, scene),
                          d = read_radiance_film_at(radiance, frame, scene);
      ASSERT_EQ(c.records.size(), d.records.size());
      for (std::size_t i = 0; i < c.records.size(); ++i) {
        EXPECT_EQ(c.records[i].light, d.records[i].light);
        EXPECT_EQ(c.records[i].gradient_y, d.records[i].gradient_y);
        EXPECT_EQ(c.records[i].radius_m, d.records[i].radius_m);
        EXPECT_EQ(c.records[i].weight, d.records[i].weight);
      }
    }
  }
}

TEST(CacheAt, RecordsMoveAndTurnWithTheirSurface) {
  const Scene flat = one_triangle(2), moved = one_triangle(2, kTurn, kMove);
  FilmRecord r;
  r.record = random_cache(1).records[0];
  r.life = on_triangle(10, 15, flat);
  r.record.position = pose_of(flat, r.life.anchor)->position;
  const Film film = film_of(TemporalGradients::none, {r});
  const IrradianceRecord there = cache_at(film, 10, flat).records.at(0);
  EXPECT_EQ(there.position, r.record.position);
  EXPECT_EQ(there.normal, r.record.normal) << "nothing is rounded where nothing turns";
  const IrradianceRecord now = cache_at(film, 11, moved).records.at(0);
  expect_near(now.position, kTurn * r.record.position + kMove);
  expect_near(now.normal, kTurn * r.record.normal);
  for (int c = 0; c < 3; ++c) {
    expect_near(now.rotation_gradient[c], kTurn * r.record.rotation_gradient[c]);
    expect_near(now.translation_gradient[c], kTurn * r.record.translation_gradient[c]);
  }
  EXPECT_EQ(now.irradiance, r.record.irradiance);
  // The light about it is the same seen from the surface.
  const Vec3 p(0.1f, 0.2f, 0), n = glm::normalize(r.record.normal + Vec3(0.1f, 0, 0.2f));
  expect_near(extrapolate(now, now.position + kTurn * p, kTurn * n),
              extrapolate(there, there.position + p, n), 1e-5f);
}

TEST(CacheAt, LeavesOutWhatHasNoSurface) {
  FilmRecord r = still(10, 15), gone = still(10, 15, 1);
  r.life = on_triangle(10, 15, one_triangle());
  gone.life = r.life, gone.life.chain = 1, gone.life.anchor.triangle = 1;
  const Film film = film_of(TemporalGradients::none, {r, gone, still(10, 15, 2)});
  EXPECT_EQ(cache_at(film, 11, one_triangle()).records.size(), 2u) << "the scene has one triangle";
  EXPECT_EQ(cache_at(film, 11, one_triangle(0)).records.size(), 1u);
  EXPECT_EQ(cache_at(film, 11, Scene()).records.size(), 1u);
}

}  // namespace
}  // namespace phos::test
