// Light that is blurred, less its bias.
#include <gtest/gtest.h>

#include "reference/moments.h"

namespace phos::test {
namespace {

TEST(Blurred, TheBiasIsTakenOff) {
  Blurred smooth;
  smooth.add(10, 1), smooth.add(12, 1);
  EXPECT_EQ(smooth.mean(), 10);
}

/// Dark places beside bright light see it all within the whole radius, and next to nothing within the inner.
TEST(Blurred, LightIsNeverNegative) {
  for (const double light : {0.0, 1e-9, 1.0}) {
    Blurred beside;
    for (int i = 0; i < 8; ++i) beside.add(light, 1000);
    EXPECT_GE(beside.mean(), 0);
    EXPECT_EQ(beside.mean(), 0.5 * light);
  }
  Blurred peak;
  peak.add(10, -1000);
  EXPECT_EQ(peak.mean(), 15);
}

}  // namespace
}  // namespace phos::test
