// A few seconds of small runs that tell what a scene's pipeline costs and how wrong it is.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/model.h"
#include "plan/task.h"

namespace phos::inline plan {

/// How many records lie where they are wanted, by their accuracy a: odds n / (most - n) of a place to be one
/// that follow a power of a, for a record may serve no less than a pixel or a sensor.
struct RecordCount {
  double count = 0, accuracy = 1;  ///< n at one accuracy
  double power = 0;                ///< n / (most - n) ~ a^-power
  double most = 0;
  double at(double a) const;
};
/// Records that a place reads where they were placed with accuracy a, over as many as placement leaves about
/// it: see reading_accuracy().
double records_read(double a);
/// From n records counted at accuracy a, and `more` at a finer one, where there is room for `most`, but for a
/// quarter more than were counted at least.
RecordCount count_of(double a, double n, double finer, double more, double most);

/// What a reference takes, and how noisy it is.
struct ReferenceCost {
  double fixed_s = 0, sample_s = 0;  ///< of a run; of each sample of each place
  /// Of one sample, relative to the mean squared; root of its mean square over places, so that a few that are
  /// much noisier than the rest count as they should.
  double variance = 0;
  double places = 0;  ///< pixels or sensors of the whole result

  double seconds(double samples) const { return fixed_s + sample_s * samples * places; }
  /// The least relative error that two of them, of so many samples, tell from none: what the noise of both
  /// feigns at two standard deviations (see measure_picture()).
  double resolution(double samples) const;
  /// Samples for a resolution.
  double samples(double resolution) const;
};

/// Figures hold for the whole task, on this machine.
struct Pilot {
  PlanModel time;                                   ///< s, of the pipeline
  std::optional<PlanModel> image_error, lux_error;  ///< mean square, relative
  RecordCount records;                              ///< all that the pipeline makes
  ReferenceCost image_reference, lux_reference;
  std::optional<double> image_resolution, lux_resolution;  ///< what the pilot's own references tell from none
  double seconds = 0;                                      ///< that it took
  std::size_t sensors = 0;
  /// Why its references, and so all errors that it foretells, are not to be trusted; empty: they are.
  std::vector<std::string> doubts;
};

struct PilotOptions {
  double seconds = 10;                   ///< it may take, about
  std::optional<double> most_seconds{};  ///< it is given up once it took so long: PilotTooLong is thrown
  double error =
      0.02;  ///< that will be asked for; the references are made to tell half of it, time permitting
  std::uint64_t seed = 0;
  std::vector<std::string> common;  ///< words for every program: "--threads", "2"
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< of each run, when it is done
};

/// A pilot took longer than PilotOptions::most_seconds.
struct PilotTooLong {
  double seconds;
};
/// Runs the pipeline twice each at four settings of photons and records and, with the last of them, six of
/// the picture's samples (eight with gloss), at a size of at most kPilotPixels and for at most
/// kPilotSensors sensors; counts records, and times two pictures (drawn small too, to see what finer pixels
/// show), at the full size; and fits models to what comes out. Throws Error(bad_input) where nothing that is
/// looked at is lit, or a program fails.
Pilot run_pilot(const PlanTask& task, const PilotOptions& options);
/// Photons and records of those runs: each term of indirect light follows another way through them.
/// Sensors read records of accuracies 0.4 and 0.2 alike (reading_accuracy()), so those of a pilot without a
/// picture go to 0.1.
std::vector<Knobs> pilot_caches(bool image);
/// The picture's samples of those runs, all with the last of those caches.
std::vector<Knobs> pilot_pictures(bool gloss);
inline constexpr double kPilotPixels = 4800;
inline constexpr std::size_t kPilotSensors = 64;

/// Terms of the models.
/// `detail`: power with which what lies within pixels shrinks as there are more of them (detail_power()).
PlanModel image_error_model(const PlanTask& task, double detail);
/// Of `detail`, `sampled` (the same, as pictures of few samples tell it) and `growth` (pixels over the
/// pilot's): where few samples miss more of finer pixels than of the pilot's, with a term that falls as their
/// square, for a texture that pixels nearly resolve is smooth within them (Sponza, 400 wide: 5.3e-3, 8.3e-4
/// with 1 and 4 samples; 92 wide: 7.8e-3, 2.0e-3).
void add_missed_detail(PlanModel& image_error, double detail, double sampled, double growth);
PlanModel lux_error_model(const PlanTask& task = {});
PlanModel time_model(const PlanTask& task);

/// At most `most` rows of a table, evenly from first to last, of those columns alone (of numbers: nothing is
/// quoted).
std::string thinned_rows(const std::string& csv, const std::string& where,
                         const std::vector<std::string>& columns, std::size_t most,
                         std::size_t* rows = nullptr);
/// Columns of a table of sensors: what phos-reference reads, and what is measured.
inline const std::vector<std::string> kSensorColumns{"x", "y", "z", "nx", "ny", "nz"};
inline const std::vector<std::string> kLuxColumns{"x", "y", "z", "E_lx", "stderr_lx"};

}  // namespace phos::inline plan
