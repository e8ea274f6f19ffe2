// phos-temporal: an animated scene -> records that live through its frames.
#include "file/tool.h"
#include "place/typical_distance.h"
#include "radiance/gloss_report.h"
#include "scene/load.h"
#include "splat/irradiance_inputs.h"
#include "temporal/film/inputs.h"
#include "temporal/film/report.h"
#include "temporal/make_film.h"

using namespace phos;

namespace {

enum class Kind { irradiance, radiance };

/// The .brdf file among the inputs, if there is one, of these materials.
std::vector<BrdfTable> lobes_of(const IrradianceFiles& files, const Scene& scene) {
  if (files.brdf.empty()) return {};
  const Container file = Container::open(files.brdf, "brdf");
  require_same_scene(file, files.scene, scene.hash, scene.parts);
  return read_brdf(file);
}

void refuse_inputs(const IrradianceFiles& files) {
  const auto refuse = [](const std::string& path, const char* what) {
    if (!path.empty()) throw Error(ExitCode::usage, path, what);
  };
  refuse(files.photons, "holds photons of one time; phos-temporal traces its own (--photons): leave it out");
  refuse(files.source, "is an irradiance cache, which phos-temporal does not read; leave it out");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-temporal", "places records that live through the frames of an animation",
            "Objects, lamps and the camera move: records are anchored to the surfaces that they lie on, and "
            "the light at "
            "each is computed at as few frames as its change allows, with the same random numbers at all of "
            "them. Between "
            "these frames phos-splat --frames (or --frame) interpolates. Photons are traced here, where they "
            "are needed, for "
            "the frames that need them. Places that the camera no longer sees are given up. A scene in which "
            "no light "
            "changes gives an ordinary cache. Inputs, in any order: a scene; for radiance records its .brdf "
            "file (else "
            "lobes are projected here); and for irradiance records the radiance film of the same frames, "
            "whose surfaces then "
            "get none of their own.",
            18);
  std::vector<std::string> paths;
  std::string frames, isa;
  SceneOptions scene_options;
  FilmJob job;
  Kind kind = Kind::irradiance;
  GlossBy gloss = GlossBy::automatic;
  RecordOptions& records = job.light.records;
  records.estimate = Estimate::gather;
  job.placement.place = Place::view;
  Options& options = tool.options();
  options.inputs("SCENE [BRDF] [RADIANCE]", paths,
                 "animated scene (.glb, .gltf); its .brdf file; a radiance film");
  declare_frames(options, frames);
  options.choice<Kind>("kind", kind, {{"irradiance", Kind::irradiance}, {"radiance", Kind::radiance}},
                       "of records: irradiance for diffuse surfaces, radiance for glossy ones");
  declare_options(options, job.options);
  declare_light_options(options, scene_options);
  declare_options(options, gloss);
  declare_options(options, records);
  declare_place_options(options, job.placement);
  declare_isa(options, isa);
  tool.takes_strict();
  options.example("phos-temporal room.glb --frames 0:199 -o room.irradiance",
                  "200 frames of what the first camera sees");
  options.example("phos-splat room.glb room.irradiance --frames 0:199 -o room/%04d.exr", "their pictures");
  options.example("phos-temporal room.glb --frames 0:199 --kind radiance -o room.radiance",
                  "the same for what is glossy there");

  return tool.run(argc, argv, [&] {
    const FrameRange range = parse_frames(frames);
    const IrradianceFiles files = sort_inputs(paths);
    add_inputs(tool, files, scene_options);
    refuse_inputs(files);
    job.of_radiance = kind == Kind::radiance;
    job.options.resolve(options, records.estimate, job.of_radiance);
    if (tool.up_to_date()) return;

    {
      const auto timer = tool.time("survey");
      job.survey = survey(files.scene, scene_options, range);
    }
    FrameScenes scenes(files.scene, scene_options, isa);
    const std::shared_ptr<const FrameScene> first = scenes.at(range.first);
    tell_losses(tool, first->scene);
    job.light.radiance = radiance_options(records, options);
    job.light.photons.paths = job.options.photons, job.light.seed = tool.seed();
    resolve_film_places(job.placement, first->scene,
                        (job.of_radiance ? job.light.radiance.records : records).accuracy);
    const TypicalDistance typical = typical_distance(first->rays, job.placement, {});
    records.resolve(typical);
    job.light.radiance.records.resolve(typical);
    job.covered_by_radiance = !job.of_radiance && !files.radiance.empty();
    if (!files.radiance.empty()) require_same_film(Container::open(files.radiance, "radiance"), job.survey);
    if (job.of_radiance || job.covered_by_radiance)
      job.gloss = GlossTables(first->scene, lobes_of(files, first->scene), gloss, {}, tool.counters());
    tell_of_film(tool, job);

    Film source;
    if (needs_source(job)) {
      const auto timer = tool.time("source");
      source = make_source(job, scenes, tool.counters());
      tool.stat("source_records", source.records.size());
    }
    const auto timer = tool.time("records");
    const Film* read = needs_source(job) ? &source : nullptr;
    const auto provenance = [&] {
      return tool.provenance(job.of_radiance ? "radiance" : "irradiance", first->scene.hash,
                             first->scene.parts);
    };
    FilmReport report;
    if (!job.survey.light_changes) {
      const std::vector<Key> keys = make_still(job, scenes, read, tool.counters(), report);
      if (job.of_radiance)
        write_radiance(tool.output(), still_radiance(job, keys), provenance());
      else
        write_irradiance(tool.output(), still_irradiance(job, keys), provenance());
    } else {
      EstimateJournal journal(tool.output() + ".journal", provenance().key, options.given("reuse"));
      if (journal.found() > 0)
        tool.say(text(journal.found(), " estimates of an interrupted run are kept; the film goes on"));
      job.journal = &journal;
      const FilmChains made =
          journal.keeping([&] { return make_chains(job, scenes, read, tool.counters()); });
      report = made.report;
      if (job.of_radiance)
        write_film(tool.output(), radiance_film_of(made.chains, info_of(job)), provenance());
      else
        write_film(tool.output(), film_of(made.chains, info_of(job), name_of(records.paths)), provenance());
      journal.finish();
    }
    tell_of_records(tool, job, report);
  });
}
