#include "temporal/make_film.h"

#include <iterator>

#include "core/error.h"
#include "place/modes.h"

namespace phos::inline temporal {
namespace {

const RecordOptions& records_of(const FilmJob& job) {
  return job.of_radiance ? job.light.radiance.records : job.light.records;
}

/// One task for irradiance; for radiance one for each order that gloss wants.
std::vector<FilmTask> tasks_of(const FilmJob& job, Counters& counters) {
  std::vector<FilmTask> tasks;
  if (job.of_radiance) {
    for (const int order : job.gloss.orders())
      tasks.push_back(
          {records_of(job), job.placement,
           [&job, order](std::uint32_t material) { return job.gloss.order(material) == order; },
           [order, &counters](FrameLight& l) -> const Estimator& { return l.radiance(order, counters); }});
    return tasks;
  }
  tasks.push_back({records_of(job), job.placement, {}, [&counters](FrameLight& l) -> const Estimator& {
                     return l.irradiance(counters);
                   }});
  if (job.covered_by_radiance)
    tasks[0].unwanted = [&job](std::uint32_t material) { return job.gloss.order(material) > 0; };
  return tasks;
}

void add(FilmReport& all, const FilmReport& part) {
  all.estimates += part.estimates, all.uncovered += part.uncovered;
  all.frames_with_light.insert(part.frames_with_light.begin(), part.frames_with_light.end());
  all.kept_alive += part.kept_alive, all.deleted += part.deleted, all.making_s += part.making_s;
}

}  // namespace

bool needs_source(const FilmJob& job) {
  const RecordOptions& r = records_of(job);
  return !of_photons_alone(r) && r.gather_bounces != 1 && r.gather_from == GatherFrom::cache;
}

FilmInfo info_of(const FilmJob& job) {
  FilmInfo info;
  info.frames = job.survey.frames;
  info.accuracy = records_of(job).accuracy;
  info.temporal_accuracy = job.options.temporal_accuracy;
  info.max_life = job.options.max_life;
  info.gradients = job.options.gradients;
  info.fade = job.options.fade;
  info.scene_hash = job.survey.scene_hash;
  return info;
}

Film make_source(const FilmJob& job, FrameScenes& scenes, Counters& counters) {
  FilmOptions options = job.options;
  options.lives = Lives::midpoint, options.max_life = options.source_life, options.checks = 0;
  PlacementOptions placement;
  placement.place = Place::photons, placement.passes = 1, placement.max_candidates = kCoarseCandidates;
  LightOptions light = job.light;
  light.records = records_of(job);
  FrameLights lights(scenes, light, nullptr);
  const RecordOptions coarse = coarse_options(light.records);
  FilmMaker maker(lights, job.survey, options,
                  {.records = coarse,
                   .placement = placement,
                   .wanted = {},
                   .estimator = [&](FrameLight& l) -> const Estimator& { return l.source_records(counters); },
                   .label = "light that rays read"},
                  counters);
  maker.run();
  FilmInfo info = info_of(job);
  info.accuracy = coarse.accuracy, info.gradients = TemporalGradients::interpolated, info.fade = 0;
  info.max_life = options.max_life;
  return film_of(maker.chains(), info, coarse.paths);
}

FilmChains make_chains(const FilmJob& job, FrameScenes& scenes, const Film* source, Counters& counters) {
  FilmChains made;
  std::uint32_t first = 0;
  std::int64_t number = 0;
  for (FilmTask& task : tasks_of(job, counters)) {
    FrameLights lights(scenes, job.light, source);
    task.journal = job.journal, task.number = number++;
    FilmMaker maker(lights, job.survey, job.options, std::move(task), counters);
    maker.number_from(first);
    maker.run();
    first = maker.next_number();
    add(made.report, maker.report());
    std::vector<Chain> chains = maker.take_chains();
    made.chains.insert(made.chains.end(), std::make_move_iterator(chains.begin()),
                       std::make_move_iterator(chains.end()));
  }
  for (const Chain& c : made.chains) {
    ++made.report.chains;
    for (const Key& k : c.keys)
      if (k.until > k.frame) ++made.report.records, ++made.report.lives[k.until - k.frame];
  }
  return made;
}

std::vector<Key> make_still(const FilmJob& job, FrameScenes& scenes, const Film* source, Counters& counters,
                            FilmReport& report) {
  std::vector<Key> keys;
  for (FilmTask& task : tasks_of(job, counters)) {
    FrameLights lights(scenes, job.light, source);
    FilmMaker maker(lights, job.survey, job.options, std::move(task), counters);
    maker.still();
    add(report, maker.report());
    for (Chain& c : maker.take_chains()) keys.push_back(std::move(c.keys.front()));
  }
  report.chains = report.records = keys.size();
  return keys;
}

IrradianceCache still_irradiance(const FilmJob& job, std::span<const Key> keys) {
  IrradianceCache cache;
  cache.accuracy = records_of(job).accuracy, cache.scene_hash = job.survey.scene_hash.front();
  cache.quantity = records_of(job).paths;
  for (const Key& k : keys) cache.records.push_back(k.record);
  return cache;
}

RadianceCache still_radiance(const FilmJob& job, std::span<const Key> keys) {
  RadianceCache cache;
  cache.accuracy = records_of(job).accuracy, cache.scene_hash = job.survey.scene_hash.front();
  for (const Key& k : keys) {
    cache.records.push_back(*k.radiance);
    cache.records.back().radius_m = k.record.radius_m;
  }
  return cache;
}

RadianceOptions radiance_options(const RecordOptions& given, const Options& options) {
  RadianceOptions r;
  const RecordOptions defaults = r.records;
  r.records = given;
  if (!options.given("rays")) r.records.rays = defaults.rays;
  if (!options.given("accuracy")) r.records.accuracy = defaults.accuracy;
  if (!options.given("rho")) r.records.rho = defaults.rho;
  r.records.gradients = defaults.gradients;
  return r;
}

void resolve_film_places(PlacementOptions& placement, const Scene& scene, double accuracy) {
  if (placement.place == Place::automatic) placement.place = Place::view;
  if (placement.place == Place::given || placement.place == Place::every)
    throw Error(ExitCode::usage, "--place",
                "given and every read points, which films do not; give view, photons or surface");
  PlacementSource own;
  const PhotonMap traced = PhotonMap::build({}, {});
  own.photons = &traced;  // there will be some
  resolve(placement, scene, own, accuracy);
}

}  // namespace phos::inline temporal
