// The programs of a plan in its folder: references, pipeline, measurement.
#pragma once

#include <string>
#include <vector>

#include "plan/reference_doubts.h"
#include "plan/run.h"
#include "study/command.h"

namespace phos::inline plan {

class PlanRunner {
 public:
  /// Keeps a reference to the options.
  PlanRunner(const PlanTask& task, const PlanRunOptions& options);

  /// Makes the folder and a pair of references for each quantity, good enough to tell half of `error` from
  /// none if `seconds` allow. Seconds that they took.
  double make_references(const Pilot& pilot, double error, double seconds);
  /// Better ones where those that are there do not tell `error` from none and time is left. Seconds that they
  /// took; 0: none were made.
  double better_references(const PlanRound& round, double error, double seconds);
  /// Runs the pipeline with the round's settings and adds up its time; `again`: stages that are there already
  /// are kept.
  void run(PlanRound& round, bool again) const;
  /// Why the references that are there are not to be trusted; empty: they are.
  std::vector<std::string> doubts() const;
  /// Fills in the errors.
  void measure(PlanRound& round) const;

 private:
  std::string file(const std::string& name) const;
  std::string reference(bool lux, std::size_t i) const;
  double set_out_sensors() const;
  double make_pair(bool lux, double samples);

  const PlanTask task_;
  const PlanRunOptions& options_;
  CommandRunner runner_;
  double samples_[2] = {0, 0}, pair_s_[2] = {0, 0};  ///< of picture and sensors
  ReferenceDoubts doubts_[2];
};

}  // namespace phos::inline plan
