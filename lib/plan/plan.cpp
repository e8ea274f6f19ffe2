#include "plan/plan.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "estimate/hemisphere/hemisphere.h"
#include "plan/calibration.h"

namespace phos::inline plan {
namespace {

const std::vector<double> kAccuracies = {calibration::kCoarsestAccuracy, 0.28, 0.2, 0.14, 0.1};
constexpr double kOtherErrors[] = {0.2, 0.1, 0.05, 0.02, 0.01};

std::vector<double> doubling(double first, double last) {
  std::vector<double> out;
  for (double v = first; v <= last * 1.001; v *= 2) out.push_back(v);
  return out;
}

/// Rays of records that are all shot: a hemisphere has whole rings of them, and 48 asked for are the 27 of
/// three rings.
std::vector<double> rays_of_rings(int least, double most) {
  constexpr double kStep = 1.25;
  std::vector<double> out;
  for (int rings = least;; ++rings) {
    const auto rays = static_cast<double>(cells_of(rings));
    if (rays > most) return out;
    if (out.empty() || rays >= kStep * out.back()) out.push_back(rays);
  }
}

/// And the value halfway, where it is whole.
std::vector<double> half_doubling(double first, double last) {
  std::vector<double> out;
  for (const double v : doubling(first, last)) {
    if (const double between = 0.75 * v; between > first && between == std::floor(between))
      out.push_back(between);
    out.push_back(v);
  }
  return out;
}

std::vector<KnobGroup> groups_of(const PlanTask& task, const Pilot& pilot) {
  std::vector<KnobGroup> groups;
  // From half of the pilot's least cache.
  groups.push_back({{Knob::photons}, {half_doubling(10000, 1e8)}});
  const std::vector<double> rays = task.by_photons
                                       ? std::vector<double>{1}
                                       : rays_of_rings(task.lux ? calibration::kSensorRings : 2, 16384);
  KnobGroup records{{Knob::accuracy, Knob::rays}, {kAccuracies, rays}};
  records.derived = {Knob::records, Knob::gloss_records, Knob::read};
  records.derive = [count = pilot.records, gloss = pilot.gloss_records](Knobs& k) {
    k[at(Knob::records)] = count.at(k[at(Knob::accuracy)]);
    k[at(Knob::gloss_records)] = gloss.at(k[at(Knob::accuracy)]);
    k[at(Knob::read)] = records_read(k[at(Knob::accuracy)]);
  };
  groups.push_back(records);
  if (task.image) {
    KnobGroup picture{{Knob::pixel_samples, Knob::edge_samples, Knob::light_rays, Knob::gloss_rays},
                      {doubling(1, 1024), doubling(1, 1024), doubling(1, 4096),
                       task.gloss ? half_doubling(1, 4096) : std::vector<double>{1}}};
    // Each sample of a pixel sends as many rays of a kind, and at least one. (Shadow rays are evenest in
    // powers of two.)
    picture.allowed = [gloss = task.gloss](const Knobs& k) {
      const double s = k[at(Knob::pixel_samples)];
      return k[at(Knob::edge_samples)] >= s && k[at(Knob::light_rays)] >= s &&
             (!gloss || std::fmod(k[at(Knob::gloss_rays)], s) == 0);
    };
    groups.push_back(picture);
  }
  if (task.lux) groups.push_back({{Knob::sensor_rays}, {doubling(4, 65536)}});
  return groups;
}

/// The same settings with more rays from pixels and sensors, as make_plan() promises.
Prediction with_enough_rays(const PlanTask& task, const Pilot& pilot, Prediction p) {
  const double most_s = (1 + calibration::kNextToNothing) * p.seconds.value;
  std::vector<Knob> kinds;
  if (task.image) kinds = {Knob::light_rays, Knob::edge_samples};
  if (task.image && task.gloss) kinds.push_back(Knob::gloss_rays);
  if (task.lux) kinds.push_back(Knob::sensor_rays);
  for (const Knob kind : kinds)
    while (2 * p.knobs[at(kind)] <= calibration::kEnoughRays) {
      Knobs k = p.knobs;
      k[at(kind)] *= 2;
      const Prediction more = predict(task, pilot, k);
      if (more.seconds.value > most_s || more.error() > p.error()) break;
      p = more;
    }
  return p;
}

Interval root(Interval squared) {
  return {std::sqrt(squared.low), std::sqrt(squared.value), std::sqrt(squared.high)};
}

double largest(const Prediction& p, double Interval::*part) {
  return std::max(p.image ? (*p.image).*part : 0.0, p.lux ? (*p.lux).*part : 0.0);
}

/// The part of a mean square that is the same for all settings.
double unmended(const PlanModel& model) {
  double sum = 0;
  for (const auto& [name, p] : model.part)
    for (std::size_t i = 0; i < p.terms().size(); ++i)
      if (p.terms()[i].powers.empty()) sum += p.coefficients()[i];
  return sum;
}

/// The front is by mean squares of best guesses, here without `less` of each: of those that may do, each is
/// predicted with its interval.
template <class Good>
std::optional<Prediction> first_that(const PlanTask& task, const Pilot& pilot,
                                     const std::vector<PlanPoint>& front, double error, const Good& good,
                                     const std::vector<double>& less = {}) {
  for (const PlanPoint& point : front) {
    bool may = true;
    for (std::size_t i = 0; i < point.error.size(); ++i)
      may = may && point.error[i] - (less.empty() ? 0 : less[i]) <= error * error;
    if (!may) continue;
    const Prediction p = predict(task, pilot, point.knobs);
    if (good(p)) return p;
  }
  return {};
}

Prediction within(const PlanTask& task, const Pilot& pilot, const std::vector<PlanPoint>& front,
                  double seconds) {
  std::optional<Prediction> best;
  for (const PlanPoint& point : front) {
    if (point.cost > seconds) break;
    const Prediction p = predict(task, pilot, point.knobs);
    if (p.seconds.high <= seconds && (!best || p.error() < best->error())) best = p;
  }
  if (best) return *best;
  const Prediction least = predict(task, pilot, front.front().knobs);
  throw Error(ExitCode::usage, "--seconds",
              text("no settings keep within ", duration(seconds), ": the cheapest take ",
                   duration(least.seconds.value), " (at most ", duration(least.seconds.high),
                   "); give more, or a smaller picture"));
}

}  // namespace

double Prediction::error() const { return largest(*this, &Interval::value); }
double Prediction::error_high() const { return largest(*this, &Interval::high); }
double Prediction::error_to_meet() const { return error() + calibration::kSurety * (error_high() - error()); }
double Prediction::error_low() const { return largest(*this, &Interval::low); }

std::vector<PlanPoint> front_of(const PlanTask& task, const Pilot& pilot, std::span<const Knob> kept,
                                const Knobs& as) {
  Knobs fixed{};
  fixed.fill(1);
  std::vector<KnobGroup> groups = groups_of(task, pilot);
  std::erase_if(groups, [&](const KnobGroup& group) {
    const bool keep = std::find(kept.begin(), kept.end(), group.knobs.front()) != kept.end();
    for (const auto& list : {group.knobs, group.derived})
      for (const Knob knob : list)
        if (keep) fixed[at(knob)] = as[at(knob)];
    return keep;
  });
  if (task.image) fixed[at(Knob::pixels)] = static_cast<double>(task.width * task.height);
  std::vector<const PlanModel*> errors;
  if (task.image) errors.push_back(&*pilot.image_error);
  if (task.lux) errors.push_back(&*pilot.lux_error);
  return plan_front(groups, fixed, pilot.time, errors);
}

Prediction predict(const PlanTask& task, const Pilot& pilot, const Knobs& knobs) {
  Prediction p;
  p.knobs = knobs;
  p.seconds = pilot.time.predict(knobs, calibration::kTimeDoubt);
  if (task.image) p.image = root(pilot.image_error->predict(knobs, calibration::kErrorDoubt));
  if (task.lux) p.lux = root(pilot.lux_error->predict(knobs, calibration::kErrorDoubt));
  return p;
}

std::optional<Prediction> cheapest(const PlanTask& task, const Pilot& pilot,
                                   const std::vector<PlanPoint>& front, double error, bool* wide) {
  if (wide) *wide = false;
  std::optional<Prediction> found =
      first_that(task, pilot, front, error, [&](const Prediction& p) { return p.error_to_meet() <= error; });
  // Likely to meet it, but at a price that only a pilot's doubt would make one pay: the best guess has to do.
  const auto any = [](const Prediction&) { return true; };
  std::optional<Prediction> guess = first_that(task, pilot, front, calibration::kMargin * error, any);
  if (!guess && !found && predict(task, pilot, front.back().knobs).error_low() <= error) {
    // What no setting mends may be nothing, for all that the pilot can tell.
    std::vector<double> less;
    if (task.image) less.push_back(unmended(*pilot.image_error));
    if (task.lux) less.push_back(unmended(*pilot.lux_error));
    guess = first_that(task, pilot, front, calibration::kMargin * error, any, less);
    const std::optional<Prediction> barely = first_that(task, pilot, front, error, any);
    if (guess && barely && barely->seconds.value <= calibration::kDearest * guess->seconds.value)
      guess = barely;
  }
  if (guess && (!found || found->seconds.value > calibration::kDearest * guess->seconds.value)) {
    found = guess;
    if (wide) *wide = true;
  }
  if (found) found = with_enough_rays(task, pilot, *found);
  return found;
}

Plan make_plan(const PlanTask& task, const Pilot& pilot, const PlanGoal& goal) {
  PHOS_CHECK(goal.error || goal.seconds, "no goal");
  const std::vector<PlanPoint> front = front_of(task, pilot);
  Plan plan;
  if (goal.error) {
    bool wide = false;
    const std::optional<Prediction> found = cheapest(task, pilot, front, *goal.error, &wide);
    if (!found) {
      const Prediction least = predict(task, pilot, front.back().knobs);
      throw Error(
          ExitCode::usage, "--error",
          text(percent(*goal.error), " is out of reach of photons and records here: the least is about ",
               percent(least.error()), " (", percent(least.error_low()), " to ", percent(least.error_high()),
               "), after ", duration(least.seconds.value), "; give a larger error",
               pilot.doubts.empty() ? ", or use phos-reference --error"
                                    : "; the references cannot be trusted either: " + pilot.doubts.front()));
    }
    plan.chosen = *found;
    if (wide)
      plan.warnings.push_back(
          text("the pilot cannot be sure of ", percent(*goal.error), ": the prediction reaches up to ",
               percent(plan.chosen.error_high()),
               "; phos-plan --run measures and corrects, longer --pilot-seconds narrows it"));
    if (goal.seconds && plan.chosen.seconds.value > *goal.seconds) {
      const Prediction other = within(task, pilot, front, *goal.seconds);
      throw Error(
          ExitCode::usage, "--seconds",
          text(percent(*goal.error), " takes about ", duration(plan.chosen.seconds.value), ", not ",
               duration(*goal.seconds), "; in that time the error is about ", percent(other.error())));
    }
  } else {
    plan.chosen = within(task, pilot, front, *goal.seconds);
  }
  const double asked = goal.error.value_or(plan.chosen.error());
  for (const auto& [resolution, name] :
       {std::pair{pilot.image_resolution, "picture"}, {pilot.lux_resolution, "lux"}})
    if (resolution && *resolution > asked)
      plan.warnings.push_back(text("the pilot's references of the ", name, " tell no error below ",
                                   percent(*resolution), " from none, and ", percent(asked),
                                   goal.error ? " is asked for" : " is predicted",
                                   "; longer --pilot-seconds makes better ones"));
  for (const std::string& doubt : pilot.doubts) plan.warnings.push_back("no error is promised: " + doubt);
  for (const double other : kOtherErrors)
    plan.others.emplace_back(other, cheapest(task, pilot, front, other));
  return plan;
}

}  // namespace phos::inline plan
