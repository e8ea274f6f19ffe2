#include "plan/run.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/interrupt.h"
#include "file/folder.h"
#include "file/write_text.h"
#include "plan/calibration.h"
#include "plan/json.h"
#include "plan/runner.h"
#include "plan/text.h"

namespace phos::inline plan {
namespace {

constexpr double kPatience = 4;  ///< times the usual seconds for references, where those cannot judge

/// Makes a guess of these parts say `found`: see correct().
void agree(std::span<Posynomial* const> parts, const Knobs& knobs, std::size_t guess, double found) {
  double predicted = 0, mendable = 0;
  for (const Posynomial* p : parts) {
    predicted += p->value(knobs, guess);
    for (const Monomial& term : p->terms()) mendable += !term.powers.empty();
  }
  for (Posynomial* p : parts) {
    if (found < predicted || mendable == 0) {
      if (predicted > 0) p->scale(guess, std::max(found / predicted, calibration::kLeastShrinking));
      continue;
    }
    for (std::size_t i = 0; i < p->terms().size(); ++i)
      if (!p->terms()[i].powers.empty())
        p->add(guess, i, (found - predicted) / mendable / p->terms()[i].at(knobs));
  }
}

/// Puts measured errors, where the references could show them, into the models, and the times of a pipeline
/// that was run whole.
void learn(Pilot& pilot, const PlanRound& round, bool whole) {
  const Knobs& knobs = round.predicted.knobs;
  if (whole) correct_time(pilot.time, knobs, round.seconds);
  if (round.image && round.image->resolved())
    correct(*pilot.image_error, knobs, std::pow(round.image->relative_rmse, 2),
            round.indirect * round.indirect);
  if (round.lux && round.lux->resolved()) {
    const double found = std::pow(round.lux->relative_rmse, 2);
    double indirect = 0;
    for (const auto& [name, p] : pilot.lux_error->part)
      if (name.starts_with("indirect")) indirect += p.best(knobs);
    correct(*pilot.lux_error, knobs, found,
            found * indirect / std::max(pilot.lux_error->best(knobs), 1e-300));
  }
}

/// Seconds that a pipeline saves where one with the knobs of `there` ran before: by the photons, if they are
/// the same, and by the records. (Records of sensors that are added to a picture's records are made anew: so
/// are these.)
double left_over_s(const PlanTask& task, const Pilot& pilot, const Knobs& there, const Knobs& knobs) {
  const auto same = [&](Knob knob) { return there[at(knob)] == knobs[at(knob)]; };
  const bool photons = same(Knob::photons);
  const bool records = photons && same(Knob::accuracy) && same(Knob::rays) && !(task.image && task.lux);
  const std::pair<const char*, bool> parts[] = {{"photons", photons},
                                                {"lobes", true},
                                                {"coarse records", records},
                                                {"records", records},
                                                {"coarse records, for gloss", records},
                                                {"gloss records", records}};
  double sum = 0;
  for (const auto& [name, left] : parts)
    if (const Posynomial* p = left ? pilot.time.find(name) : nullptr) sum += p->best(knobs);
  return sum;
}

std::string verdict(const PlanGoal& goal, const PlanReport& report, const std::string& why) {
  const PlanRound& last = report.rounds.back();
  const bool dim = last.error() <= report.resolution;  // no more than the references' noise may feign
  std::string out =
      text("error ",
           dim ? text("below ", percent(report.resolution), ", which is all that the references tell")
               : percent(last.error()),
           ", pipeline ", duration(report.pipeline_s),
           report.rounds.size() > 1 ? text(" in ", report.rounds.size(), " rounds") : "", ", references ",
           duration(report.reference_s));
  if (goal.error) out = text(report.met ? "met: " : "not met: ", out, "; asked for ", percent(*goal.error));
  if (goal.seconds) out += text(goal.error ? " in " : "; asked for ", duration(*goal.seconds));
  if (!why.empty()) out += text("; ", why);
  return out;
}

}  // namespace

double PlanRound::error() const {
  return std::max(image ? image->relative_rmse : 0.0, lux ? lux->relative_rmse : 0.0);
}

double PlanRound::resolution() const {
  return std::max(image ? image->resolution.value_or(0) : 0.0, lux ? lux->resolution.value_or(0) : 0.0);
}

bool PlanRound::judged(double asked) const {
  return resolution() <= asked || error() > std::max(resolution(), asked);
}

double times_as_many(const MeasuredError& e, double asked) {
  const double resolution = e.resolution.value_or(0), doubt = calibration::kNear * e.rmse_stderr.value_or(0);
  double times = 1;
  if (resolution > calibration::kClear * asked) times = std::pow(resolution / (0.5 * asked), 2);
  if (std::fabs(e.relative_rmse - asked) < doubt) times = std::max(times, 4.0);
  return times;
}

void correct(PlanModel& model, const Knobs& knobs, double whole2, double indirect2) {
  for (const bool indirect : {false, true}) {
    std::vector<Posynomial*> parts;
    for (auto& [name, p] : model.part)
      if (name.starts_with("indirect") == indirect) parts.push_back(&p);
    const double found = indirect ? indirect2 : std::max(whole2 - indirect2, 0.0);
    for (std::size_t guess = 0; guess <= Posynomial::kBest; ++guess) agree(parts, knobs, guess, found);
  }
  model.measured = whole2;
}

void correct_time(PlanModel& model, const Knobs& knobs, double seconds) {
  for (std::size_t guess = 0; guess <= Posynomial::kBest; ++guess) {
    double predicted = 0;
    for (const auto& [name, p] : model.part) predicted += p.value(knobs, guess);
    for (auto& [name, p] : model.part)
      if (predicted > 0) p.scale(guess, seconds / predicted);
  }
  model.measured = seconds;
}

std::optional<Prediction> next_try(const PlanTask& task, const Pilot& pilot, double error,
                                   std::span<const PlanRound> rounds) {
  const PlanRound& last = rounds.back();
  const Knobs& there = last.predicted.knobs;
  std::vector<std::vector<PlanPoint>> fronts;
  for (const auto& kept : {std::vector<Knob>{}, {Knob::photons}, {Knob::photons, Knob::accuracy}})
    fronts.push_back(front_of(task, pilot, kept, there));
  const double first = error * std::pow(calibration::kTighter, static_cast<double>(rounds.size()));
  for (double aim = first; aim > 0.2 * error; aim *= calibration::kTighter) {
    std::optional<Prediction> best;
    for (const std::vector<PlanPoint>& front : fronts) {
      std::optional<Prediction> p = cheapest(task, pilot, front, aim);
      if (!p || p->knobs == there || !(p->error() < last.error())) continue;
      const double left_s = left_over_s(task, pilot, there, p->knobs);
      for (double* s : {&p->seconds.low, &p->seconds.value, &p->seconds.high})
        *s = std::max(0.0, *s - left_s);
      if (!best || p->seconds.value < best->seconds.value) best = p;
    }
    if (best) return best;
  }
  return {};
}

std::vector<std::string> files_of_run(bool with_sensors) {
  std::vector<std::string> names = {kPlanPhotons, kPlanLobes, kPlanGloss,  kPlanRecords,
                                    kPlanPicture, kPlanLux,   "plan.json", "plan.sh"};
  if (with_sensors) names.push_back(kPlanPoints);
  return names;
}

PlanReport run_plan(const PlanTask& task, const Needs& needs, const Pilot& first, const PlanGoal& goal,
                    const Plan& plan, const PlanRunOptions& options) {
  make_folder(options.folder);
  say_if_interrupted(text("interrupted; the plan as first predicted is in ", options.folder, "/plan.sh"));
  PlanReport report;
  const auto write_plan = [&](const Plan& p) {
    Json json = plan_json(task, needs, first, goal, p, options.seed);
    if (!report.rounds.empty()) json["run"] = to_json(report);
    write_text(options.folder + "/plan.json", json.dump(2) + "\n");
    write_text(options.folder + "/plan.sh",
               plan_script(task, needs, first, goal, p, options.seed, report.verdict));
  };
  write_plan(plan);
  PlanRunner runner(task, options);
  Pilot pilot = first;  // and the results of the rounds
  const double aim = goal.error.value_or(plan.chosen.error());
  const double most_s = options.reference_seconds > 0
                            ? options.reference_seconds
                            : std::max(kReferenceSeconds, plan.chosen.seconds.value);
  report.reference_s = runner.make_references(pilot, aim, most_s);
  std::optional<Prediction> next = plan.chosen;
  std::string why;
  while (next) {
    PlanRound round{*next, 0, {}, {}, 0};
    runner.run(round, !report.rounds.empty());
    runner.measure(round);
    const auto judged = [&] { return !goal.error || (round.judged(*goal.error) && runner.doubts().empty()); };
    const double patience = judged() ? 1 : kPatience;
    const double left_s = patience * most_s - report.reference_s;
    if (const double took = runner.better_references(round, aim, left_s); took > 0) {
      report.reference_s += took;
      runner.measure(round);
    }
    learn(pilot, round, report.rounds.empty());
    report.pipeline_s += round.seconds;
    report.resolution = round.resolution();
    report.rounds.push_back(round);
    options.say(text("round ", report.rounds.size(), ": error ", percent(round.error()), " (predicted ",
                     percent(next->error()), "), ", duration(round.seconds), " (predicted ",
                     duration(next->seconds.value), ")"));
    next.reset();
    const bool small = goal.error ? round.error() <= *goal.error : report.pipeline_s <= *goal.seconds;
    report.met = small && judged();
    if (!judged()) why = "whether it is met cannot be told; raise --reference-seconds";
    report.doubts = runner.doubts();
    if (!report.doubts.empty()) why = report.doubts.front();
    if (!judged() || small || !goal.error) break;
    next = next_try(task, pilot, *goal.error, report.rounds);
    if (!next) {
      why = "no settings are left that would be better";
    } else if (goal.seconds && report.pipeline_s + next->seconds.value > *goal.seconds) {
      why = "the time is spent";
      next.reset();
    } else if (static_cast<int>(report.rounds.size()) >= options.rounds) {
      why = "the rounds are spent";
      next.reset();
    }
  }
  report.verdict = verdict(goal, report, why);
  Plan last = plan;  // whose pictures are in the folder
  last.chosen = report.rounds.back().predicted;
  write_plan(last);
  return report;
}

Json to_json(const PlanReport& report) {
  Json out;
  out["met"] = report.met, out["verdict"] = report.verdict;
  out["pipeline_s"] = report.pipeline_s, out["reference_s"] = report.reference_s;
  out["resolution"] = report.resolution;
  if (!report.doubts.empty()) {
    Json& doubts = out["doubts"] = Json::Array{};
    for (const std::string& line : report.doubts) doubts.push_back(line);
  }
  Json rounds = Json::Array{};
  for (const PlanRound& r : report.rounds) {
    Json round;
    for (std::size_t k = 0; k < static_cast<std::size_t>(Knob::pixels); ++k)
      round["settings"][name_of(static_cast<Knob>(k))] = r.predicted.knobs[k];
    round["predicted_error"] = r.predicted.error(), round["predicted_s"] = r.predicted.seconds.value;
    round["error"] = r.error(), round["seconds"] = r.seconds;
    if (r.image) round["image"] = to_json(*r.image);
    if (r.lux) round["lux"] = to_json(*r.lux);
    rounds.push_back(round);
  }
  out["rounds"] = rounds;
  return out;
}

}  // namespace phos::inline plan
