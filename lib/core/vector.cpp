#include "core/vector.h"

#include <algorithm>

namespace phos {

Vec3 normalized_or_zero(const Vec3& v) {
  const float largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return Vec3(0);
  const Vec3 scaled = v / largest;
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

Frame make_frame(const Vec3& n) {
  // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
  const float sign = std::copysign(1.f, n.z);
  const float a = -1.f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1.f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

namespace {

std::uint32_t to_snorm16(float v) {
  const float clamped = std::clamp(v, -1.f, 1.f);
  return static_cast<std::uint32_t>(static_cast<std::uint16_t>(std::lround(clamped * 32767.f)));
}

float from_snorm16(std::uint32_t bits) {
  return std::max(-1.f, static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.f);
}

}  // namespace

std::uint32_t encode_octahedral(const Vec3& n) {
  const float sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  if (!(sum > 0) || !std::isfinite(sum)) return 0;
  float u = n.x / sum;
  float v = n.y / sum;
  if (n.z < 0) {
    const float folded_u = (1.f - std::fabs(v)) * std::copysign(1.f, u);
    v = (1.f - std::fabs(u)) * std::copysign(1.f, v);
    u = folded_u;
  }
  return to_snorm16(u) | (to_snorm16(v) << 16);
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

}  // namespace phos
