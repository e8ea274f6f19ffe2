// One direction of a basis that hemispherical harmonics are compared with.
#pragma once

#include <vector>

#include "hsh/comparison_bases.h"

namespace phos::test {

inline std::vector<double> values(ComparisonBasis basis, int order, double x, double y, double z) {
  std::vector<double> out(static_cast<std::size_t>(comparison_count(basis, order)));
  evaluate_comparison(basis, order, x, y, z, out.data());
  return out;
}

}  // namespace phos::test
