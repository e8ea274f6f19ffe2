// Sums over places for an error without the noise of its reference.
#pragma once

#include <cstddef>
#include <span>

#include "study/measure.h"

namespace phos::inline study {

/// Where the variance of a reference comes from.
enum class NoiseFrom {
  unknown,
  second,  ///< half the difference of two references, squared: right on average, one draw at each place
  stated,  ///< the reference's own standard error
};

class NoiseFree {
 public:
  /// One component at one place.
  struct Value {
    double result = 0, reference = 0;
    double variance = 0;  ///< of the reference
    double stated = 0;    ///< standard error of the result, as it says
    double spread2 = 0;   ///< variance of the reference as best known here, for places within two errors
  };
  NoiseFree(NoiseFrom from, bool stated) : from_(from), stated_(stated) {}
  /// The components of a place. A place with a value that is not finite is passed over.
  void add(std::span<const Value> place);
  /// Fills in places, magnitude, rmse, and the values of the reference and of the result.
  void finish(MeasuredError& to) const;

 private:
  double variance_of_square(double d2v, double v2) const;

  NoiseFrom from_;
  bool stated_;
  std::size_t places_ = 0, values_ = 0, inside_ = 0;
  double magnitude_ = 0, squares_ = 0, variance_ = 0, stated_squares_ = 0;  ///< sums over values
  double variance2_ = 0, square_variance_ = 0;                              ///< sums over places, of means
};

}  // namespace phos::inline study
