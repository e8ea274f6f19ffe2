#include "plan/runner.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/write_text.h"
#include "study/measure_lux.h"

namespace phos::inline plan {
namespace {

constexpr std::uint64_t kReferenceSeed = 201;
constexpr double kLeastSamples = 4;
constexpr double kForBright = 4;  ///< times as many, where too few bright paths make their light
constexpr double kPixelSamples = 64, kSensorPaths = 16384;  ///< of references, where time allows

std::vector<std::string> words(std::vector<std::string> common) {
  common.insert(common.end(), {"--quiet", "--progress", "never"});
  return common;
}

}  // namespace

PlanRunner::PlanRunner(const PlanTask& task, const PlanRunOptions& options)
    : task_(task), options_(options), runner_(words(options.common)) {}

/// Seconds that they took; `samples` of the picture and of sensors are set.
double PlanRunner::make_references(const Pilot& pilot, double error, double seconds) {
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

/// Better ones where more samples are wanted (times_as_many()) and time is left. Seconds that they took; 0:
/// none.
double PlanRunner::better_references(const PlanRound& round, double error, double seconds) {
  double took = 0;
  for (const bool lux : {false, true}) {
    const std::optional<MeasuredError>& e = lux ? round.lux : round.image;
    if (!e) continue;
    // The pair before gives the time of a sample.
    const double wanted = std::max(times_as_many(*e, error), doubts_[lux].too_few_bright() ? kForBright : 1);
    const double times = std::min(wanted, (seconds - took) / pair_s_[lux]);
    if (times >= 2) took += make_pair(lux, std::floor(samples_[lux] * times));
  }
  return took;
}

/// Runs the pipeline; `again`: stages that are there already are kept.
void PlanRunner::run(PlanRound& round, bool again) const {
  for (PlanStage& stage :
       plan_stages(task_, round.predicted.knobs, task_.scene, options_.folder, options_.seed)) {
    const bool keyed = stage.command.tool != "phos-sense" && stage.name != "sensor records";
    // What is added to the records of the picture needs them as they were.
    if (again && keyed && !(task_.image && task_.lux && stage.name == "records"))
      stage.command.arguments.push_back("--reuse");
    round.seconds += runner_.require(stage.command).wall_s;
  }
}

void PlanRunner::measure(PlanRound& round) const {
  if (task_.image) {
    const Image image = read_image(file(kPlanPicture)), a = read_image(reference(false, 0)),
                b = read_image(reference(false, 1));
    round.image = measure_picture(image, a, &b, {"beauty", true});
    if (task_.records_hold_more())
      round.indirect = round.image->magnitude > 0 ? round.image->rmse / round.image->magnitude : 0;
    else if (image.has_layer("indirect") && a.has_layer("indirect") && round.image->magnitude > 0)
      round.indirect = measure_picture(image, a, &b, {"indirect", true}).rmse / round.image->magnitude;
  }
  if (task_.lux) {
    const std::string some = file("measured-lux.csv");
    write_text(some, thinned_rows(read_text(file(kPlanLux)), file(kPlanLux), kLuxColumns, kPilotSensors));
    const LuxTable second = read_lux(reference(true, 1));
    round.lux = measure_lux(read_lux(some), read_lux(reference(true, 0)), &second);
    std::filesystem::remove(some);
  }
}

std::vector<std::string> PlanRunner::doubts() const {
  std::vector<std::string> all;
  for (const ReferenceDoubts& of_kind : doubts_)
    for (const std::string& line : of_kind.lines()) all.push_back(line);
  return all;
}

std::string PlanRunner::file(const std::string& name) const { return options_.folder + "/" + name; }
std::string PlanRunner::reference(bool lux, std::size_t i) const {
  return file(text(lux ? "reference-lux-" : "reference-", i, lux ? ".csv" : ".exr"));
}
double PlanRunner::set_out_sensors() const {
  PlanTask all = task_;
  if (all.grid.empty()) all.grid = {"--points", task_.points};
  const std::string path = file("reference-sensors.csv");
  const double took = runner_.require(points_command(all, task_.scene, path)).wall_s;
  write_text(path, thinned_rows(read_text(path), path, kSensorColumns, kPilotSensors));
  return took;
}
double PlanRunner::make_pair(bool lux, double samples) {
  const auto n = static_cast<std::int64_t>(samples);
  samples_[lux] = samples, pair_s_[lux] = 0, doubts_[lux] = {};
  const double places =
      lux ? static_cast<double>(kPilotSensors) : static_cast<double>(task_.width * task_.height);
  for (std::size_t i = 0; i < 2; ++i) {
    const Command command =
        lux ? reference_points_command(task_, n, file("reference-sensors.csv"), reference(true, i))
            : reference_picture_command(task_, n, reference(false, i));
    const CommandRun run = runner_.require(seeded(command, options_.seed + kReferenceSeed + i));
    pair_s_[lux] += run.wall_s;
    doubts_[lux].add(run.stats, places);
  }
  return pair_s_[lux];
}

}  // namespace phos::inline plan
