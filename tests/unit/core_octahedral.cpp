#include "core/octahedral.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace phos {
namespace {

/// All of one row of codes, the corners, and many at random: the same bits as one by one.
TEST(Octahedral, ManyAtOnceAreThoseOneByOne) {
  std::vector<std::uint32_t> codes{0, 0x7fff, 0x8000, 0x8001, 0x7fff0000, 0x80008000, 0x7fff7fff, 0xffffffff};
  for (std::uint32_t x = 0; x < 65536; ++x) codes.push_back(x | (0x2345u << 16));
  for (std::uint64_t i = 0; i < 100000; ++i) {
    codes.push_back(static_cast<std::uint32_t>(RandomStream(3, Stage::test, i).bits()));
  }
  for (const std::size_t n :
       {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{65}, codes.size()}) {
    std::vector<Vec3> unit(n);
    decode_octahedral(std::span(codes).first(n), unit);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 one = decode_octahedral(codes[i]);
      ASSERT_EQ(unit[i], one) << std::hex << codes[i];
      ASSERT_NEAR(glm::length(one), 1, 1e-6f);
    }
  }
}

}  // namespace
}  // namespace phos
