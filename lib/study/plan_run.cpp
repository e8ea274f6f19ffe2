#include "study/plan_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "file/atomic_file.h"

namespace phos {
namespace {

constexpr std::uint64_t kReferenceSeed = 201;
constexpr double kTighter = 0.85;  ///< of the error aimed at, where the same settings would be tried again
constexpr double kLeastSamples = 4;
constexpr double kPixelSamples = 64, kSensorPaths = 16384;  ///< of references, where time allows
constexpr double kClear = 0.7;  ///< of the error asked for: what references should tell from none

class Runner {
 public:
  Runner(const PlanTask& task, const PlanRunOptions& options)
      : task_(task), options_(options), runner_(words(options.common)) {}

  /// Seconds that they took; `samples` of the picture and of sensors are set.
  double make_references(const Pilot& pilot, double error, double seconds) {
    std::error_code failed;
    std::filesystem::create_directories(options_.folder, failed);
    if (failed) throw Error(ExitCode::bad_input, options_.folder, "cannot be made: " + failed.message());
    double took = 0;
    for (const bool lux : {false, true}) {
      if (!(lux ? task_.lux : task_.image)) continue;
      const ReferenceCost& cost = lux ? pilot.lux_reference : pilot.image_reference;
      const double share = seconds / 2 / (task_.lux && task_.image ? 2 : 1);
      const double affordable = (share - cost.fixed_s) / std::max(cost.sample_s * cost.places, 1e-12);
      const double wanted = std::max(cost.samples(error / 2), lux ? kSensorPaths : kPixelSamples);
      if (lux) took += set_out_sensors();
      took += make_pair(lux, std::floor(std::max(std::min(wanted, affordable), kLeastSamples)));
    }
    return took;
  }

  /// Better ones where those that are there do not tell `error` from none and time is left. Seconds that they
  /// took; 0: none.
  double better_references(const PlanRound& round, double error, double seconds) {
    double took = 0;
    for (const bool lux : {false, true}) {
      const std::optional<MeasuredError>& e = lux ? round.lux : round.image;
      const double resolution = e ? e->resolution.value_or(0) : 0;
      if (resolution <= kClear * error) continue;
      // The resolution falls with the root of the samples; the pair before tells what one takes.
      const double times = std::min(std::pow(resolution / (0.5 * error), 2), (seconds - took) / pair_s_[lux]);
      if (times >= 2) took += make_pair(lux, std::floor(samples_[lux] * times));
    }
    return took;
  }

  /// Runs the pipeline; `again`: stages that are there already are kept.
  void run(PlanRound& round, bool again) {
    for (PlanStage& stage :
         plan_stages(task_, round.predicted.knobs, task_.scene, options_.folder, options_.seed)) {
      const bool keyed = stage.command.tool != "phos-sense" && stage.name != "sensor records";
      // What is added to the records of the picture needs them as they were.
      if (again && keyed && !(task_.image && task_.lux && stage.name == "records"))
        stage.command.arguments.push_back("--reuse");
      round.seconds += runner_.require(stage.command).wall_s;
    }
  }

  void measure(PlanRound& round) const {
    if (task_.image) {
      const Image image = read_image(file(kPlanPicture)), a = read_image(reference(false, 0)),
                  b = read_image(reference(false, 1));
      round.image = measure_picture(image, a, &b, {"beauty", true});
      if (image.has_layer("indirect") && a.has_layer("indirect") && round.image->magnitude > 0)
        round.indirect = measure_picture(image, a, &b, {"indirect", true}).rmse / round.image->magnitude;
    }
    if (task_.lux) {
      const std::string some = file("measured-lux.csv");
      write(some, thinned_rows(read_text(file(kPlanLux)), file(kPlanLux), kLuxColumns, kPilotSensors));
      const LuxTable second = read_lux(reference(true, 1));
      round.lux = measure_lux(read_lux(some), read_lux(reference(true, 0)), &second);
      std::filesystem::remove(some);
    }
  }

 private:
  static std::vector<std::string> words(std::vector<std::string> common) {
    common.insert(common.end(), {"--quiet", "--progress", "never"});
    return common;
  }
  static void write(const std::string& path, const std::string& s) {
    AtomicFile out(path);
    out.write(s);
    out.commit();
  }
  std::string file(const std::string& name) const { return options_.folder + "/" + name; }
  std::string reference(bool lux, std::size_t i) const {
    return file(text(lux ? "reference-lux-" : "reference-", i, lux ? ".csv" : ".exr"));
  }
  double set_out_sensors() const {
    PlanTask all = task_;
    if (all.grid.empty()) all.grid = {"--points", task_.points};
    const std::string path = file("reference-sensors.csv");
    const double took = runner_.require(points_command(all, task_.scene, path)).wall_s;
    write(path, thinned_rows(read_text(path), path, kSensorColumns, kPilotSensors));
    return took;
  }
  double make_pair(bool lux, double samples) {
    const auto n = static_cast<std::int64_t>(samples);
    samples_[lux] = samples, pair_s_[lux] = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const Command command =
          lux ? reference_points_command(task_, n, file("reference-sensors.csv"), reference(true, i))
              : reference_picture_command(task_, n, reference(false, i));
      pair_s_[lux] += runner_.require(seeded(command, options_.seed + kReferenceSeed + i)).wall_s;
    }
    return pair_s_[lux];
  }

  const PlanTask task_;
  const PlanRunOptions& options_;
  CommandRunner runner_;
  double samples_[2] = {0, 0}, pair_s_[2] = {0, 0};  ///< of picture and sensors
};

/// What was measured, where the references could tell it, goes into the models.
void learn(Pilot& pilot, const PlanRound& round) {
  const Knobs& knobs = round.predicted.knobs;
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

/// Other settings than those of the last round, for the error that is asked for.
std::optional<Prediction> next_try(const PlanTask& task, const Pilot& pilot, double error,
                                   const PlanRound& last) {
  const std::vector<PlanPoint> front = front_of(task, pilot);
  for (double aim = error; aim > 0.2 * error; aim *= kTighter) {
    const std::optional<Prediction> p = cheapest(task, pilot, front, aim);
    if (p && p->knobs != last.predicted.knobs && p->error() < last.error()) return p;
  }
  return {};
}

std::string verdict(const PlanGoal& goal, const PlanReport& report, const char* why) {
  const PlanRound& last = report.rounds.back();
  const bool dim = last.error() <= report.resolution;  // no more than the references' noise may feign
  std::string out =
      text("error ",
           dim ? text("below ", percent(report.resolution), ", which is all that the references tell")
               : percent(last.error()),
           ", pipeline ", duration(report.pipeline_s), ", references ", duration(report.reference_s));
  if (goal.error) out = text(report.met ? "met: " : "not met: ", out, "; asked for ", percent(*goal.error));
  if (goal.seconds) out += text(goal.error ? " in " : "; asked for ", duration(*goal.seconds));
  if (*why) out += text("; ", why);
  return out;
}

}  // namespace

double PlanRound::error() const {
  return std::max(image ? image->relative_rmse : 0.0, lux ? lux->relative_rmse : 0.0);
}

double PlanRound::resolution() const {
  return std::max(image ? image->resolution.value_or(0) : 0.0, lux ? lux->resolution.value_or(0) : 0.0);
}

void correct(PlanModel& model, const Knobs& knobs, double whole2, double indirect2) {
  for (const bool indirect : {false, true}) {
    const double found = indirect ? indirect2 : std::max(whole2 - indirect2, 0.0);
    std::vector<Posynomial*> parts;
    double predicted = 0, mendable = 0;
    for (auto& [name, p] : model.part) {
      if (name.starts_with("indirect") != indirect) continue;
      parts.push_back(&p);
      predicted += p.best(knobs);
      for (const Monomial& term : p.terms()) mendable += !term.powers.empty();
    }
    for (Posynomial* p : parts) {
      if (found < predicted || mendable == 0) {
        if (predicted > 0) p->scale(std::max(found / predicted, 0.1));
        continue;
      }
      for (std::size_t i = 0; i < p->terms().size(); ++i)
        if (!p->terms()[i].powers.empty())
          p->add(i, (found - predicted) / mendable / p->terms()[i].at(knobs));
    }
  }
}

PlanReport run_plan(const PlanTask& task, Pilot pilot, const PlanGoal& goal, const Plan& plan,
                    const PlanRunOptions& options) {
  Runner runner(task, options);
  PlanReport report;
  const double aim = goal.error.value_or(plan.chosen.error());
  const double most_s = options.reference_seconds > 0
                            ? options.reference_seconds
                            : std::max(kReferenceSeconds, plan.chosen.seconds.value);
  report.reference_s = runner.make_references(pilot, aim, most_s);
  std::optional<Prediction> next = plan.chosen;
  const char* why = "";
  while (next) {
    PlanRound round{*next, 0, {}, {}, 0};
    runner.run(round, !report.rounds.empty());
    runner.measure(round);
    if (const double took = runner.better_references(round, aim, most_s - report.reference_s); took > 0) {
      report.reference_s += took;
      runner.measure(round);
    }
    learn(pilot, round);
    report.pipeline_s += round.seconds;
    report.resolution = round.resolution();
    report.rounds.push_back(round);
    options.say(text("round ", report.rounds.size(), ": error ", percent(round.error()), " (predicted ",
                     percent(next->error()), "), ", duration(round.seconds), " (predicted ",
                     duration(next->seconds.value), ")"));
    next.reset();
    const bool told = !goal.error || round.resolution() <= *goal.error;
    const bool small = goal.error ? round.error() <= *goal.error : report.pipeline_s <= *goal.seconds;
    report.met = told && small;
    if (small && !told) why = "whether it is met cannot be told; raise --reference-seconds";
    if (small || !goal.error) break;
    next = next_try(task, pilot, *goal.error, round);
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
  return report;
}

Json to_json(const PlanReport& report) {
  Json out;
  out["met"] = report.met, out["verdict"] = report.verdict;
  out["pipeline_s"] = report.pipeline_s, out["reference_s"] = report.reference_s;
  out["resolution"] = report.resolution;
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

}  // namespace phos
