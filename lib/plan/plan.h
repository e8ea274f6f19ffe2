// The settings that meet the goal, by the models of a pilot.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/text/quantity.h"
#include "plan/choose.h"
#include "plan/pilot/pilot.h"
#include "plan/requirements.h"
#include "plan/task.h"

namespace phos::inline plan {

/// At least one of them.
struct PlanGoal {
  std::optional<double> error;    ///< relative, at most
  std::optional<double> seconds;  ///< of the pipeline, at most
};

struct Prediction {
  Knobs knobs{};
  Interval seconds;
  std::optional<Interval> image, lux;  ///< relative error
  /// The larger of the errors, best guess.
  double error() const;
  double error_high() const;
  /// What has to be within the error that is asked for: kSurety of the way from the best guess to the top of
  /// its interval.
  double error_to_meet() const;
  double error_low() const;
};

struct Plan {
  bool predicted = true;  ///< false: settings alone, of no pilot
  Prediction chosen;
  std::vector<std::pair<double, std::optional<Prediction>>>
      others;  ///< the cheapest for other errors; none: out of reach
  std::vector<std::string> warnings;
};

/// The choices that no other beats, cheapest first. Of those with the `kept` knobs as they are in `as`, if
/// any are given; knobs that are chosen together are kept together.
std::vector<PlanPoint> front_of(const PlanTask& task, const Pilot& pilot, std::span<const Knob> kept = {},
                                const Knobs& as = {});
Prediction predict(const PlanTask& task, const Pilot& pilot, const Knobs& knobs);

/// With an error asked for: the cheapest settings whose error_to_meet() is within it: some miss it, which
/// another round of --run mends. (Seconds go as the error to a power of -2 or so, and another round costs as
/// much again: least are expected about 1.4 standard deviations below the goal.) Where there are none,
/// or only at a price that its doubt alone would make one pay, because the pilot cannot tell so little: the
/// cheapest that meet kMargin of the error by the best guess, or, if that is not out of the question, by the
/// guess without the part that no setting mends (or, if that is not much dearer, the whole error by the best
/// guess); and a warning. Pictures of few rays have rare bright pixels, which a small pilot seldom shows:
/// these settings then get more rays from pixels and sensors, up to kEnoughRays of a kind, as far as
/// kNextToNothing of the time pays for all of them. (These numbers: plan/calibration.h.) With seconds: the
/// least error whose time is within them in the same sense. Throws Error(usage) where no settings reach the
/// error or keep the time, naming the error or the time that can be had.
Plan make_plan(const PlanTask& task, const Pilot& pilot, const PlanGoal& goal);

/// The same for an error alone; nothing if it is out of reach. `wide`: set where kMargin had to do.
std::optional<Prediction> cheapest(const PlanTask& task, const Pilot& pilot,
                                   const std::vector<PlanPoint>& front, double error, bool* wide = nullptr);

}  // namespace phos::inline plan
