#include "core/facts/limit.h"

#include "core/error.h"

namespace phos {
namespace {

/// The exponent, where `number` is a power of `base`; else -1.
int exponent_of(std::int64_t number, std::int64_t base) {
  int exponent = 0;
  for (; number > 1; ++exponent) {
    if (number % base != 0) return -1;
    number /= base;
  }
  return exponent;
}

}  // namespace

std::string written(const Limit& limit) {
  if (const int two = exponent_of(limit.most, 2); two >= 13) return text("2^", two);
  if (const int ten = exponent_of(limit.most, 10); ten >= 5) return text("10^", ten);
  return std::to_string(limit.most);
}

}  // namespace phos
