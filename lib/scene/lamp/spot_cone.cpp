#include "scene/lamp/spot_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phos::inline scene {
namespace {

constexpr double kRounding_rad = 1e-3;
/// Equal angles of a file, or of an animation at one time, may differ by the rounding of floats.
constexpr double kEqual = 1e-6;

double at_most_right_angle(double angle_rad) {
  constexpr double kMost_rad = 0.5 * std::numbers::pi;
  return angle_rad <= kMost_rad + kRounding_rad ? std::min(angle_rad, kMost_rad) : angle_rad;
}

}  // namespace

bool set_spot_cone(Light& light, double inner_rad, double outer_rad) {
  const double outer = at_most_right_angle(outer_rad);
  double inner = at_most_right_angle(inner_rad);
  if (inner > outer && inner <= outer * (1 + kEqual)) inner = outer;
  if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= 0.5 * std::numbers::pi)) return false;
  light.cos_inner = std::cos(inner);
  light.cos_outer = std::cos(outer);
  return true;
}

bool has_hard_edge(const Light& light) {
  return light.kind == Light::Kind::spot && light.cos_inner <= light.cos_outer;
}

}  // namespace phos::inline scene
