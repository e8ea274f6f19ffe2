#include "core/vector.h"
#include "core/octahedral.h"

#include <algorithm>

namespace phos {

namespace {

/// For v in [-1, 1].
std::uint32_t to_snorm16(float v) {
  const float code = v * 32767.f;
  return static_cast<std::uint32_t>(static_cast<int>(code + std::copysign(0.5f, code))) & 0xffffu;
}

float from_snorm16(std::uint32_t bits) {
  return std::max(-1.f, static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.f);
}

}  // namespace

std::uint32_t encode_octahedral(const Vec3& n) {
  const float sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  if (!(sum > 0) || !std::isfinite(sum)) return 0;
  const float u = n.x / sum, v = n.y / sum;
  // Indexed, not branched to: the sign of z is as good as random.
  const float us[2] = {u, std::copysign(1.f - std::fabs(v), u)};
  const float vs[2] = {v, std::copysign(1.f - std::fabs(u), v)};
  const bool below = n.z < 0;
  return to_snorm16(us[below]) | (to_snorm16(vs[below]) << 16);
}

Vec3 decode_octahedral(std::uint32_t code) {
  Vec3 n{from_snorm16(code), from_snorm16(code >> 16), 0};
  n.z = 1.f - std::fabs(n.x) - std::fabs(n.y);
  if (n.z < 0) {
    const float x = n.x;
    n.x = (1.f - std::fabs(n.y)) * std::copysign(1.f, x);
    n.y = (1.f - std::fabs(x)) * std::copysign(1.f, n.y);
  }
  return glm::normalize(n);
}

void decode_octahedral(std::span<const std::uint32_t> codes, std::span<Vec3> unit) {
  constexpr std::size_t kBlock = 64;
  float x[kBlock], y[kBlock], z[kBlock];
  for (std::size_t begin = 0; begin < codes.size(); begin += kBlock) {
    const std::size_t n = std::min(kBlock, codes.size() - begin);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t code = codes[begin + i];
      const float u = from_snorm16(code), v = from_snorm16(code >> 16);
      const float w = 1.f - std::fabs(u) - std::fabs(v);
      const float a = w < 0 ? (1.f - std::fabs(v)) * std::copysign(1.f, u) : u;
      const float b = w < 0 ? (1.f - std::fabs(u)) * std::copysign(1.f, v) : v;
      const float scale = 1.f / std::sqrt(a * a + b * b + w * w);
      x[i] = a * scale, y[i] = b * scale, z[i] = w * scale;
    }
    for (std::size_t i = 0; i < n; ++i) unit[begin + i] = {x[i], y[i], z[i]};
  }
}

}  // namespace phos
