// The terms of a pilot's models, and figures that follow from them.
#pragma once

#include <cstddef>
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
  /// The least relative error that two of them, of so many samples, distinguish from none: the error that the
  /// noise of both feigns at two standard deviations (see measure_picture()).
  double resolution(double samples) const;
  /// Samples for a resolution.
  double samples(double resolution) const;
};

/// Terms of the models.
/// `detail`: power with which differences within pixels shrink as there are more pixels (detail_power()).
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

}  // namespace phos::inline plan
