// What a pipeline costs and how wrong it is, as functions of its settings: sums of powers of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/json.h"
#include "plan/fit.h"

namespace phos::inline plan {

/// The quantities on which the figures of a plan depend. The first are settings; records and pixels follow
/// from them and from the goal.
enum class Knob : std::size_t {
  photons,        ///< paths from the lamps
  accuracy,       ///< a of the records
  rays,           ///< of a record
  pixel_samples,  ///< of a pixel
  edge_samples,   ///< of one in which surfaces meet, in all; made up to whole pairs beside pixel_samples
  light_rays,     ///< shadow rays of a pixel to each area light
  gloss_rays,     ///< of a pixel on a glossy surface
  sensor_rays,    ///< shadow rays of a sensor to each area light
  records,        ///< that lie where they are wanted
  gloss_records,  ///< radiance records beside them, on gloss that the camera sees
  read,           ///< of them, of a place: records_read()
  pixels,         ///< of the picture
  count
};
inline constexpr std::size_t kKnobs = static_cast<std::size_t>(Knob::count);
inline constexpr std::size_t at(Knob knob) { return static_cast<std::size_t>(knob); }
using Knobs = std::array<double, kKnobs>;
const char* name_of(Knob knob);

/// Product of powers of knobs. `what` names it in words.
struct Monomial {
  std::string what;
  std::vector<std::pair<Knob, double>> powers;
  double at(const Knobs& knobs) const;
};

/// A measured value of something at known knobs, within one standard deviation.
struct Observation {
  Knobs knobs{};
  double value = 0, sigma = 1;
};

struct Interval {
  double low = 0, value = 0, high = 0;  ///< the 5th percentile, the mean, the 95th percentile
};

/// Sum of monomials whose coefficients, none negative, are fitted to observations.
class Posynomial {
 public:
  Posynomial() = default;
  explicit Posynomial(std::vector<Monomial> terms) : terms_(std::move(terms)) {}
  void fit(std::span<const Observation> observations, std::uint64_t seed);
  /// To measured noise, of which few places may have most (a ring about a lamp): one that came out low does
  /// not know what it missed. Each is in doubt as all of them are together, relative to the fit's
  /// value, not to itself.
  void fit_noise(std::vector<Observation> observations, std::uint64_t seed);
  /// As if the coefficients had been measured so, without doubt.
  void set(std::vector<double> coefficients);
  /// What a later measurement says, by one guess: a draw, or kBest. All coefficients times `factor`.
  void scale(std::size_t guess, double factor);
  /// With another term, whose coefficient is `factor` times the coefficient of the term called `like`, if
  /// any.
  void extend(const std::string& like, Monomial term, double factor);
  /// That term i is `more` larger than thought.
  void add(std::size_t guess, std::size_t i, double more);

  double best(const Knobs& knobs) const { return value(knobs, kBest); }
  /// By draw `guess` (of kDraws) of the measurements, or by the best guess.
  double value(const Knobs& knobs, std::size_t guess) const;
  const std::vector<Monomial>& terms() const { return terms_; }
  const std::vector<double>& coefficients() const { return fit_.best; }
  /// The value of each term.
  std::vector<double> parts(const Knobs& knobs) const;
  double misfit() const { return fit_.misfit; }
  static constexpr std::size_t kDraws = 200, kBest = kDraws;

 private:
  std::vector<Monomial> terms_;
  Fit fit_;
};

/// A quantity that is a sum of posynomials, each fitted to its own observations: the seconds of all stages,
/// the mean square of all errors.
struct PlanModel {
  std::vector<std::pair<std::string, Posynomial>> part;
  /// The value that was measured of a whole pipeline, which the parts were then made to agree with; 0: none.
  double measured = 0;

  double best(const Knobs& knobs) const;
  /// With the doubt of the fit, and `doubt` (relative standard deviation, by effects that the model itself
  /// leaves out): of the whole, or, after a measurement, of the difference from it.
  Interval predict(const Knobs& knobs, double doubt) const;
  Posynomial* find(const std::string& name);
  const Posynomial* find(const std::string& name) const;
  /// Coefficients, terms and values at `knobs`.
  Json to_json(const Knobs& knobs) const;
};

}  // namespace phos::inline plan
