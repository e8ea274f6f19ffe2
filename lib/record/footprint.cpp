#include "record/footprint.h"

#include <algorithm>
#include <cmath>

#include "record/weight.h"

namespace phos::inline record {
namespace {

constexpr int kAxes = AdaptiveFootprint::kAxes;
constexpr float kHalf = 0.70710678f;  // cosine of 45 degrees
constexpr float kAxisX[kAxes] = {1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
constexpr float kAxisY[kAxes] = {0, kHalf, 1, kHalf, 0, -kHalf, -1, -kHalf};
constexpr float kPerSine = 1.41421356f;

/// A vector of the tangent plane between two axes: a along `first`, b along `second`.
struct Sector {
  int first, second;
  float a, b;
};

Sector sector_of(float x, float y) {
  const bool steep = std::fabs(y) > std::fabs(x);
  const int k =
      y >= 0 ? (x >= 0 ? (steep ? 1 : 0) : (steep ? 2 : 3)) : (x < 0 ? (steep ? 5 : 4) : (steep ? 6 : 7));
  const int l = (k + 1) % kAxes;
  return {k, l, std::max(0.f, kPerSine * (x * kAxisY[l] - y * kAxisX[l])),
          std::max(0.f, kPerSine * (kAxisX[k] * y - kAxisY[k] * x))};
}

AdaptiveFootprint::Axes axes_of(const AdaptiveFootprint::Lengths& lengths_m) {
  AdaptiveFootprint::Axes axes;
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k].length_m = lengths_m[k];
  return axes;
}

}  // namespace

AdaptiveFootprint::AdaptiveFootprint(const Vec3& x, const Vec3& n, const Axes& axes)
    : x_(x), y_(glm::cross(n, x)), axes_(axes), longest_m_(0), shortest_m_(kInfinity) {
  for (std::size_t k = 0; k < axes.size(); ++k) {
    // What was read may be anything, until what_is_wrong() has seen it.
    const float length_m = axes[k].length_m, most = std::numeric_limits<float>::max();
    inverse_m_[k] = std::isgreater(length_m, 1 / most) ? 1 / length_m : most;
    longest_m_ = std::fmax(longest_m_, length_m), shortest_m_ = std::fmin(shortest_m_, length_m);
  }
}

AdaptiveFootprint::AdaptiveFootprint(const Vec3& x, const Vec3& n, const Lengths& lengths_m)
    : AdaptiveFootprint(x, n, axes_of(lengths_m)) {}

AdaptiveFootprint::Lengths AdaptiveFootprint::lengths_m() const {
  Lengths lengths;
  std::transform(axes_.begin(), axes_.end(), lengths.begin(), [](const Axis& a) { return a.length_m; });
  return lengths;
}

Vec2 AdaptiveFootprint::direction(int k) { return {kAxisX[k], kAxisY[k]}; }

float AdaptiveFootprint::share_of_disc() const {
  float sum = 0;
  for (const Axis& a : axes_) sum += (a.length_m / longest_m_) * (a.length_m / longest_m_);
  return sum / kAxes;
}

float AdaptiveFootprint::error(const Vec3& step, const Vec3& n_p, const Vec3& n, float radius_m) const {
  const float x = glm::dot(step, x_), y = glm::dot(step, y_), height = glm::dot(step, n) / shortest_m_;
  const Sector s = sector_of(x, y);
  const float along = s.a + s.b;
  const float q = s.a * inverse_m_[static_cast<std::size_t>(s.first)] +
                  s.b * inverse_m_[static_cast<std::size_t>(s.second)];
  const float reach = along > 0 ? border_reach(x, y, along, q) : 0;
  return footprint_error(reach, height, glm::length(n_p - n), longest_m_ / radius_m);
}

Rgb AdaptiveFootprint::change(const Vec3& step, const Vec3& n_p) const {
  const float x = glm::dot(step, x_), y = glm::dot(step, y_);
  Rgb sum(0);
  if (const Sector s = sector_of(x, y); s.a + s.b > 0) {
    const auto i = static_cast<std::size_t>(s.first), j = static_cast<std::size_t>(s.second);
    const float along = s.a + s.b, share = s.b / along;
    const float a = s.a * inverse_m_[i], b = s.b * inverse_m_[j];
    const float reach = border_reach(x, y, along, a + b);
    sum += slope_share(reach, 1) * (a * axes_[i].slope + b * axes_[j].slope) +
           0.5f * bend_share(reach, 1) * ((1 - share) * axes_[i].bend + share * axes_[j].bend);
  }
  const float tx = glm::dot(n_p, x_), ty = glm::dot(n_p, y_);
  if (const Sector s = sector_of(tx, ty); s.a + s.b > 0) {
    const auto i = static_cast<std::size_t>(s.first), j = static_cast<std::size_t>(s.second);
    const float along = s.a + s.b, share = s.b / along;
    const float sine = std::sqrt(tx * tx + ty * ty);
    sum += slope_share(sine, kMostTurnSine) * (s.a * axes_[i].turn_slope + s.b * axes_[j].turn_slope) +
           0.5f * bend_share(sine, kMostTurnSine) *
               ((1 - share) * axes_[i].turn_bend + share * axes_[j].turn_bend);
  }
  return sum;
}

AdaptiveFootprint AdaptiveFootprint::with_axes_from(const Vec3& x, const Vec3& n) const {
  if (x == x_) return *this;
  const Vec3 y = glm::cross(n, x);
  Axes axes;
  for (int k = 0; k < kAxes; ++k) {
    const Vec3 u = kAxisX[k] * x + kAxisY[k] * y;
    const float ux = glm::dot(u, x_), uy = glm::dot(u, y_);
    const Sector s = sector_of(ux, uy);
    const auto i = static_cast<std::size_t>(s.first), j = static_cast<std::size_t>(s.second);
    const float along = s.a + s.b, share = s.b / along;
    const float a = s.a * inverse_m_[i], b = s.b * inverse_m_[j];
    Axis& axis = axes[static_cast<std::size_t>(k)];
    axis.length_m = 1 / border_reach(ux, uy, along, a + b);
    axis.slope = axis.length_m * (a * axes_[i].slope + b * axes_[j].slope);
    axis.bend = (1 - share) * axes_[i].bend + share * axes_[j].bend;
    axis.turn_slope = s.a * axes_[i].turn_slope + s.b * axes_[j].turn_slope;
    axis.turn_bend = (1 - share) * axes_[i].turn_bend + share * axes_[j].turn_bend;
  }
  return {x, n, axes};
}

AdaptiveFootprint AdaptiveFootprint::moved_to(const Vec3& x, const Vec3& n) const {
  return {glm::normalize(x - glm::dot(x, n) * n), n, axes_};
}

AdaptiveFootprint::Axis with_length(const AdaptiveFootprint::Axis& axis, float length_m) {
  const auto change_at = [&](float distance_m) {
    const float s = std::min(distance_m / axis.length_m, 1.f);
    return axis.slope * s + axis.bend * (0.5f * s * s);
  };
  const Rgb half = change_at(0.5f * length_m), all = change_at(length_m);
  AdaptiveFootprint::Axis told = axis;
  told.length_m = length_m, told.slope = 4.f * half - all, told.bend = 4.f * (all - 2.f * half);
  return told;
}

bool are_lengths(const AdaptiveFootprint::Lengths& lengths_m) {
  return std::all_of(lengths_m.begin(), lengths_m.end(), [](float m) { return m > 0 && std::isfinite(m); });
}

const char* what_is_wrong(const AdaptiveFootprint& f, const Vec3& normal) {
  bool finite = is_finite(f.x()), positive = true;
  for (const AdaptiveFootprint::Axis& a : f.axes()) {
    positive = positive && a.length_m > 0 && std::isfinite(a.length_m);
    finite = finite && is_finite(a.slope) && is_finite(a.bend) && is_finite(a.turn_slope) &&
             is_finite(a.turn_bend);
  }
  if (!finite) return "a footprint that is not finite";
  if (!positive) return "a footprint's axis of no length";
  if (std::fabs(glm::length(f.x()) - 1) > 1e-3f || std::fabs(glm::dot(f.x(), normal)) > 1e-3f)
    return "a footprint that is not on its tangent plane";
  return nullptr;
}

}  // namespace phos::inline record
