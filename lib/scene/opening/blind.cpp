#include "scene/opening/blind.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace phos::inline scene {
namespace {

constexpr double kLeastHeight = 1e-3;  // of a place before the slats, of their length

/// Integral of du / (a2 + u^2)^1.5 from 0.
double along_to(double a2, double u) { return u / (a2 * std::sqrt(a2 + u * u)); }

double along(const Blind::Gap& gap, double v) {
  const double a2 = 1 + v * v;
  return along_to(a2, gap.u[1]) - along_to(a2, gap.u[0]);
}

}  // namespace

double Blind::Gap::solid_angle_sr() const { return (v[1] - v[0]) * along(*this, 0.5 * (v[0] + v[1])); }

Blind::Blind(Slats slats) : slats_(std::move(slats)) {
  PHOS_CHECK(slats_.end.size() >= 2 && slats_.end.back() == slats_.corner.size(), slats_.end.size(),
             " slats");
  for (int c = 0; c < 2; ++c) {
    lo_m_[c] = std::numeric_limits<double>::infinity(), hi_m_[c] = -lo_m_[c];
    for (const DVec3& p : slats_.corner)
      lo_m_[c] = std::min(lo_m_[c], p[c + 1]), hi_m_[c] = std::max(hi_m_[c], p[c + 1]);
  }
}

void Blind::gaps_from(const Vec3& place, std::vector<Gap>& gaps) const {
  const DVec3 way = DVec3(place) - slats_.origin;
  const DVec3 p(glm::dot(way, DVec3(slats_.frame.x)), glm::dot(way, DVec3(slats_.frame.y)),
                glm::dot(way, DVec3(slats_.frame.z)));
  const double least_m = kLeastHeight * (slats_.to_m - slats_.from_m);
  const bool towards_z = p.z < lo_m_[1];
  const double near_m = towards_z ? lo_m_[1] - p.z : p.z - hi_m_[1], far_m = near_m + hi_m_[1] - lo_m_[1];
  if (!(near_m > least_m) || !(towards_z ? slats_.sky_towards_z : slats_.sky_against_z)) return;
  const auto end = [&](double x_m, bool lower) {
    const double a = (x_m - p.x) / near_m, b = (x_m - p.x) / far_m;
    return lower ? std::max(a, b) : std::min(a, b);
  };
  const double u[2] = {end(slats_.from_m, true), end(slats_.to_m, false)};
  if (!(u[0] < u[1])) return;
  double below = 0;  // where the slat before this one ends
  std::size_t i = 0;
  for (std::size_t k = 0; k < slats_.end.size(); ++k) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (; i < slats_.end[k]; ++i) {
      const DVec3& c = slats_.corner[i];
      const double v = (c.y - p.y) / (towards_z ? c.z - p.z : p.z - c.z);
      lo = std::min(lo, v), hi = std::max(hi, v);
    }
    if (k > 0 && below < lo) gaps.push_back({{u[0], u[1]}, {below, lo}, towards_z});
    below = k > 0 ? std::max(below, hi) : hi;
  }
}

Vec3 Blind::sample(const Gap& gap, const Vec2& u) const {
  const double v = gap.v[0] + static_cast<double>(u.y) * (gap.v[1] - gap.v[0]), a2 = 1 + v * v;
  const double w = a2 * (along_to(a2, gap.u[0]) + static_cast<double>(u.x) * along(gap, v));  // sine
  const double x = std::sqrt(a2) * w / std::sqrt(std::max(1 - w * w, 1e-300));
  const DVec3 d = std::clamp(x, gap.u[0], gap.u[1]) * DVec3(slats_.frame.x) + v * DVec3(slats_.frame.y) +
                  (gap.towards_z ? 1. : -1.) * DVec3(slats_.frame.z);
  return Vec3(glm::normalize(d));
}

double Blind::density(const Gap& gap, const Vec3& direction, bool inside) const {
  const DVec3 d(slats_.frame.to_local(direction));
  const double forwards = gap.towards_z ? d.z : -d.z;
  if (!(forwards > 0)) return 0;
  const double u = d.x / forwards, v = d.y / forwards;
  const bool within = u >= gap.u[0] && u <= gap.u[1] && v >= gap.v[0] && v <= gap.v[1];
  if (!within && !inside) return 0;
  return 1 / ((gap.v[1] - gap.v[0]) * along(gap, v));
}

bool Blind::is_before(const Vec3& place, const Vec3& direction) const {
  const DVec3 way = DVec3(place) - slats_.origin;
  const DVec3 d(slats_.frame.to_local(direction));
  const double t = (0.5 * (lo_m_[1] + hi_m_[1]) - glm::dot(way, DVec3(slats_.frame.z))) / d.z;
  if (!(t > 0)) return false;
  const double x = glm::dot(way, DVec3(slats_.frame.x)) + t * d.x,
               y = glm::dot(way, DVec3(slats_.frame.y)) + t * d.y;
  return x >= slats_.from_m && x <= slats_.to_m && y >= lo_m_[0] && y <= hi_m_[0];
}

}  // namespace phos::inline scene
