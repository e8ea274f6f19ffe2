#include "plan/usual.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text/quantity.h"
#include "estimate/hemisphere/hemisphere.h"
#include "plan/calibration.h"

namespace phos::inline plan {
namespace {

namespace c = calibration;

double power_of_two(double v, double least, double most) {
  return std::clamp(std::exp2(std::round(std::log2(v))), least, most);
}

/// Photons of a plan, at most.
constexpr double kMostPhotons = 5e7;

/// The error whose usual settings have that many photons; nothing finer is planned without a pilot.
double least_usual_error() {
  return c::kUsualError * std::pow(c::kUsualPhotons / kMostPhotons, 1 / c::kUsualPhotonsFinerError);
}

/// Rays of whole rings.
double whole_rings(double rays) {
  int rings = 2;
  while (static_cast<double>(cells_of(rings + 1)) <= rays && rings < 64) ++rings;
  return static_cast<double>(cells_of(rings));
}

}  // namespace

Knobs usual_knobs(const PlanTask& task, double error, std::size_t lamps) {
  const double finer = c::kUsualError / error;
  const auto times = [&](double usual, double power) { return usual * std::pow(finer, power); };
  Knobs k{};
  const double photons =
      times(task.by_photons ? c::kUsualPhotonsAlone : c::kUsualPhotons, c::kUsualPhotonsFinerError);
  k[at(Knob::photons)] = std::clamp(std::round(photons / 1e4) * 1e4, 5e4, kMostPhotons);
  k[at(Knob::accuracy)] =
      std::clamp(std::round(100 * times(c::kUsualAccuracy, -c::kUsualAccuracyFinerError)) / 100, 0.1, 0.4);
  k[at(Knob::rays)] = whole_rings(times(c::kUsualRays, c::kUsualRaysFinerError));
  k[at(Knob::read)] = records_read(k[at(Knob::accuracy)]);
  const double samples = error > 0.03 ? 4 : power_of_two(times(4, 1), 4, 64);
  k[at(Knob::pixel_samples)] = samples;
  k[at(Knob::edge_samples)] = power_of_two(times(c::kUsualEdgeSamples, 1), samples, 256);
  k[at(Knob::light_rays)] = power_of_two(times(c::kUsualLightRays, c::kUsualSamplesFinerError) /
                                             std::sqrt(static_cast<double>(std::max<std::size_t>(lamps, 1))),
                                         samples, 4096);
  k[at(Knob::gloss_rays)] =
      task.gloss ? power_of_two(times(c::kUsualGlossRays, c::kUsualSamplesFinerError), samples, 4096) : 1;
  k[at(Knob::sensor_rays)] = power_of_two(times(c::kUsualSensorRays, c::kUsualSamplesFinerError), 16, 65536);
  return k;
}

Plan usual_plan(const PlanTask& task, const PlanGoal& goal, double usual_error, std::size_t lamps,
                const std::string& why) {
  const double error = goal.error.value_or(usual_error);
  if (error < least_usual_error())
    throw Error(
        ExitCode::usage, "--error",
        text(percent(error), " is out of reach of the settings that are planned without a pilot; give ",
             percent(least_usual_error()),
             " or more, or more --pilot-seconds, or use phos-reference --error"));
  Plan plan;
  plan.predicted = false;
  plan.chosen.knobs = usual_knobs(task, error, lamps);
  plan.warnings = {why};
  return plan;
}

PlannedWay plan_or_usual(const PlanTask& task, const PlanGoal& goal, const PlanOptions& plan,
                         const LampCount& lamps, const std::function<Pilot(const PlanTask&)>& pilot,
                         Needs& needs) {
  const auto usual = [&](const std::string& why) {
    PlannedWay way{task, {}, usual_plan(task, goal, plan.usual_error, lamps.lamps, why)};
    way.task.cached_direct = plan.direct == PlanDirect::cached;
    way.task.cached_gloss = plan.gloss == PlanGloss::cached && !needs.held_gloss.empty();
    way.task.adaptive = adaptive_untried(task, plan.footprint, needs);
    if (!needs.held_gloss.empty())
      (way.task.cached_gloss ? needs.wanted : needs.unwanted)
          .push_back(
              {"radiance records",
               text(needs.held_gloss, way.task.cached_gloss ? "" : "; no pilot compares them with rays")});
    return way;
  };
  if (!(plan.pilot_s > 0)) return usual("no pilot was run: the settings are those usual for the error");
  try {
    Needs told = needs;  // of a pilot that ends
    const auto ways = [&](const PlanTask& of_zones, Needs& why) {
      const auto direct = [&](const PlanTask& with) {
        const bool traced = with.cached_gloss || with.frames;
        return plan_direct(with, goal, traced ? PlanDirect::traced : plan.direct, lamps, pilot, why);
      };
      return plan_gloss(of_zones, goal, plan.gloss, direct, why);
    };
    PlannedWay way = plan_footprint(task, goal, plan.footprint, ways, pilot, told);
    needs = std::move(told);
    return way;
  } catch (const PilotTooLong& late) {
    return usual(
        text("the pilot was given up after ", duration(late.seconds),
             ": the settings are those usual for the error; more --pilot-seconds let the pilot end"));
  }
}

}  // namespace phos::inline plan
