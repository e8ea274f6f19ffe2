// Means over repeats, and how far they are known.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace phos::inline study {

/// A mean with its interval of confidence. lo and hi are not numbers where nothing bounds it.
struct MeanInterval {
  double mean = 0, lo = 0, hi = 0;
  std::size_t n = 0;  ///< values that it is the mean of
  bool bounded() const { return std::islessequal(lo, hi); }
};

/// Mean of values of repeats, normally distributed: W. S. Gosset ("Student") 1908, t of n - 1 degrees of
/// freedom. `common` is the standard error that all of them share (the noise of one reference), which
/// repeats do not show: added in quadrature, as a normal deviation. One value alone is bounded by `common` if
/// that is above 0, else not. No value gives a mean that is no number. `confidence` in (0, 1).
MeanInterval mean_interval(std::span<const double> values, double confidence, double common = 0);

/// The t that a share `confidence` of draws lies within, either side of 0.
double student_t(double confidence, std::size_t degrees);
/// The same of the normal distribution.
double normal_quantile(double confidence);

/// The middle value, or the mean of the two in the middle; not a number for none.
double median(std::span<const double> values);

}  // namespace phos::inline study
