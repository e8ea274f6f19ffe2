#include "core/sampling.h"

#include <algorithm>

namespace phos {

namespace {

/// (cos, sin) for |angle| <= pi/4, where the first terms left out are below half a unit in the last place.
Vec2 cos_sin_of_eighth(float angle) {
  const float x2 = angle * angle;
  const float cosine = 1 + x2 * (-1.f / 2 + x2 * (1.f / 24 + x2 * (-1.f / 720 + x2 * (1.f / 40320))));
  const float sine =
      angle * (1 + x2 * (-1.f / 6 + x2 * (1.f / 120 + x2 * (-1.f / 5040 + x2 * (1.f / 362880)))));
  return {cosine, sine};
}

Vec3 from_spherical(float cos_theta, float turns) {
  const float sin_theta = std::sqrt(std::max(0.f, 1.f - cos_theta * cos_theta));
  return Vec3(sin_theta * cos_sin(turns), cos_theta);
}

}  // namespace

Vec2 cos_sin(float turns) {
  const int quarter = static_cast<int>(4 * turns + 0.5f);
  const Vec2 c = cos_sin_of_eighth(kPi / 2 * (4 * turns - static_cast<float>(quarter)));
  const Vec2 turned = (quarter & 1) != 0 ? Vec2(-c.y, c.x) : c;
  return (quarter & 2) != 0 ? -turned : turned;
}

Vec2 sample_disc(const Vec2& u) {
  // Shirley and Chiu 1997: concentric, so that strata stay compact.
  const Vec2 p = 2.f * u - 1.f;
  if (p.x == 0 && p.y == 0) return {0, 0};
  const bool wide = std::fabs(p.x) > std::fabs(p.y);
  // Indexed, not branched to: a branch would be mispredicted every other time.
  const float ends[2] = {p.y, p.x};
  const float r = ends[wide], other = ends[!wide];
  const Vec2 c = cos_sin_of_eighth(kPi / 4 * (other / r));
  const float d[2] = {r * c.y, r * c.x};
  return {d[wide], d[!wide]};
}

Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = sample_disc(u);
  return {d.x, d.y, std::sqrt(std::max(0.f, 1.f - d.x * d.x - d.y * d.y))};
}

Vec3 sample_uniform_sphere(const Vec2& u) { return from_spherical(1.f - 2.f * u.x, u.y); }

Vec3 sample_uniform_cone(const Vec2& u, float cos_max) {
  return from_spherical(1.f - u.x * (1.f - cos_max), u.y);
}

Vec3 sample_power_cosine(const Vec2& u, float exponent) {
  return from_spherical(std::pow(1.f - u.x, 1.f / (exponent + 1.f)), u.y);
}

Vec2 sample_triangle(const Vec2& u) {
  const float root = std::sqrt(u.x);
  return {1.f - root, u.y * root};
}

Vec2 r2_point(int i, const Vec2& shift) {
  constexpr double kStep[2] = {0.7548776662466927, 0.5698402909980532};
  Vec2 p;
  for (int d = 0; d < 2; ++d) {
    const double x = static_cast<double>(shift[d]) + i * kStep[d];
    p[d] = std::min(static_cast<float>(x - std::floor(x)), kBelowOne);
  }
  return p;
}

Vec2 sobol_point(int i, std::uint32_t shift_x, std::uint32_t shift_y) {
  std::uint32_t x = shift_x, y = shift_y, bit = 1u << 31, column = 1u << 31;
  for (auto rest = static_cast<std::uint32_t>(i); rest != 0; rest >>= 1, bit >>= 1, column ^= column >> 1)
    if (rest & 1u) x ^= bit, y ^= column;
  return Vec2(x >> 8, y >> 8) * 0x1p-24f;
}

float golden_point(int i, std::uint32_t shift) {
  constexpr std::uint32_t kGolden = 0x9e3779b9u;  // 2^32 / golden ratio
  return static_cast<float>((shift + static_cast<std::uint32_t>(i) * kGolden) >> 8) * 0x1p-24f;
}

}  // namespace phos
