// Files of films keep their numbers, and are not taken for caches.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "support/film_records.h"
#include "support/run.h"
#include "temporal/film/file.h"

namespace phos::test {
namespace {

std::string scratch_file(const std::string& name) { return scratch("film") + "/" + name; }

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
        const Film film = random_film(n, anchored && n > 0, gradients);
        const std::string path = scratch_file("a.irradiance");
        write_film(path, film, irradiance_provenance());
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
    Film film = random_film(12, true, gradients);
    add_footprints(film);
    const std::string path = scratch_file("shaped.irradiance");
    write_film(path, film, irradiance_provenance());
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
      const RadianceFilm film = random_radiance_film({2, 4, 4, 1, 3, 4, 2}, slopes, gradients, slopes);
      const std::string path = scratch_file("a.radiance");
      write_film(path, film, radiance_provenance());
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
  write_film(path, random_film(7, false, TemporalGradients::none), irradiance_provenance());
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
  write_film(film, random_film(3, false, TemporalGradients::none), irradiance_provenance());
  write_film(lobes, random_radiance_film({2, 2}, false, TemporalGradients::none), radiance_provenance());
  write_irradiance(cache, random_cache(3), irradiance_provenance());
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
  write_film(path, random_film(kIndexedRecords, false, TemporalGradients::none), irradiance_provenance());
  EXPECT_FALSE(Container::open(path).has("index_entries"));
}

/// Light and its changes to 11 bits, gradients and their changes to a byte.
TEST(FilmFile, CompactRadianceIsNearlyTheSame) {
  const RadianceFilm film =
      random_radiance_film({2, 4, 4, 1, 3, 4, 2}, true, TemporalGradients::interpolated);
  const std::string path = scratch_file("compact.radiance");
  write_film(path, film, radiance_provenance(), Store::compact);
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

}  // namespace
}  // namespace phos::test
