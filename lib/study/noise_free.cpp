#include "study/noise_free.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phos::inline study {

namespace {

double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole > 0 ? part / whole : std::numeric_limits<double>::infinity();
}

}  // namespace

void NoiseFree::add(std::span<const Value> place) {
  double squares = 0, variance = 0;
  for (const Value& v : place) {
    if (!std::isfinite(v.result) || !std::isfinite(v.reference)) return;
    const double d = v.result - v.reference;
    squares += d * d, variance += std::isfinite(v.variance) ? v.variance : 0;
  }
  for (const Value& v : place) {
    const double d = v.result - v.reference, spread2 = std::isfinite(v.spread2) ? v.spread2 : 0;
    const double own = std::isfinite(v.stated) ? v.stated * v.stated : 0;
    magnitude_ += std::fabs(v.reference), stated_squares_ += own;
    if (d * d <= 4 * (own + spread2)) ++inside_;
  }
  const auto n = static_cast<double>(place.size());
  squares_ += squares, variance_ += variance;
  variance2_ += variance / n * variance / n, square_variance_ += squares / n * variance / n;
  ++places_, values_ += place.size();
}

/// Of mean (d^2 - variance) over the places, by the noise of the reference alone. With u the variance of the
/// reference in use (the mean of two: s^2 / 2) it is (4 e^2 u + 4 u^2) / n for two references, and
/// (4 e^2 u + 2 u^2) / n where u is known. Means of d^2 u hold e^2 u + u^2, and squares of one draw of u hold
/// 3 u^2.
double NoiseFree::variance_of_square(double d2v, double v2) const {
  const double u2 = from_ == NoiseFrom::second ? v2 / 3 : v2;
  const double e2u = std::max(0.0, d2v - u2);
  return 4 * e2u + (from_ == NoiseFrom::second ? 4 : 2) * u2;
}

void NoiseFree::finish(MeasuredError& to) const {
  to.places = places_;
  if (places_ == 0) return;
  const auto n = static_cast<double>(places_), values = static_cast<double>(values_);
  to.magnitude = magnitude_ / values;
  to.rmse = std::sqrt(std::max(0.0, squares_ - variance_) / values);
  to.relative_rmse = ratio(to.rmse, to.magnitude);
  to.relative_p99 = ratio(to.p99, to.magnitude);
  if (from_ != NoiseFrom::unknown) {
    to.noise = ratio(std::sqrt(variance_ / values), to.magnitude);
    // sqrt(n) of independent places; the root of two deviations of the mean square at no error.
    const double none = std::sqrt(variance_of_square(0, variance2_ / n) / n);
    to.resolution = ratio(std::sqrt(2 * none), to.magnitude);
    to.bias_stderr = ratio(std::sqrt(variance_ / values / n), to.magnitude);
    const double spread = std::sqrt(variance_of_square(square_variance_ / n, variance2_ / n) / n);
    // d rmse = d (rmse^2) / (2 rmse), and where there is no error, the error that the reference may feign.
    const double feigned = std::sqrt(spread);
    to.rmse_stderr = ratio(to.rmse > feigned ? spread / (2 * to.rmse) : feigned, to.magnitude);
  }
  if (stated_) {
    to.stated = ratio(std::sqrt(stated_squares_ / values), to.magnitude);
    to.inside = static_cast<double>(inside_) / values;
  }
}

}  // namespace phos::inline study
