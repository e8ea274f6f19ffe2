#include "core/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace phos {
namespace {

DVec3 normalized_or_zero(const DVec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : DVec3(0);
}

double root(double x) { return std::sqrt(std::max(0.0, x)); }

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3 corner[3], const Vec3& from) {
  DVec3 to[3];
  for (int i = 0; i < 3; ++i) to[i] = DVec3(corner[i]) - DVec3(from);
  a_ = normalized_or_zero(to[0]), b_ = normalized_or_zero(to[1]);
  const DVec3 c = normalized_or_zero(to[2]);
  const double volume = std::fabs(glm::dot(a_, glm::cross(b_, c)));
  if (!(volume > 0)) return;
  solid_angle_sr_ = 2 * std::atan2(volume, 1 + glm::dot(a_, b_) + glm::dot(b_, c) + glm::dot(c, a_));
  // The angle at a is the angle between the planes through a; the volume is the numerator of its sine.
  const double cosine = glm::dot(glm::cross(a_, b_), glm::cross(a_, c));
  const double length = std::hypot(cosine, volume);
  cos_alpha_ = cosine / length, sin_alpha_ = volume / length, cos_ab_ = glm::dot(a_, b_);
  from_a_to_c_ = normalized_or_zero(c - glm::dot(c, a_) * a_);
  for (int i = 0; i < 3; ++i) side_[i] = glm::cross(to[(i + 1) % 3], to[(i + 2) % 3]);
}

Vec2 SphericalTriangle::sample(const Vec2& u) const {
  // The part of the triangle between a, b and a point c' of the arc from a to c that has u.x of its area.
  const double area = static_cast<double>(u.x) * solid_angle_sr_;
  const double s = std::sin(area) * cos_alpha_ - std::cos(area) * sin_alpha_;
  const double t = std::cos(area) * cos_alpha_ + std::sin(area) * sin_alpha_;
  const double p = t - cos_alpha_, q = s + sin_alpha_ * cos_ab_;
  const double along = (q * t - p * s) * cos_alpha_ - q, all = (q * s + p * t) * sin_alpha_;
  const double cosine = all != 0 ? std::clamp(along / all, -1.0, 1.0) : 1;
  const DVec3 c1 = cosine * a_ + root(1 - cosine * cosine) * from_a_to_c_;
  // From b towards c'.
  const double drop = static_cast<double>(u.y) * (1 - glm::dot(c1, b_));
  const DVec3 d = (1 - drop) * b_ + root(drop * (2 - drop)) * normalized_or_zero(c1 - glm::dot(c1, b_) * b_);
  // Where that line meets the triangle: volumes of the direction with each two corners.
  const double w0 = std::fabs(glm::dot(d, side_[0])), w1 = std::fabs(glm::dot(d, side_[1])),
               w2 = std::fabs(glm::dot(d, side_[2]));
  const double sum = w0 + w1 + w2;
  const auto x = static_cast<float>(w1 / sum);
  return {x, std::min(static_cast<float>(w2 / sum), 1 - x)};
}

SphericalPatch::SphericalPatch(const Vec3 corner[3], const Vec3& from)
    : first_(corner, from), solid_angle_sr_(first_.solid_angle_sr()) {}

SphericalPatch::SphericalPatch(const Vec3 corner[3], const Vec3& opposite, const Vec3& from)
    : first_(corner, from) {
  const Vec3 other[] = {corner[2], corner[1], opposite};
  second_.emplace(other, from);
  solid_angle_sr_ = first_.solid_angle_sr() + second_->solid_angle_sr();
}

SphericalPatch::Place SphericalPatch::sample(const Vec2& u) const {
  if (!second_) return {false, first_.sample(u)};
  const auto share = static_cast<float>(first_.solid_angle_sr() * (1 / solid_angle_sr_));
  const bool second = !(u.x < share);
  const float along = second ? (u.x - share) / (1 - share) : u.x / share;
  return {second, (second ? *second_ : first_).sample({std::clamp(along, 0.f, 1.f), u.y})};
}

}  // namespace phos
