// Films at every size and power: what moves, what is dimmed, and what records know of the frames to come.
#include <gtest/gtest.h>

#include "support/animated.h"
#include "support/records.h"
#include "support/sweep.h"
#include "temporal/make_film.h"

namespace phos::test {
namespace {

/// A plate moves between two slabs, under a lamp that is dimmed; frames 0 to 4.
std::string moving_plate(Scale by) {
  const auto m = static_cast<float>(by.length), cd = static_cast<float>(by.lumens);
  Animated film;
  film.slab("floor", 4 * m, 0, 0, 0);
  film.slab("ceiling", 4 * m, 0, 2 * m, 0);
  const int plate = film.slab("plate", m, 0, 0.5f * m, 0);
  film.animate(plate, "translation", {0, 4}, {-0.2f * m, 0.5f * m, 0, 0.2f * m, 0.5f * m, 0.1f * m});
  film.lamp("lamp", "point", 100 * cd, 0.1f * m, 1.5f * m, 0);
  film.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 4}, {100 * cd, 85 * cd});
  film.animate(film.camera("eye"), "translation", {0, 4}, {0, 1.4f * m, 3 * m, 0.1f * m, 1.4f * m, 3 * m});
  return film.write("scaled-film", 5);
}

FilmJob job_of(const std::string& path, FrameScenes& scenes, Estimate estimate, Lives lives) {
  FilmJob job;
  job.survey = survey(path, {}, {0, 4});
  const Scene& first = scenes.at(0)->scene;
  RecordOptions& records = job.light.records;
  records.estimate = estimate;
  records.rays = 64, records.accuracy = 0.5;
  records.resolve(first.bounds.diagonal_m() / 4);
  job.light.radiance.records.resolve(first.bounds.diagonal_m() / 4);
  job.options.photons = 5000, job.light.photons.paths = job.options.photons;
  job.options.lives = lives, job.options.max_life = 4, job.options.source_life = 4,
  job.options.temporal_accuracy = 0.02;
  if (lives == Lives::rate) job.options.gradients = TemporalGradients::extrapolated;
  job.placement.place = Place::view, job.placement.width = 12, job.placement.height = 9;
  resolve_film_places(job.placement, first, records.accuracy);
  return job;
}

Figures film(Scale by, Estimate estimate, Lives lives) {
  const std::string path = moving_plate(by);
  FrameScenes scenes(path, {}, "");
  const FilmJob job = job_of(path, scenes, estimate, lives);
  Counters counters;
  Film source;
  if (needs_source(job)) source = make_source(job, scenes, counters);
  const FilmChains made = make_chains(job, scenes, needs_source(job) ? &source : nullptr, counters);
  const Film film = film_of(made.chains, info_of(job), Quantity::indirect);
  Figures f;
  f.number(static_cast<double>(film.records.size()));
  for (const FilmRecord& r : film.records) {
    f.record(r.record);
    f.number(r.life.birth), f.number(r.life.end), f.number(r.life.chain),
        f.number(static_cast<double>(r.life.rate));
    f.lux(r.change.irradiance), f.metres(static_cast<double>(r.change.radius_m));
    for (int c = 0; c < 3; ++c) f.lux(r.change.rotation[c]), f.lux_per_metre(r.change.translation[c]);
  }
  for (const IrradianceRecord& r : cache_at(film, 3, scenes.at(3)->scene).records) f.record(r);
  return f;
}

TEST(ScaleSweep, FilmThatChecksItsMiddle) {
  sweep_scales("records of a film, checked halfway",
               [](Scale by) { return film(by, Estimate::gather, Lives::midpoint); });
}

TEST(ScaleSweep, FilmThatLooksAhead) {
  sweep_scales("records of a film, looking ahead",
               [](Scale by) { return film(by, Estimate::gather, Lives::rate); });
}

TEST(ScaleSweep, FilmFromPhotons) {
  sweep_scales("records of a film, from photons",
               [](Scale by) { return film(by, Estimate::hull, Lives::midpoint); },
               {.binades = 1e-8});  // changes of slopes of 1e-38 lx/m are below the numbers
}

}  // namespace
}  // namespace phos::test
