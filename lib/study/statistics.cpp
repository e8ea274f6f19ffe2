#include "study/statistics.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"

namespace phos::inline study {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double upper(double confidence) {
  PHOS_CHECK(confidence > 0 && confidence < 1, confidence);
  return 0.5 + 0.5 * confidence;
}

}  // namespace

double student_t(double confidence, std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees)), upper(confidence));
}

double normal_quantile(double confidence) {
  return boost::math::quantile(boost::math::normal(), upper(confidence));
}

MeanInterval mean_interval(std::span<const double> values, double confidence, double common) {
  MeanInterval result{kNone, kNone, kNone, values.size()};
  if (values.empty()) return result;
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  result.mean = sum / n;
  for (const double v : values) squares += (v - result.mean) * (v - result.mean);
  double spread = normal_quantile(confidence) * common;
  if (values.size() > 1)
    spread = std::hypot(spread, student_t(confidence, values.size() - 1) * std::sqrt(squares / (n - 1) / n));
  else if (!(common > 0))
    return result;
  result.lo = result.mean - spread, result.hi = result.mean + spread;
  return result;
}

double median(std::span<const double> values) {
  if (values.empty()) return kNone;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

}  // namespace phos::inline study
