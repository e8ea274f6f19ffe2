// Vectors, colours, frames and bounds. Lengths are metres unless a name says otherwise.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace phos {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using DVec3 = glm::dvec3;
/// Photometric RGB: linear Rec.709 components whose luminance() is in lm, lx or cd/m2.
using Rgb = glm::vec3;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Y of linear Rec.709: 0.2126 R + 0.7152 G + 0.0722 B.
inline float luminance(const Rgb& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
inline float max_component(const Vec3& v) { return std::fmax(v.x, std::fmax(v.y, v.z)); }
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector along v; (0,0,0) where v is zero or not finite. Safe for |v| from 1e-30 to 1e30 (scaled
/// first where squares might be lost).
inline Vec3 normalized_or_zero(const Vec3& v) {
  const float d2 = glm::dot(v, v);
  if (d2 > 1e-30f && d2 < 1e30f) return v / std::sqrt(d2);  // no part of d2 is lost
  if (!is_finite(v)) return Vec3(0);
  const float largest = max_component(glm::abs(v));
  if (!(largest > 0)) return Vec3(0);
  const Vec3 scaled = v / largest;
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

/// Orthonormal, right-handed; z is the normal.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 to_local(const Vec3& world) const {
    return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)};
  }
  Vec3 to_world(const Vec3& local) const { return local.x * x + local.y * y + local.z * z; }
};

/// Frame about a unit normal n, continuous except at one pole (Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited"). Undefined for a vector that is not unit.
inline Frame make_frame(const Vec3& n) {
  const float sign = std::copysign(1.f, n.z);
  const float a = -1.f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1.f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// Unit vector in two signed 16-bit numbers (octahedral map; error below 1e-4 rad). Zero vector encodes as
/// +z.
std::uint32_t encode_octahedral(const Vec3& unit);
Vec3 decode_octahedral(std::uint32_t code);

struct Bounds {
  Vec3 lo{kInfinity}, hi{-kInfinity};
  bool empty() const { return !(lo.x <= hi.x); }
  void include(const Vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  Vec3 centre() const { return 0.5f * lo + 0.5f * hi; }
  Vec3 size() const { return empty() ? Vec3(0) : hi - lo; }
  /// Length of the diagonal, m; 0 when empty.
  float diagonal_m() const { return glm::length(size()); }
};

}  // namespace phos
