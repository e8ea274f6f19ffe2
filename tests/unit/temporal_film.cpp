// Films: their files, and what they are at a frame.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/error.h"
#include "scene/lamp/form.h"
#include "support/films.h"
#include "support/golden_table.h"
#include "support/run.h"
#include "temporal/change.h"
#include "temporal/film/file.h"
#include "temporal/film/inputs.h"

namespace phos {
namespace {

using test::film_info;
using test::one_triangle;

constexpr TemporalGradients kAllGradients[] = {TemporalGradients::none, TemporalGradients::extrapolated,
                                               TemporalGradients::interpolated};

std::string scratch_file(const std::string& name) { return test::scratch("film") + "/" + name; }

// --- files ---

void expect_same(const FilmInfo& a, const FilmInfo& b) {
  EXPECT_EQ(a.frames.first, b.frames.first);
  EXPECT_EQ(a.frames.last, b.frames.last);
  EXPECT_EQ(a.accuracy, b.accuracy);
  EXPECT_EQ(a.temporal_accuracy, b.temporal_accuracy);
  EXPECT_EQ(a.max_life, b.max_life);
  EXPECT_EQ(a.gradients, b.gradients);
  EXPECT_EQ(a.fade, b.fade);
  EXPECT_EQ(a.scene_hash, b.scene_hash);
}

void expect_same(const Life& a, const Life& b) {
  EXPECT_EQ(a.birth, b.birth);
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.chain, b.chain);
  EXPECT_EQ(a.rate, b.rate);
  EXPECT_EQ(a.anchor.triangle, b.anchor.triangle);
  EXPECT_EQ(a.anchor.u, b.anchor.u);
  EXPECT_EQ(a.anchor.v, b.anchor.v);
  EXPECT_EQ(a.turn, b.turn);
}

TEST(FilmFile, KeepsEveryNumberOfIrradiance) {
  for (const TemporalGradients gradients : kAllGradients) {
    for (const bool anchored : {true, false}) {
      for (const std::size_t n : {0u, 1u, 20u}) {
        const Film film = test::random_film(n, anchored && n > 0, gradients);
        const std::string path = scratch_file("a.irradiance");
        write_film(path, film, test::irradiance_provenance());
        const Container file = Container::open(path, FileKind::irradiance);
        ASSERT_TRUE(is_film(file));
        EXPECT_EQ(file.tensors().size(),
                  12u + (anchored && n > 0 ? 3 : 0) + (gradients == TemporalGradients::none ? 0 : 4));
        const Film back = read_film(file);
        expect_same(film.info, back.info);
        EXPECT_EQ(back.quantity, Quantity::all);
        ASSERT_EQ(back.records.size(), n);
        for (std::size_t i = 0; i < n; ++i) {
          const FilmRecord &a = film.records[i], &b = back.records[i];
          expect_same(a.life, b.life);
          EXPECT_EQ(a.record.position, b.record.position);
          EXPECT_EQ(a.record.irradiance, b.record.irradiance);
          EXPECT_EQ(a.record.stderr_lx, b.record.stderr_lx);
          EXPECT_EQ(a.record.radius_m, b.record.radius_m);
          EXPECT_EQ(a.change.irradiance, b.change.irradiance);
          EXPECT_EQ(a.change.radius_m, b.change.radius_m);
          for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(a.record.rotation_gradient[c], b.record.rotation_gradient[c]);
            EXPECT_EQ(a.change.rotation[c], b.change.rotation[c]);
            EXPECT_EQ(a.change.translation[c], b.change.translation[c]);
          }
        }
      }
    }
  }
}

void expect_same(const AdaptiveFootprint::Axes& a, const AdaptiveFootprint::Axes& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].length_m, b[k].length_m);
    EXPECT_EQ(a[k].slope, b[k].slope);
    EXPECT_EQ(a[k].bend, b[k].bend);
    EXPECT_EQ(a[k].turn_slope, b[k].turn_slope);
    EXPECT_EQ(a[k].turn_bend, b[k].turn_bend);
  }
}

TEST(FilmFile, KeepsEveryNumberOfFootprints) {
  const Scene scene = one_triangle();
  for (const TemporalGradients gradients : kAllGradients) {
    const bool changes = gradients != TemporalGradients::none;
    Film film = test::random_film(12, true, gradients);
    test::add_footprints(film);
    const std::string path = scratch_file("shaped.irradiance");
    write_film(path, film, test::irradiance_provenance());
    const Container file = Container::open(path, FileKind::irradiance);
    EXPECT_EQ(file.tensors().size(), 21u + (changes ? 9 : 0));
    const Film back = read_film(file);
    ASSERT_EQ(back.records.size(), film.records.size());
    for (std::size_t i = 0; i < film.records.size(); ++i) {
      const FilmRecord &a = film.records[i], &b = back.records[i];
      ASSERT_TRUE(b.record.footprint);
      EXPECT_EQ(a.record.footprint->x(), b.record.footprint->x());
      expect_same(a.record.footprint->axes(), b.record.footprint->axes());
      ASSERT_EQ(b.change.footprint != nullptr, changes);
      if (changes) expect_same(*a.change.footprint, *b.change.footprint);
    }
    for (std::int64_t frame = 10; frame < 30; frame += 3) {
      const IrradianceCache now = cache_at(film, frame, scene), read = read_film_at(file, frame, scene);
      ASSERT_EQ(now.records.size(), read.records.size());
      for (std::size_t i = 0; i < now.records.size(); ++i) {
        expect_same(now.records[i].footprint->axes(), read.records[i].footprint->axes());
        EXPECT_EQ(now.records[i].radius_m, read.records[i].radius_m);
      }
    }
  }
}

TEST(FilmFile, KeepsEveryNumberOfRadiance) {
  for (const TemporalGradients gradients : kAllGradients) {
    for (const bool slopes : {true, false}) {
      const RadianceFilm film = test::random_radiance_film({2, 4, 4, 1, 3, 4, 2}, slopes, gradients, slopes);
      const std::string path = scratch_file("a.radiance");
      write_film(path, film, test::radiance_provenance());
      const Container file = Container::open(path, FileKind::radiance);
      ASSERT_TRUE(is_film(file));
      const bool changes = gradients != TemporalGradients::none;
      EXPECT_EQ(file.tensors().size(), slopes ? 16u + (changes ? 4 : 0) : 11u + (changes ? 2 : 0));
      const RadianceFilm back = read_radiance_film(file);
      expect_same(film.info, back.info);
      ASSERT_EQ(back.records.size(), film.records.size());
      for (std::size_t i = 0; i < film.records.size(); ++i) {
        const FilmRadianceRecord &a = film.records[i], &b = back.records[i];
        expect_same(a.life, b.life);
        EXPECT_EQ(a.record.position, b.record.position);
        EXPECT_EQ(a.record.frame.x, b.record.frame.x);
        EXPECT_EQ(a.record.light, b.record.light);
        EXPECT_EQ(a.record.gradient_y, b.record.gradient_y);
        EXPECT_EQ(a.change.light, b.change.light);
        EXPECT_EQ(a.change.gradient_x, b.change.gradient_x);
        EXPECT_EQ(a.change.gradient_y, b.change.gradient_y);
        EXPECT_EQ(a.change.radius_m, b.change.radius_m);
      }
    }
  }
}

TEST(FilmFile, KeepsFootprintsOfRadiance) {
  for (const TemporalGradients gradients : kAllGradients) {
    RadianceFilm film = test::random_radiance_film({2, 4, 4, 1, 3, 4, 2}, true, gradients);
    test::add_footprints(film);
    for (const Store store : {Store::floats, Store::compact}) {
      const std::string path = scratch_file("shaped.radiance");
      write_film(path, film, test::radiance_provenance(), store);
      const Container file = Container::open(path, FileKind::radiance);
      EXPECT_EQ(file.has("footprint_length_change"), gradients != TemporalGradients::none);
      const RadianceFilm back = read_radiance_film(file);
      ASSERT_EQ(back.records.size(), film.records.size());
      for (std::size_t i = 0; i < film.records.size(); ++i) {
        EXPECT_EQ(back.records[i].record.footprint_m, film.records[i].record.footprint_m);
        EXPECT_EQ(back.records[i].change.footprint_m, film.records[i].change.footprint_m);
      }
    }
  }
}

TEST(FilmFile, HeaderTellsChainsAndMeanLife) {
  const std::string path = scratch_file("b.irradiance");
  write_film(path, test::random_film(7, false, TemporalGradients::none), test::irradiance_provenance());
  const Container file = Container::open(path);
  const Json& film = *file.provenance().extra.find("film");
  EXPECT_EQ(film.find("chains")->as_integer(), 3);
  EXPECT_DOUBLE_EQ(film.find("mean_life")->as_number(), (3 * 3 + 4 * 5) / 7.);
}

TEST(FilmFile, CachesAndFilmsAreNotMistakenForEachOther) {
  const auto code = [](const auto& read) {
    try {
      read();
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return e.code();
    }
    return ExitCode::done;
  };
  const std::string film = scratch_file("c.irradiance"), cache = scratch_file("d.irradiance"),
                    lobes = scratch_file("c.radiance");
  write_film(film, test::random_film(3, false, TemporalGradients::none), test::irradiance_provenance());
  write_film(lobes, test::random_radiance_film({2, 2}, false, TemporalGradients::none),
             test::radiance_provenance());
  write_irradiance(cache, test::random_cache(3), test::irradiance_provenance());
  EXPECT_EQ(code([&] { read_irradiance(Container::open(film)); }), ExitCode::bad_input);
  EXPECT_EQ(code([&] { read_radiance(Container::open(lobes)); }), ExitCode::bad_input);
  EXPECT_EQ(code([&] { read_film(Container::open(cache)); }), ExitCode::bad_input);
  EXPECT_EQ(code([&] { read_film(Container::open(lobes)); }), ExitCode::bad_input);
  EXPECT_EQ(code([&] { read_radiance_film(Container::open(film)); }), ExitCode::bad_input);
  EXPECT_FALSE(is_film(Container::open(cache)));
}

/// No index, however many records: it would be one of all frames.
TEST(FilmFile, HasNoIndex) {
  const std::string path = scratch_file("e.irradiance");
  write_film(path, test::random_film(kIndexedRecords, false, TemporalGradients::none),
             test::irradiance_provenance());
  EXPECT_FALSE(Container::open(path).has("index_entries"));
}

// --- at a frame ---

FilmRecord still(std::int32_t birth, std::int32_t end, std::uint32_t chain = 0) {
  FilmRecord r;
  r.record.irradiance = Rgb(10, 20, 30);
  r.record.radius_m = r.record.distance_m = 1;
  r.life.birth = birth, r.life.end = end, r.life.chain = chain;
  return r;
}

Film film_of(TemporalGradients gradients, std::vector<FilmRecord> records) {
  return {film_info(gradients), Quantity::indirect, std::move(records)};
}

TEST(CacheAt, HasThoseThatLiveThen) {
  const Film film = test::random_film(30, false, TemporalGradients::none);
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
    const Film film = test::random_film(30, true, gradients);
    write_film(e, film, test::irradiance_provenance());
    const RadianceFilm lobes = test::random_radiance_film({2, 4, 4, 1, 3, 4, 2}, true, gradients);
    write_film(l, lobes, test::radiance_provenance());
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

/// Light and its changes to 11 bits, gradients and their changes to a byte.
TEST(FilmFile, CompactRadianceIsNearlyTheSame) {
  const RadianceFilm film =
      test::random_radiance_film({2, 4, 4, 1, 3, 4, 2}, true, TemporalGradients::interpolated);
  const std::string path = scratch_file("compact.radiance");
  write_film(path, film, test::radiance_provenance(), Store::compact);
  const RadianceFilm back = read_radiance_film(Container::open(path));
  ASSERT_EQ(back.records.size(), film.records.size());
  const auto expect_close = [](const std::vector<float>& a, const std::vector<float>& b, float within) {
    if (a.empty() && b.empty()) return;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], within) << i;
  };
  for (std::size_t i = 0; i < film.records.size(); ++i) {
    const FilmRadianceRecord &a = film.records[i], &b = back.records[i];
    EXPECT_EQ(a.life.birth, b.life.birth);
    EXPECT_EQ(a.change.radius_m, b.change.radius_m);
    // All numbers are from 0 to 1.
    expect_close(a.record.light, b.record.light, 0x1p-12f);
    expect_close(a.record.gradient_x, b.record.gradient_x, 0x1p-7f);
    expect_close(a.change.light, b.change.light, 0x1p-12f);
    expect_close(a.change.gradient_x, b.change.gradient_x, 0x1p-7f);
    expect_close(a.change.gradient_y, b.change.gradient_y, 0x1p-7f);
  }
}

// --- on surfaces that move ---

const glm::quat kTurn = glm::angleAxis(0.7f, glm::normalize(Vec3(1, -2, 3)));
const Vec3 kMove(5, -1, 2);

/// Born on the triangle where it lies flat.
Life on_triangle(std::int32_t birth, std::int32_t end, const Scene& at_birth) {
  Life life;
  life.birth = birth, life.end = end;
  life.anchor = {0, 0.25f, 0.5f};
  life.turn = pose_of(at_birth, life.anchor)->turn;
  return life;
}

void expect_near(const Vec3& a, const Vec3& b, float within = 1e-6f) {
  EXPECT_LT(glm::length(a - b), within * std::max(1.f, glm::length(b)))
      << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

TEST(CacheAt, RecordsMoveAndTurnWithTheirSurface) {
  const Scene flat = one_triangle(2), moved = one_triangle(2, kTurn, kMove);
  FilmRecord r;
  r.record = test::random_cache(1).records[0];
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

/// docs/methods.md#f5: at the frame where one record ends and the next begins they say the same.
TEST(ChangeBetween, LeadsToTheNextRecord) {
  const Scene first = one_triangle(), second = one_triangle(1, kTurn, kMove);
  const IrradianceCache random = test::random_cache(2);
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
  a.record = b.record = test::random_cache(1).records[0];
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

// --- footprints ---

/// A record with a footprint at the anchor of a triangle.
FilmRecord shaped_at(const Scene& scene, std::int32_t birth, std::int32_t end, std::uint64_t item,
                     const Vec3& normal) {
  FilmRecord r;
  r.record = test::random_cache(1).records[0];
  r.life = on_triangle(birth, end, scene);
  r.record.position = pose_of(scene, r.life.anchor)->position, r.record.normal = normal;
  r.record.irradiance = Rgb(50, 60, 70);
  r.record.footprint =
      std::make_shared<AdaptiveFootprint>(make_frame(normal).x, normal, test::random_axes(item, 0.3f, 10));
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

// --- radiance ---

Rgb sky(const Vec3& w) { return Rgb(1 + 0.5f * w.x, 1 + 0.4f * w.y * w.z, 0.5f + 0.3f * w.x * w.y); }

float farthest(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  float most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

/// A record of light and of its change along two axes of the world, in any frame.
RadianceRecord radiance_at(const test::WorldLight& light, const test::WorldLight slope[2], const Vec3 axis[2],
                           const Frame& frame) {
  RadianceRecord r = test::radiance_record(light, Vec3(0), frame, 4);
  for (int k = 0; k < 2; ++k) {
    const std::vector<float> along = test::projected(slope[k], frame, 4);
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
  const test::WorldLight slope[2] = {[](const Vec3& w) { return Rgb(w.z * w.x, w.y, 0); },
                                     [](const Vec3& w) { return Rgb(0, w.z, w.x * w.x); }};
  const Vec3 axis[2] = {frame.x, frame.y};
  const glm::quat back = glm::conjugate(kTurn);
  const test::WorldLight turned_slope[2] = {[&](const Vec3& w) { return slope[0](back * w); },
                                            [&](const Vec3& w) { return slope[1](back * w); }};
  const Vec3 turned_axis[2] = {kTurn * axis[0], kTurn * axis[1]};
  FilmRadianceRecord a, b;
  a.life = on_triangle(10, 15, one_triangle()), b.life = on_triangle(15, 20, one_triangle(1, kTurn, kMove));
  a.record = radiance_at(sky, slope, axis, frame);
  b.record = radiance_at([&](const Vec3& w) { return sky(back * w); }, turned_slope, turned_axis,
                         test::turned_about_z(make_frame(glm::normalize(kTurn * frame.z)), 1.1f));
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
  a.record = test::radiance_record(sky, Vec3(0), frame, 4);
  const auto later = [](const Vec3& w) { return Rgb(2 + w.x * w.z, w.y * w.y, 1 - 0.2f * w.x); };
  b.record = test::radiance_record(later, Vec3(0), make_frame(glm::normalize(kTurn * frame.z)), 4);
  a.change = change_between(a, b);
  const RadianceFilm film{film_info(TemporalGradients::interpolated), {a}};
  const RadianceRecord end = cache_at(film, 15, second).records.at(0);
  expect_near(end.frame.x, kTurn * frame.x);
  expect_near(end.frame.y, kTurn * frame.y);
  expect_near(end.frame.z, kTurn * frame.z);
  EXPECT_LT(farthest(end.light, test::projected(later, end.frame, 4)), 5e-6f);
  // Half way it is half of each, in the axes of then.
  const RadianceRecord middle = cache_at(film, 12, first).records.at(0);
  const std::vector<float> other = test::projected([&](const Vec3& w) { return later(kTurn * w); }, frame, 4);
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
    a.record = test::radiance_record(sky, Vec3(0), Frame(), first);
    b.record = test::radiance_record(sky, Vec3(0), Frame(), second);
    const RadianceChange change = change_between(a, b);
    ASSERT_EQ(change.light.size(), a.record.light.size());
    for (std::size_t i = 0; i < change.light.size(); ++i)
      EXPECT_NEAR(change.light[i], i < b.record.light.size() ? 0 : -a.record.light[i] / 2, 1e-6f);
  }
}

// --- the formula of all of it ---

using D = glm::dvec3;

/// Irradiance by a square of radiance 50 at z = 2, its middle at x = -2 + 0.05 t.
double under_square(const D& p, const D& n, double t) {
  const double x = -2 + 0.05 * t;
  std::vector<D> corners{{x - 0.5, -0.5, 2}, {x + 0.5, -0.5, 2}, {x + 0.5, 0.5, 2}, {x - 0.5, 0.5, 2}};
  for (D& corner : corners) corner -= p;
  return 50 * std::fabs(projected_solid_angle(corners, n));
}

IrradianceRecord square_record(double t) {
  constexpr double h = 1e-3;
  const D up(0, 0, 1);
  const auto slope = [&](const D& e) {
    return (under_square(h * e, up, t) - under_square(-h * e, up, t)) / (2 * h);
  };
  const auto tilt = [&](const D& e) {
    const auto towards = [&](double s) {
      return under_square(D(0), s * std::sin(h) * e + std::cos(h) * up, t);
    };
    return (towards(1) - towards(-1)) / (2 * h);
  };
  IrradianceRecord r;
  r.radius_m = 10;
  r.irradiance = Rgb(static_cast<float>(under_square(D(0), up, t)));
  for (int c = 0; c < 3; ++c) {
    r.translation_gradient[c] = Vec3(D(slope({1, 0, 0}), slope({0, 1, 0}), 0));
    r.rotation_gradient[c] = Vec3(D(-tilt({0, 1, 0}), tilt({1, 0, 0}), 0));
  }
  return r;
}

TEST(Film, ExtrapolationInSpaceAndTimeIsThatOfTheTable) {
  FilmRecord a, b;
  a.life.birth = 10, a.life.end = 14, b.life.birth = 14, b.life.end = 18;
  a.record = square_record(10), b.record = square_record(14);
  a.change = change_between(a, b);
  const Film film = film_of(TemporalGradients::interpolated, {a, b});
  const IrradianceRecord now = cache_at(film, 12, {}).records.at(0);
  const Vec3 p(0.2f, 0.1f, 0), n(std::sin(0.1f), 0, std::cos(0.1f));
  std::map<std::string, double> table;
  for (auto& row : test::golden("F_eq511.csv")) table[row["form"]] = std::stod(row["E"]);
  ASSERT_EQ(table.size(), 6u);
  EXPECT_NEAR(under_square(D(p), D(n), 12), table["truth"], 1e-6);
  EXPECT_NEAR(extrapolate(now, p, n).x, table["corrected"], 1e-4);
}

// --- which frame ---

Scene scene_at(double frame) {
  Scene scene;
  scene.path = "room.glb";
  scene.time_s = frame / 24;
  scene.hash = text("hash ", std::llround(frame));
  return scene;
}

std::string refused(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::mismatch);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "";
}

TEST(FilmInputs, TheSceneSaysWhichFrame) {
  const std::string path = scratch_file("f.irradiance");
  const Film film = test::random_film(12, false, TemporalGradients::interpolated);
  write_film(path, film, test::irradiance_provenance());
  const Container file = Container::open(path);
  for (const int frame : {10, 14, 29}) {
    EXPECT_EQ(frame_of(scene_at(frame)), frame);
    EXPECT_EQ(refused([&] { require_same_scene(file, "", scene_at(frame)); }), "");
    EXPECT_EQ(read_irradiance_at(file, scene_at(frame)).records.size(),
              cache_at(film, frame, Scene()).records.size());
  }
  for (const int frame : {0, 9, 30}) {
    const std::string said = refused([&] { require_same_scene(file, "", scene_at(frame)); });
    EXPECT_NE(said.find("frames 10 to 29"), std::string::npos) << said;
    EXPECT_NE(refused([&] { read_irradiance_at(file, scene_at(frame)); }), "");
  }
  Scene other = scene_at(12);
  other.hash = "hash 13";
  EXPECT_NE(refused([&] { require_same_scene(file, "", other); }).find("another scene"), std::string::npos);
  other = scene_at(12.4);
  other.hash = "between";
  EXPECT_NE(refused([&] { require_same_scene(file, "", other); }).find("12.4"), std::string::npos);
}

TEST(FilmInputs, OfRadianceAndOfOrdinaryCaches) {
  const std::string film = scratch_file("f.radiance"), cache = scratch_file("g.radiance");
  write_film(film, test::random_radiance_film({2, 2, 2}, false, TemporalGradients::none),
             test::radiance_provenance());
  write_radiance(cache, test::random_radiance(4, 2), test::radiance_provenance());
  EXPECT_EQ(read_radiance_at(Container::open(film), scene_at(22)).records.size(), 1u);
  EXPECT_NE(refused([&] { read_radiance_at(Container::open(film), scene_at(2)); }), "");
  EXPECT_EQ(read_radiance_at(Container::open(cache), scene_at(22)).records.size(), 4u);
}

}  // namespace
}  // namespace phos
