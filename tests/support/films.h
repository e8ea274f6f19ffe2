// Films of random records, and a scene that is one triangle.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <string>

#include "core/error.h"
#include "support/indexed_file.h"
#include "support/radiance_records.h"
#include "temporal/film/cache.h"

namespace phos::test {

/// The triangle (0,0,0), (1,0,0), (0,1,0), sized, turned and moved.
inline Scene one_triangle(float size = 1, const glm::quat& turn = glm::quat(1, 0, 0, 0),
                          const Vec3& to = Vec3(0)) {
  Scene scene;
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})
    scene.position.push_back(turn * (size * v) + to);
  scene.triangle.push_back({{0, 1, 2}});
  return scene;
}

inline glm::quat random_turn(RandomStream& random) {
  return glm::angleAxis(6 * random.uniform(), sample_uniform_sphere(random.uniform2()));
}

/// Frames 10 to 29.
inline FilmInfo film_info(TemporalGradients gradients) {
  FilmInfo info;
  info.frames = {10, 29};
  info.accuracy = 0.3, info.temporal_accuracy = 0.1, info.max_life = 8;
  info.gradients = gradients, info.fade = 2;
  for (int i = 0; i < 20; ++i) info.scene_hash.push_back(text("hash ", 10 + i));
  return info;
}

/// Lives of record i: chains 0, 2, 4 ... of up to three records each, the second of which begins where the
/// first ends, and the third a while after the second.
inline Life film_life(std::size_t i, bool anchored) {
  RandomStream random(8, Stage::test, i);
  Life life;
  life.chain = static_cast<std::uint32_t>(i / 3 * 2);
  const std::int32_t at[] = {10, 13, 21};
  life.birth = at[i % 3], life.end = i % 3 == 0 ? 13 : at[i % 3] + 5;
  life.rate = random.uniform();
  if (!anchored || i % 4 == 3) return life;
  life.anchor = {static_cast<std::uint32_t>(i), 0.5f * random.uniform(), 0.5f * random.uniform()};
  life.turn = random_turn(random);
  return life;
}

inline Film random_film(std::size_t n, bool anchored, TemporalGradients gradients) {
  Film film;
  film.info = film_info(gradients);
  film.quantity = Quantity::all;
  const IrradianceCache records = random_cache(n), others = random_cache(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    FilmRecord& r = film.records.emplace_back();
    r.record = records.records[i], r.life = film_life(i, anchored);
    if (gradients == TemporalGradients::none) continue;
    const IrradianceRecord& other = others.records[n + i];
    r.change.irradiance = 0.1f * other.position - 0.05f;
    for (int c = 0; c < 3; ++c) {
      r.change.rotation[c] = other.rotation_gradient[c];
      r.change.translation[c] = other.translation_gradient[c];
    }
    r.change.radius_m = 0.1f * (other.position.x - 0.5f) * r.record.radius_m;
  }
  return film;
}

/// Axes of `scale` times a random length each, and light that changes along them by up to `lux`.
inline AdaptiveFootprint::Axes random_axes(std::uint64_t item, float scale, float lux) {
  RandomStream random(9, Stage::test, item);
  const auto light = [&] {
    const float r = random.uniform(), g = random.uniform(), b = random.uniform();
    return lux * Rgb(2 * r - 1, 2 * g - 1, 2 * b - 1);
  };
  AdaptiveFootprint::Axes axes;
  for (AdaptiveFootprint::Axis& axis : axes) {
    axis.length_m = scale * (0.3f + 0.7f * random.uniform());
    axis.slope = light(), axis.bend = light(), axis.turn_slope = light(), axis.turn_bend = light();
  }
  return axes;
}

/// Gives every record of a film a footprint, which changes as all else does.
inline void add_footprints(Film& film) {
  for (std::size_t i = 0; i < film.records.size(); ++i) {
    FilmRecord& r = film.records[i];
    r.record.footprint = std::make_shared<AdaptiveFootprint>(make_frame(r.record.normal).x, r.record.normal,
                                                             random_axes(i, r.record.radius_m, 1));
    if (film.info.gradients == TemporalGradients::none) continue;
    AdaptiveFootprint::Axes change = random_axes(1000 + i, 0.05f * r.record.radius_m, 0.1f);
    if (i % 2 == 0)
      for (AdaptiveFootprint::Axis& axis : change) axis.length_m *= -1;
    r.change.footprint = std::make_shared<const AdaptiveFootprint::Axes>(change);
  }
}

inline RadianceFilm random_radiance_film(const std::vector<int>& orders, bool anchored,
                                         TemporalGradients gradients, bool slopes = true) {
  RadianceFilm film;
  film.info = film_info(gradients);
  RadianceCache records = random_radiance(orders);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    FilmRadianceRecord& r = film.records.emplace_back();
    r.record = records.records[i], r.life = film_life(i, anchored);
    if (!slopes) r.record.gradient_x.clear(), r.record.gradient_y.clear();
    if (gradients == TemporalGradients::none || i % 5 == 4) continue;
    // Any numbers: a record's own of another kind.
    r.change.light = records.records[i].gradient_x;
    if (slopes) r.change.gradient_x = r.record.gradient_y, r.change.gradient_y = r.record.light;
    r.change.radius_m = 0.01f * r.record.radius_m;
  }
  return film;
}

/// Gives every record of a film a footprint, which changes as all else does.
inline void add_footprints(RadianceFilm& film) {
  for (std::size_t i = 0; i < film.records.size(); ++i) {
    FilmRadianceRecord& r = film.records[i];
    const auto lengths = [&](std::uint64_t item, float scale) {
      return AdaptiveFootprint(Vec3(1, 0, 0), Vec3(0, 0, 1), random_axes(item, scale, 0)).lengths_m();
    };
    r.record.footprint_m = lengths(i, r.record.radius_m);
    if (film.info.gradients == TemporalGradients::none) continue;
    r.change.footprint_m = lengths(1000 + i, (i % 2 == 0 ? -0.05f : 0.05f) * r.record.radius_m);
  }
}

}  // namespace phos::test
