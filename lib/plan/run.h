// A plan carried out, measured, and corrected until it is met.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "study/measure.h"

namespace phos::inline plan {

struct PlanRunOptions {
  std::string folder;  ///< where the files go; made if it is missing
  std::uint64_t seed = 0;
  std::vector<std::string> common;  ///< words for every program
  double reference_seconds =
      0;  ///< that the two references may take; 0: as long as the pipeline, but kReferenceSeconds at least.
          ///< Where they cannot judge a round, better ones may take up to three times as long again.
  int rounds = 5;  ///< at most
  std::function<void(const std::string&)> say = [](const std::string&) {};
};
inline constexpr double kReferenceSeconds = 60;

struct PlanRound {
  Prediction predicted;
  double seconds = 0;  ///< that the pipeline took, without files of an earlier round
  std::optional<MeasuredError> image, lux;
  double indirect =
      0;  ///< mean square root of the picture's indirect light's error, over the mean of the whole
  double error() const;       ///< the larger one
  double resolution() const;  ///< the larger of the errors that the references distinguish from none
  /// Can the references tell whether the error is at most `asked`? Coarse ones tell at most that it is more.
  bool judged(double asked) const;
};

struct PlanReport {
  std::vector<PlanRound> rounds;
  double pipeline_s = 0, reference_s = 0;
  double resolution = 0;  ///< the least error that the references tell from none
  bool met = false;
  std::string verdict;              ///< in a line
  std::vector<std::string> doubts;  ///< why the references of the last round are not to be trusted, if so
};

/// Names of the files that run_plan() writes for keeping; with the sensors, where the plan makes them itself.
std::vector<std::string> files_of_run(bool with_sensors);

/// Makes two references (their time is stated apart), then runs the pipeline of `plan` in the folder. Where
/// its error is more than was asked for, the parts of the pilot's model are scaled to the measured errors,
/// and the settings chosen anew, until the error is met, the seconds of the goal are spent, or nothing better
/// can be had. The files of the last round stay. plan.sh and plan.json are there from the start, as
/// predicted, and at the end as measured; interrupted, the first ones stay, and the tool says so.
PlanReport run_plan(const PlanTask& task, const Needs& needs, const Pilot& pilot, const PlanGoal& goal,
                    const Plan& plan, const PlanRunOptions& options);

/// The factor on the samples of the references, with whose root their resolution falls:
/// so that they show half of the error asked for, where they do not nearly; four times where the measured one
/// is within three standard errors of it, so that it is not their noise that calls a round met or missed; 1:
/// they will do.
double times_as_many(const MeasuredError& measured, double asked);

/// Corrects the model of errors by a measurement, for direct and for indirect light apart, both mean squares
/// relative: every guess of the model, the best and each draw of its measurements, is made to say the same at
/// those settings, so that the next prediction doubts only the difference from them. Where less was found,
/// all terms of the part shrink, to a tenth at most. Where more was found, nothing says which term it comes
/// from: each that a setting mends is raised by as much, so that whichever it is, better settings are chosen
/// for it.
void correct(PlanModel& model, const Knobs& knobs, double whole2, double indirect2);

/// The same of the model of times: all parts are scaled to `seconds`, which the whole pipeline took.
void correct_time(PlanModel& model, const Knobs& knobs, double seconds);

/// Other settings than in the last round, for less than the error that is asked for, and for still less
/// after each further miss: no measurement tells which term was too low. Those that take least where photons,
/// and perhaps records, of the last round are there already; `seconds` are without these. Nothing: none are
/// better.
std::optional<Prediction> next_try(const PlanTask& task, const Pilot& pilot, double error,
                                   std::span<const PlanRound> rounds);

Json to_json(const PlanReport& report);

}  // namespace phos::inline plan
