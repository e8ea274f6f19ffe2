#include "plan/task.h"

#include <cmath>

#include "plan/calibration.h"

namespace phos::inline plan {
namespace {

using Words = std::vector<std::string>;

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

Words of_scene(const PlanTask& task, const std::string& scene) {
  Words words{scene};
  add(words, task.scene_words);
  return words;
}

Words view(const PlanTask& task) {
  Words words;
  if (!task.camera.empty()) words = {"--camera", task.camera};
  add(words, {"--width", std::to_string(task.width), "--height", std::to_string(task.height)});
  if (task.frames) add(words, {"--frames", text(task.frames->first, ':', task.frames->last)});
  return words;
}

/// Where the light of records comes from: a file of photons, or of a film photons that phos-temporal traces.
void add_light(Words& words, const PlanTask& task, const Knobs& k, const std::string& photons) {
  if (task.frames)
    add(words,
        {"--photons", knob_word(k, Knob::photons), "--temporal-accuracy", shortest(task.temporal_accuracy)});
  else
    words.push_back(photons);
}

Words estimated(const PlanTask& task, const Knobs& k) {
  const Words accuracy{"--accuracy", knob_word(k, Knob::accuracy)};
  Words words{"--estimate", task.by_photons ? "hull" : "gather"};
  add(words, accuracy);
  if (!task.by_photons) add(words, {"--rays", knob_word(k, Knob::rays)});
  return words;
}

}  // namespace

std::string knob_word(const Knobs& knobs, Knob knob) {
  const double v = knobs[at(knob)];
  return knob == Knob::accuracy ? shortest(v) : std::to_string(std::llround(v));
}

Command seeded(Command command, std::uint64_t seed) {
  if (seed != 0) add(command.arguments, {"--seed", std::to_string(seed)});
  return command;
}

Command photons_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                        const std::string& out) {
  Words words = of_scene(task, scene);
  add(words, {"--photons", knob_word(knobs, Knob::photons)});
  return {"phos-photons", words, out};
}

Command lobes_command(const PlanTask& task, const std::string& scene, const std::string& out) {
  return {"phos-brdf", of_scene(task, scene), out};
}

Command gloss_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                              const std::string& photons, const GlossFiles& files) {
  Words words = of_scene(task, scene);
  words.push_back(files.lobes);
  add_light(words, task, knobs, photons);
  add(words, {"--place", "view"});
  add(words, view(task));
  add(words, estimated(task, knobs));
  if (task.pixels_of_final < 1)
    add(words, {"--min-radius-pixels", shortest(task.pixels_of_final / knobs[at(Knob::accuracy)])});
  if (task.frames) add(words, {"--kind", "radiance"});
  return {task.frames ? "phos-temporal" : "phos-radiance", words, files.records};
}

Command view_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                             const std::string& photons, const std::string& out, const GlossFiles& gloss) {
  Words words = of_scene(task, scene);
  if (!gloss.empty()) add(words, {gloss.records, gloss.lobes});
  add_light(words, task, knobs, photons);
  add(words, {"--place", "view"});
  add(words, view(task));
  add(words, estimated(task, knobs));
  if (task.cached_direct) add(words, {"--direct", "cached"});
  if (task.adaptive_zones()) add(words, {"--footprint", "adaptive"});
  if (!task.cached_direct && task.typical_m > 0)
    add(words,
        {"--min-radius", shortest(static_cast<float>(calibration::kLeastRadius * knobs[at(Knob::accuracy)]) *
                                  task.typical_m)});
  if (task.pixels_of_final < 1)
    add(words, {"--min-radius-pixels", shortest(task.pixels_of_final / knobs[at(Knob::accuracy)])});
  return {task.frames ? "phos-temporal" : "phos-irradiance", words, out};
}

Command sensor_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                               const std::string& photons, const std::string& points,
                               const std::string& add_to, const std::string& out) {
  Words words = of_scene(task, scene);
  add(words, {photons});
  // Photons tell nothing in free air: records of them lie on surfaces, and phos-sense makes those in the air.
  if (!task.by_photons) add(words, {"--at", points, "--place", "given"});
  if (add_to.empty())
    add(words, estimated(task, knobs));  // else the file's options hold
  else
    add(words, {"--add-to", add_to});
  return {"phos-irradiance", words, out};
}

namespace {

Command drawn(const PlanTask& task, const Knobs& knobs, const std::string& scene, const std::string& cache,
              const GlossFiles& gloss, const Words& light, const std::string& out) {
  Words words = of_scene(task, scene);
  words.push_back(cache);
  if (!gloss.empty()) add(words, {gloss.records, gloss.lobes});
  add(words, view(task));
  const std::int64_t samples = std::llround(knobs[at(Knob::pixel_samples)]),
                     asked = std::llround(knobs[at(Knob::edge_samples)]) - samples;
  const std::int64_t more = asked + asked % 2;  // in pairs about the pixel's centre
  add(words, {"--pixel-samples", std::to_string(samples)});
  if (more > 0) add(words, {"--edge-samples", std::to_string(more)});
  add(words, light);
  if (task.adaptive_zones()) add(words, {"--splat", "cpu"});  // the faster one for footprints
  return {"phos-splat", words, out};
}

}  // namespace

Command picture_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                        const std::string& cache, const std::string& out, const GlossFiles& gloss) {
  Words light{"--direct", "interleaved", "--light-samples", knob_word(knobs, Knob::light_rays)};
  if (task.gloss) add(light, {"--gloss-samples", knob_word(knobs, Knob::gloss_rays)});
  return drawn(task, knobs, scene, cache, gloss, light, out);
}

Command indirect_picture_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                                 const std::string& cache, const std::string& out, const GlossFiles& gloss) {
  return drawn(task, knobs, scene, cache, gloss,
               {"--direct", "none", "--gloss-samples", "0", "--layers", "indirect"}, out);
}

Command sense_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                      const std::string& cache, const std::string& points, const std::string& out) {
  Words words = of_scene(task, scene);
  add(words, {cache, "--points", points, "--light-samples", knob_word(knobs, Knob::sensor_rays)});
  return {"phos-sense", words, out};
}

Command points_command(const PlanTask& task, const std::string& scene, const std::string& out) {
  Words words = of_scene(task, scene);
  add(words, {"--direct-only", "--light-samples", "1"});
  add(words, task.grid);
  return {"phos-sense", words, out};
}

Command reference_picture_command(const PlanTask& task, std::int64_t samples, const std::string& out) {
  Words words = of_scene(task, task.scene);
  add(words, view(task));
  add(words, {"--samples", std::to_string(samples), "--adaptive"});
  return {"phos-reference", words, out};
}

Command reference_points_command(const PlanTask& task, std::int64_t samples, const std::string& points,
                                 const std::string& out) {
  Words words = of_scene(task, task.scene);
  add(words, {"--points", points, "--samples", std::to_string(samples), "--method", "auto"});
  return {"phos-reference", words, out};
}

std::vector<PlanStage> plan_stages(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                                   const std::string& folder, std::uint64_t seed) {
  const auto file = [&](const char* name) { return folder + "/" + name; };
  std::vector<PlanStage> stages;
  const auto stage = [&](const char* name, const std::string& what, Command command) {
    stages.push_back({name, what, seeded(std::move(command), seed)});
  };
  const std::string photons = file(kPlanPhotons), records = file(kPlanRecords);
  const std::string points = task.grid.empty() ? task.points : file(kPlanPoints);
  if (task.lux && !task.grid.empty())
    stage("sensors", "where the sensors are", points_command(task, scene, points));
  if (!task.frames)
    stage("photons", "light from the lamps, and a tree over it",
          photons_command(task, knobs, scene, photons));
  GlossFiles gloss;
  if (task.cached_gloss) {
    gloss = {file(kPlanLobes), file(kPlanGloss)};
    stage("lobes", "how glossy surfaces reflect, as harmonics", lobes_command(task, scene, gloss.lobes));
    stage("gloss records", "light from every direction, on the gloss that the camera sees",
          gloss_records_command(task, knobs, scene, photons, gloss));
  }
  const char* zones = task.adaptive ? "; the zones of the records are adaptive" : "";
  if (task.image)
    stage(
        "records",
        text(
            task.frames ? "indirect light where the camera looks, in records that live through the frames"
            : task.cached_direct
                ? "light where the camera looks: from the lamps, and by rays that read a coarse cache of the "
                  "photons"
            : task.by_photons
                ? "indirect light where the camera looks, of the photons there"
                : "indirect light where the camera looks, by rays that read a coarse cache of the photons",
            zones),
        view_records_command(task, knobs, scene, photons, records, gloss));
  if (task.lux)
    stage(task.image ? "sensor records" : "records", "indirect light where the sensors are",
          sensor_records_command(task, knobs, scene, photons, points, task.image ? records : "", records));
  if (task.image)
    stage(
        "picture",
        task.cached_direct  ? "records drawn, what mirrors and gloss show by rays"
        : task.cached_gloss ? "records drawn, direct light and what mirrors and sharp gloss show by rays"
                            : "records drawn, direct light and what mirrors and gloss show by rays",
        picture_command(task, knobs, scene, records, file(task.frames ? kPlanFrames : kPlanPicture), gloss));
  if (task.lux)
    stage("lux", "direct light by rays, indirect light from the records",
          sense_command(task, knobs, scene, records, points, file(kPlanLux)));
  return stages;
}

}  // namespace phos::inline plan
