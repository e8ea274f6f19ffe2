// Mean and standard error of independent samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace phos::inline reference {

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

/// A standard error and an estimated bias in one: the bias as far as it is more than its own noise.
inline double with_bias(double standard_error, const Moments& bias) {
  const double doubt = bias.standard_error();
  return std::sqrt(standard_error * standard_error +
                   std::max(0.0, bias.mean() * bias.mean() - doubt * doubt));
}

}  // namespace phos::inline reference
