// A few seconds of small runs that measure the cost and the error of a scene's pipeline.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plan/model.h"
#include "plan/pilot/models.h"
#include "plan/pilot/references.h"
#include "plan/task.h"

namespace phos::inline plan {

/// Figures hold for the whole task, on this machine.
struct Pilot {
  PlanModel time;                                   ///< s, of the pipeline
  std::optional<PlanModel> image_error, lux_error;  ///< mean square, relative
  RecordCount records;                              ///< all that the pipeline makes, but
  RecordCount gloss_records;                        ///< radiance records; none where gloss is traced
  ReferenceCost image_reference, lux_reference;
  std::optional<double> image_resolution, lux_resolution;  ///< least errors that its references can show
  double seconds = 0;                                      ///< that it took
  std::size_t sensors = 0;
  /// Why its references, and so all errors that it foretells, are not to be trusted; empty: they are.
  std::vector<std::string> doubts;
};

struct PilotOptions {
  double seconds = 10;                   ///< it may take, about
  std::optional<double> most_seconds{};  ///< it is given up once it took so long: PilotTooLong is thrown
  double error =
      0.02;  ///< that will be asked for; the references should show half of this error, time permitting
  std::uint64_t seed = 0;
  std::vector<std::string> common;  ///< words for every program: "--threads", "2"
  /// The pilots of these options share them: the first one makes them.
  std::shared_ptr<PilotReferences> references = std::make_shared<PilotReferences>();
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< of each run, when it is done
};

/// A pilot took longer than PilotOptions::most_seconds.
struct PilotTooLong {
  double seconds;
};
/// Runs the pipeline twice each at four settings of photons and records and, with the last of them, six of
/// the picture's samples (eight with gloss), at a size of at most kPilotPixels and for at most
/// kPilotSensors sensors; counts records, and times two pictures (drawn small too, to see what finer pixels
/// show), at the full size; and fits models to the results. Throws Error(bad_input) where no
/// visible place is lit, or a program fails.
Pilot run_pilot(const PlanTask& task, const PilotOptions& options);
/// Photons and records of those runs: each term of indirect light follows another way through them.
/// Sensors read records of accuracies 0.4 and 0.2 alike (reading_accuracy()), so a pilot without a picture
/// goes down to 0.1.
std::vector<Knobs> pilot_caches(bool image);
/// The picture's samples of those runs, all with the last of those caches.
std::vector<Knobs> pilot_pictures(bool gloss);
inline constexpr double kPilotPixels = 4800;
inline constexpr std::size_t kPilotSensors = 64;

/// Columns of a table of sensors: the columns that phos-reference reads, and the measured columns.
inline const std::vector<std::string> kSensorColumns{"x", "y", "z", "nx", "ny", "nz"};
inline const std::vector<std::string> kLuxColumns{"x", "y", "z", "E_lx", "stderr_lx"};

}  // namespace phos::inline plan
