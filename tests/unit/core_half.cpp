// Half floats against the definition of IEEE 754.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/half.h"
#include "core/parallel.h"
#include "core/random.h"

namespace phos {
namespace {

Half of_bits(unsigned bits) {
  Half h;
  h.bits = static_cast<std::uint16_t>(bits);
  return h;
}

/// By the definition: sign, exponent, fraction.
double defined(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

TEST(Half, EveryFiniteHalfIsItsNumberAndComesBack) {
  set_flush_to_zero();  // as in all programs: halves do not become zero
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    if ((bits >> 10 & 31) == 31) continue;
    const float x = static_cast<float>(of_bits(bits));
    ASSERT_EQ(static_cast<double>(x), defined(bits)) << bits;
    ASSERT_EQ(std::signbit(x), (bits >> 15) != 0) << bits;
    ASSERT_EQ(Half(x).bits, bits);
  }
}

TEST(Half, TakesTheNearestAndOfTwoTheEvenOne) {
  for (unsigned bits = 0; bits < 0x7bff; ++bits) {
    const double low = defined(bits), high = defined(bits + 1), middle = 0.5 * (low + high);
    const auto tie = static_cast<float>(middle);  // exact: 12 bits
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    ASSERT_EQ(Half(tie).bits, even) << bits;
    ASSERT_EQ(Half(-tie).bits, even | 0x8000u) << bits;
    ASSERT_EQ(Half(std::nextafter(tie, 0.f)).bits, bits) << bits;
    ASSERT_EQ(Half(std::nextafter(tie, 1e9f)).bits, bits + 1) << bits;
  }
}

TEST(Half, ErrorsAreAtMostHalfOfTheLastBit) {
  RandomStream random(1, Stage::test, 0);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::exp2(40 * static_cast<double>(random.uniform()) - 25);
    if (x >= 65520) continue;
    const auto f = static_cast<float>(x);
    const double error = std::fabs(static_cast<double>(Half(f)) - static_cast<double>(f));
    ASSERT_LE(error, std::max(std::ldexp(static_cast<double>(f), -11), std::ldexp(1.0, -25))) << x;
  }
}

TEST(Half, Extremes) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(Half(65504.f).bits, 0x7bff);
  EXPECT_EQ(Half(std::nextafter(65520.f, 0.f)).bits, 0x7bff);
  EXPECT_EQ(Half(65520.f).bits, 0x7c00);
  EXPECT_EQ(Half(std::numeric_limits<float>::max()).bits, 0x7c00);
  EXPECT_EQ(static_cast<float>(Half(inf)), inf);
  EXPECT_EQ(static_cast<float>(Half(-inf)), -inf);
  EXPECT_TRUE(std::isnan(static_cast<float>(Half(std::numeric_limits<float>::quiet_NaN()))));
  for (const unsigned bits : {0x7c01u, 0x7e00u, 0xffffu})
    EXPECT_TRUE(std::isnan(static_cast<float>(of_bits(bits)))) << bits;
  EXPECT_EQ(Half(0.f).bits, 0);
  EXPECT_EQ(Half(-0.f).bits, 0x8000);
  EXPECT_EQ(Half(std::numeric_limits<float>::denorm_min()).bits, 0);
  EXPECT_EQ(Half(std::numeric_limits<float>::min()).bits, 0);
}

}  // namespace
}  // namespace phos
