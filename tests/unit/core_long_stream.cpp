// A random stream that is asked for more than 65,536 blocks: many shadow rays of a pixel, many lamps of a
// sensor.
#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace phos {
namespace {

TEST(RandomStream, GoesOnBeyond65536Blocks) {
  constexpr int kNumbers = 4 * 65536;
  RandomStream stream(7, Stage::test, 3);
  std::vector<std::uint32_t> first;
  for (int i = 0; i < kNumbers; ++i) {
    const std::uint32_t bits = stream.bits();
    if (i < 64) first.push_back(bits);
  }
  std::vector<std::uint32_t> later;
  double sum = 0;
  for (int i = 0; i < kNumbers; ++i) {
    const std::uint32_t bits = stream.bits();
    if (i < 64) later.push_back(bits);
    sum += static_cast<double>(bits) * 0x1p-32;
  }
  EXPECT_NE(first, later);                             // they are new ones
  EXPECT_NEAR(sum / kNumbers, 0.5, 4 * 0.2887 / 512);  // four standard errors
  // Nor those of another stage, item or bounce.
  for (const Stage stage : {Stage::emission, Stage::mirror_image, Stage::through_portal}) {
    RandomStream other(7, stage, 3);
    std::vector<std::uint32_t> theirs(64);
    for (std::uint32_t& v : theirs) v = other.bits();
    EXPECT_NE(theirs, later);
  }
}

}  // namespace
}  // namespace phos
