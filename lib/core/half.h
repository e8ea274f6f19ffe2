// Half floats (IEEE 754 binary16): 11 bits of precision, from 6e-5 to 65504 with all of these bits.
#pragma once

#include <cstdint>

namespace phos {

/// A half float in a file or an array. Code computes with float.
struct Half {
  std::uint16_t bits = 0;

  Half() = default;
  /// The nearest half, of two the even one. From 65520 on infinite; below 6e-5 in steps of 2^-24.
  explicit Half(float x);
  explicit Half(double x) : Half(static_cast<float>(x)) {}
  /// The number exactly, the same under flushing of denormals to zero.
  explicit operator float() const;
  explicit operator double() const { return static_cast<double>(static_cast<float>(*this)); }
};
static_assert(sizeof(Half) == 2);

}  // namespace phos
