// The runs of a pilot: files in a folder that goes with it, times, and the differences of two runs of a kind.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plan/pilot/picture_detail.h"
#include "plan/pilot/pilot.h"
#include "plan/reference_doubts.h"
#include "plan/separate.h"
#include "study/command.h"
#include "study/scratch_folder.h"

namespace phos::inline plan {

struct ReferenceRun {
  double seconds = 0;   ///< of one of the pair
  double places = 0;    ///< pixels, sensors
  double variance = 0;  ///< of one, as ReferenceCost has it
  ReferenceDoubts doubts;
};

/// Relative to the mean of the whole.
struct SeparatedLayers {
  Separated whole, indirect;
  /// Light straight from the lamps, and light that is neither direct nor indirect (gloss, mirrors): their
  /// noise alone.
  Separated direct, gloss;
};

class PilotRuns {
 public:
  PilotRuns(const PlanTask& task, const PilotOptions& options);

  /// Makes a pair; the last pair judges. Throws Error(bad_input) where everything is dark.
  ReferenceRun references(bool lux, double samples);
  /// Photons and records, twice.
  void make_caches(const Knobs& knobs);
  /// Two pictures of those caches; `direct`: with all light, else indirect light alone.
  SeparatedLayers pictures(const Knobs& knobs, bool direct);
  SeparatedLayers lux_tables(const Knobs& knobs);
  struct Counted {
    double records = 0, gloss_records = 0;
  };
  /// Records that the whole task takes, at each accuracy.
  std::vector<Counted> count_records(double photons, const std::vector<double>& accuracies, double rays);
  /// The picture that is meant, in its own size, of the last records that were counted, with few and with
  /// more samples of pixels: edges are a smaller share of more pixels. Returns the power, as detail()'s, with
  /// which the part within pixels that the few miss shrinks from the pilot's own size to this one.
  double time_pictures(const Knobs& few, const Knobs& more);

  /// The knobs with the pilot's own number of pixels.
  Knobs sized(Knobs knobs) const;
  /// What was measured of a part of the time model.
  const std::vector<Observation>& times(const std::string& part) { return times_[part]; }
  std::size_t sensors() const { return sensors_; }
  /// Pixels of the whole picture over the pilot's.
  double growth() const { return pixels_of(task_) / pixels_of(small_); }
  /// Of the references' pictures.
  double detail() const { return detail_power(judges_->picture[0], judges_->picture[1]); }

 private:
  static double pixels_of(const PlanTask& task) { return static_cast<double>(task.width * task.height); }
  /// Every program is run here.
  CommandRun require(const Command& command) const;
  CommandRun timed(const std::string& part, const Knobs& knobs, const Command& command);
  /// Splits the time of a program of records, part `part` of the time model: the coarse cache, and the rest
  /// with the records that were made. Returns those.
  double records_run(const std::string& part, Knob count, const Knobs& knobs, const Command& command);
  /// Makes the radiance records of a picture and returns their number; 0 where gloss is traced.
  double gloss_records_run(const PlanTask& task, const Knobs& knobs, const std::string& photons,
                           const GlossFiles& files, std::uint64_t seed);
  /// That go with a file of records.
  GlossFiles gloss_files(const std::string& records) const;
  std::string name(const char* kind, std::size_t which) const;
  void set_out_sensors();
  std::vector<double> lux_of(const std::string& path, const char* column) const;

  const PlanTask task_;
  PlanTask small_;
  PilotOptions options_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  CommandRunner runner_;
  ScratchFolder folder_;
  std::map<std::string, std::vector<Observation>> times_;
  std::map<double, bool> traced_;  ///< photons that are there
  Knobs made_{};                   ///< of the caches
  std::shared_ptr<PilotReferences> judges_;
  std::size_t sensors_ = 0;
};

}  // namespace phos::inline plan
