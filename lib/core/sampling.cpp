#include "core/sampling.h"

#include <algorithm>

namespace phos {

namespace {

Vec3 from_spherical(float cos_theta, float phi) {
  const float sin_theta = std::sqrt(std::max(0.f, 1.f - cos_theta * cos_theta));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

}  // namespace

Vec2 sample_disc(const Vec2& u) {
  // Shirley and Chiu 1997: concentric, so that strata stay compact.
  const Vec2 p = 2.f * u - 1.f;
  if (p.x == 0 && p.y == 0) return {0, 0};
  const bool wide = std::fabs(p.x) > std::fabs(p.y);
  const float r = wide ? p.x : p.y;
  const float phi = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = sample_disc(u);
  return {d.x, d.y, std::sqrt(std::max(0.f, 1.f - d.x * d.x - d.y * d.y))};
}

Vec3 sample_uniform_sphere(const Vec2& u) { return from_spherical(1.f - 2.f * u.x, 2 * kPi * u.y); }

Vec3 sample_uniform_cone(const Vec2& u, float cos_max) {
  return from_spherical(1.f - u.x * (1.f - cos_max), 2 * kPi * u.y);
}

Vec3 sample_power_cosine(const Vec2& u, float exponent) {
  return from_spherical(std::pow(1.f - u.x, 1.f / (exponent + 1.f)), 2 * kPi * u.y);
}

Vec2 sample_triangle(const Vec2& u) {
  const float root = std::sqrt(u.x);
  return {1.f - root, u.y * root};
}

}  // namespace phos
