// Mean and standard error of independent samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace phos {

/// Sums in double of float samples: the squares are exact, and cancellation stays below the error that is
/// asked about.
class Moments {
 public:
  void add(double x) { ++count_, sum_ += x, squares_ += x * x; }
  void merge(const Moments& other) { count_ += other.count_, sum_ += other.sum_, squares_ += other.squares_; }
  std::uint64_t count() const { return count_; }
  double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
  /// Standard deviation of mean(); 0 for fewer than two samples.
  double standard_error() const {
    if (count_ < 2) return 0;
    const auto n = static_cast<double>(count_);
    return std::sqrt(std::max(0.0, (squares_ / n - mean() * mean()) / (n - 1)));
  }
  /// Of a sample; 0 for fewer than two.
  double variance() const { return standard_error() * standard_error() * static_cast<double>(count_); }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0, squares_ = 0;
};

/// Standard error of a mean and its estimated bias in one: the bias as far as it is more than its own noise.
inline double error_with_bias(const Moments& light, const Moments& bias) {
  const double noise = light.standard_error(), doubt = bias.standard_error();
  return std::sqrt(noise * noise + std::max(0.0, bias.mean() * bias.mean() - doubt * doubt));
}

/// Light that is blurred over a radius, with the estimated bias of that.
class Blurred {
 public:
  void add(double light, double bias) { light_.add(light), bias_.add(bias); }
  /// Less the bias, which is no better known than to a half of the light: beside the edge of bright light it
  /// is as large as the light itself. Never below 0 for light that is not.
  double mean() const {
    const double light = light_.mean(), most = 0.5 * std::fabs(light);
    return light - std::clamp(bias_.mean(), -most, most);
  }

 private:
  Moments light_, bias_;
};

}  // namespace phos
