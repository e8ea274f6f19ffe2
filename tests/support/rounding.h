// The difference between a kernel, as it is shipped, and the result of long doubles from the same numbers.
#pragma once

#include <glm/glm.hpp>

#include "support/limits.h"

namespace phos::test {

using LVec2 = glm::vec<2, long double>;
using LVec3 = glm::vec<3, long double>;

/// The worst of many.
class Rounding {
 public:
  /// Relative to `unit`: the exact value, or, where terms of either sign are summed, the sum of their sizes.
  void see(double found, long double exact, long double unit) {
    const auto off = static_cast<double>(std::fabs(static_cast<long double>(found) - exact) / unit);
    worst_ = off <= worst_ ? worst_ : std::isfinite(off) ? off : HUGE_VAL;
    ++seen_;
  }
  void see(const glm::vec3& found, const LVec3& exact, long double unit) {
    for (int c = 0; c < 3; ++c) see(static_cast<double>(found[c]), exact[c], unit);
  }
  /// It is a line of the page, and no more than `most`.
  void expect(const std::string& kernel, const std::string& along, double from, double to,
              double most) const {
    EXPECT_GT(seen_, 1000u) << kernel;
    EXPECT_LE(worst_, most) << kernel;
    std::printf("rounding of %s: %.3g, in %zu numbers\n", kernel.c_str(), worst_, seen_);
    expect_limit({"rounding of " + kernel, along, from, to, worst_, "not tested"});
  }

 private:
  double worst_ = 0;
  std::size_t seen_ = 0;
};

}  // namespace phos::test
