#include "core/half.h"

#include <bit>

#ifdef __F16C__
#include <immintrin.h>
#endif

namespace phos {

#ifdef __F16C__

// The instructions round as the code below does, and neither flushes halves to zero.
Half::Half(float x) : bits(static_cast<std::uint16_t>(_cvtss_sh(x, _MM_FROUND_TO_NEAREST_INT))) {}
Half::operator float() const { return _cvtsh_ss(bits); }

#else

namespace {

constexpr std::uint32_t kInfinite = 0x7f800000u;       // float
constexpr std::uint32_t kOverflow = 0x477ff000u;       // 65520: rounds to infinity
constexpr std::uint32_t kLeastNormal = 0x38800000u;    // 2^-14
constexpr std::uint32_t kRoundsToZero = 0x33000000u;   // 2^-25: half of the least half, and 0 is even
constexpr std::uint32_t kBiases = (127u - 15u) << 23;  // difference of the biases of exponents

/// x / 2^shift, to the nearest number, of two to the even one. shift >= 1.
std::uint32_t rounded_shift(std::uint32_t x, std::uint32_t shift) {
  const std::uint32_t odd = (x >> shift) & 1u;
  return (x + (1u << (shift - 1)) - 1u + odd) >> shift;
}

/// `a`: the bits of a float without its sign.
std::uint32_t half_bits(std::uint32_t a) {
  if (a > kInfinite) return 0x7e00u | ((a >> 13) & 0x3ffu);
  if (a >= kOverflow) return 0x7c00u;
  if (a <= kRoundsToZero) return 0;
  if (a >= kLeastNormal) return rounded_shift(a - kBiases, 13);
  return rounded_shift((a & 0x7fffffu) | 0x800000u, 126u - (a >> 23));
}

}  // namespace

Half::Half(float x) {
  const auto u = std::bit_cast<std::uint32_t>(x);
  bits = static_cast<std::uint16_t>(((u >> 16) & 0x8000u) | half_bits(u & 0x7fffffffu));
}

Half::operator float() const {
  const std::uint32_t sign = (bits & 0x8000u) << 16, exponent = (bits >> 10) & 0x1fu, rest = bits & 0x3ffu;
  if (exponent == 0) {
    const float size = static_cast<float>(rest) * 0x1p-24f;
    return sign != 0 ? -size : size;
  }
  if (exponent == 0x1fu)
    return std::bit_cast<float>(sign | kInfinite | (rest != 0 ? 0x400000u | (rest << 13) : 0u));
  return std::bit_cast<float>(sign | (((bits & 0x7fffu) << 13) + kBiases));
}

#endif

}  // namespace phos
