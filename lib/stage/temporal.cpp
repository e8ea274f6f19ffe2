#include "stage/temporal.h"

#include "estimate/record_ways.h"
#include "place/typical_distance.h"
#include "radiance/brdf/file.h"
#include "radiance/gloss_report.h"
#include "scene/nested_glass.h"
#include "splat/gl/choice.h"
#include "splat/raster/hemisphere_raster.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "temporal/film/file.h"
#include "temporal/film/inputs.h"
#include "temporal/film/report.h"

namespace phos::stage {
namespace {

/// The .brdf file among the inputs, if there is one, of these materials.
std::vector<BrdfTable> lobes_of(const RecordFiles& files, const Scene& scene) {
  if (files.brdf.empty()) return {};
  const Container file = Container::open(files.brdf, FileKind::brdf);
  require_together(file, files.scene, scene, false);
  return read_brdf(file);
}

void refuse_inputs(const RecordFiles& files) {
  const auto refuse = [](const std::string& path, const char* what) {
    if (!path.empty()) throw Error(ExitCode::usage, path, what);
  };
  refuse(files.photons, "holds photons of one time; phos-temporal traces its own (--photons): leave it out");
  refuse(files.source, "is an irradiance cache, which phos-temporal does not read; leave it out");
}

/// Ways of light that the records do not hold at any of the frames at which all places may have theirs
/// computed: the ends of each shot, and every --max-life between.
std::vector<LightWay> missed_in_film(const FilmJob& job, const RecordOptions& records, FrameScenes& scenes) {
  std::vector<LightWay> missed;
  if (sampler_of(records) == Sampler::photons) return missed;
  for (const FrameRange& shot : job.survey.shots) {
    for (std::int64_t f = shot.first;; f = std::min(f + job.options.max_life, shot.last)) {
      missed = united(std::move(missed), missed_ways(scenes.at(f)->rays, records));
      if (!job.survey.light_changes) return missed;
      if (f == shot.last) break;
    }
  }
  return missed;
}

}  // namespace

void run(Tool& tool, TemporalCommand& asked) {
  FilmJob& job = asked.job;
  RecordOptions& records = job.light.records;
  const FrameRange range = parse_frames(asked.frames);
  const RecordFiles files = sort_record_inputs(asked.inputs);
  take_site(tool, {files.radiance}, false);
  add_inputs(tool, files, asked.scene);
  refuse_inputs(files);
  job.of_radiance = asked.kind == RecordKind::radiance;
  if (!job.of_radiance && tool.options().given("store"))
    throw Error(ExitCode::usage, "--store",
                "shortens radiance records; add --kind radiance, or leave it out");
  job.options.resolve(tool.options(), records.estimate, job.of_radiance);
  if (job.of_radiance && records.footprint != Footprint::circle && records.footprint != Footprint::adaptive)
    throw Error(
        ExitCode::usage, "--footprint",
        "radiance records have discs or adaptive footprints; give circle or adaptive, or leave --kind "
        "radiance out");
  use_gl(tool, asked.gl);
  if (tool.up_to_date()) return;
  register_raster_estimator();

  {
    const auto timer = tool.time("survey");
    job.survey = survey(files.scene, asked.scene, range);
  }
  FrameScenes scenes(files.scene, asked.scene, asked.isa);
  const std::shared_ptr<const FrameScene> first = scenes.at(range.first);
  tell_losses(tool, first->scene);
  job.light.radiance = radiance_options(records, tool.options());
  job.light.photons.paths = job.options.photons, job.light.seed = tool.seed();
  resolve_film_places(job.placement, first->scene,
                      (job.of_radiance ? job.light.radiance.records : records).accuracy);
  const TypicalDistance typical = typical_distance(first->rays, job.placement, {});
  if (const auto nested = nested_glass(first->rays)) tool.warn(*nested);
  tell_raster_light(tool, first->rays, records);
  records.resolve(typical);
  job.light.radiance.records.resolve(typical);
  job.covered_by_radiance = !job.of_radiance && !files.radiance.empty();
  if (!files.radiance.empty())
    require_same_film(Container::open(files.radiance, FileKind::radiance), job.survey);
  if (job.of_radiance || job.covered_by_radiance)
    job.gloss = GlossTables(first->scene, lobes_of(files, first->scene), asked.gloss, {}, tool.counters());
  tell_of_film(tool, job);
  const RecordOptions& made = job.of_radiance ? job.light.radiance.records : records;
  std::vector<LightWay> missed;
  if (!job.of_radiance || !job.gloss.orders().empty()) missed = missed_in_film(job, made, scenes);
  tell_unsampled(tool, missed, sampler_of(made), samples_of(made));

  Film source;
  if (needs_source(job)) {
    const auto timer = tool.time("source");
    source = make_source(job, scenes, tool.counters());
    tool.stat("source_records", source.records.size());
  }
  const auto timer = tool.time("records");
  const Film* read = needs_source(job) ? &source : nullptr;
  const auto provenance = [&] {
    Provenance own = tool.provenance(job.of_radiance ? FileKind::radiance : FileKind::irradiance,
                                     first->scene.hash, first->scene.parts);
    note_unsampled(own, missed);
    return own;
  };
  FilmReport report;
  if (!job.survey.light_changes) {
    const std::vector<Key> keys = make_still(job, scenes, read, tool.counters(), report);
    if (job.of_radiance)
      write_radiance(tool.output(), still_radiance(job, keys), provenance(), asked.store);
    else
      write_irradiance(tool.output(), still_irradiance(job, keys), provenance());
  } else {
    EstimateJournal journal(tool.output() + ".journal", provenance().key, tool.options().given("reuse"));
    if (journal.found() > 0)
      tool.say(text(journal.found(), " estimates of an interrupted run are kept; the film goes on"));
    job.journal = &journal;
    const FilmChains film = journal.keeping([&] { return make_chains(job, scenes, read, tool.counters()); });
    report = film.report;
    if (job.of_radiance)
      write_film(tool.output(), radiance_film_of(film.chains, info_of(job)), provenance(), asked.store);
    else
      write_film(tool.output(), film_of(film.chains, info_of(job), records.paths), provenance());
    journal.finish();
  }
  tell_of_records(tool, job, report);
}

}  // namespace phos::stage
