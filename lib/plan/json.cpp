#include "plan/json.h"

#include "plan/text.h"

namespace phos::inline plan {
namespace {

Json json_of(const Interval& i) {
  Json out;
  out["low"] = i.low, out["value"] = i.value, out["high"] = i.high;
  return out;
}

Json json_of(const Prediction& p, const PlanTask& task) {
  Json out;
  Json& settings = out["settings"];
  for (const Knob knob : {Knob::photons, Knob::accuracy}) settings[name_of(knob)] = p.knobs[at(knob)];
  if (task.cached_gloss) settings["gloss"] = "cached";
  if (task.adaptive_zones()) settings["footprint"] = "adaptive";
  if (!task.by_photons) settings[name_of(Knob::rays)] = p.knobs[at(Knob::rays)];
  if (task.image) {
    for (const Knob knob : {Knob::pixel_samples, Knob::edge_samples, Knob::light_rays})
      settings[name_of(knob)] = p.knobs[at(knob)];
    if (task.gloss) settings[name_of(Knob::gloss_rays)] = p.knobs[at(Knob::gloss_rays)];
  }
  if (task.lux) settings[name_of(Knob::sensor_rays)] = p.knobs[at(Knob::sensor_rays)];
  if (p.seconds.value > 0) out["seconds"] = json_of(p.seconds);
  if (p.image) out["image_error"] = json_of(*p.image);
  if (p.lux) out["lux_error"] = json_of(*p.lux);
  return out;
}

}  // namespace

Json plan_json(const PlanTask& task, const Needs& needs, const Pilot& pilot, const PlanGoal& goal,
               const Plan& plan, std::uint64_t seed) {
  Json out;
  out["scene"] = task.scene;
  Json& asked = out["asked"];
  asked["quantity"] = task.image ? (task.lux ? "both" : "image") : "lux";
  if (task.frames) asked["frames"] = Json::Array{task.frames->first, task.frames->last};
  if (goal.error) asked["error"] = *goal.error;
  if (goal.seconds) asked["seconds"] = *goal.seconds;
  if (task.image) out["size"] = Json::Array{task.width, task.height};
  out["error_means"] = kErrorMeaning;
  out["requires"] = to_json(needs);
  out["plan"] = json_of(plan.chosen, task);
  Json others = Json::Array{};
  for (const auto& [error, p] : plan.others) {
    Json other = p ? json_of(*p, task) : Json(Json::Object{});
    other["error"] = error, other["reachable"] = p.has_value();
    others.push_back(other);
  }
  out["other_errors"] = others;
  Json warnings = Json::Array{};
  for (const std::string& w : plan.warnings) warnings.push_back(w);
  out["warnings"] = warnings;
  out["promised"] = plan.predicted && pilot.doubts.empty();
  Json& ran = out["pilot"];
  ran["seconds"] = pilot.seconds;
  if (plan.predicted) ran["time"] = pilot.time.to_json(plan.chosen.knobs);
  if (pilot.image_error) ran["image_error2"] = pilot.image_error->to_json(plan.chosen.knobs);
  if (pilot.lux_error) ran["lux_error2"] = pilot.lux_error->to_json(plan.chosen.knobs);
  if (pilot.image_resolution) ran["image_resolution"] = *pilot.image_resolution;
  if (pilot.lux_resolution) ran["lux_resolution"] = *pilot.lux_resolution;
  Json stages = Json::Array{};
  for (const PlanStage& stage : plan_stages(task, plan.chosen.knobs, "{scene}", "{folder}", seed)) {
    Json item;
    item["stage"] = stage.name, item["what"] = stage.what, item["tool"] = stage.command.tool;
    Json words = Json::Array{};
    for (const std::string& w : stage.command.arguments) words.push_back(w);
    words.push_back("-o"), words.push_back(stage.command.output);
    item["arguments"] = words;
    stages.push_back(item);
  }
  out["stages"] = stages;
  return out;
}

}  // namespace phos::inline plan
