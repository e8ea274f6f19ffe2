#include "scene/sky/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline scene {
namespace {

/// a b c d e of types 1 to 15.
constexpr double kCie[15][5] = {
    {4.0, -0.70, 0, -1.0, 0},        // standard overcast, steep gradation towards the zenith
    {4.0, -0.70, 2, -1.5, 0.15},     // overcast, steep, a little brighter towards the sun
    {1.1, -0.80, 0, -1.0, 0},        // overcast, moderately graded
    {1.1, -0.80, 2, -1.5, 0.15},     // the same, a little brighter towards the sun
    {0.0, -1.00, 0, -1.0, 0},        // uniform
    {0.0, -1.00, 2, -1.5, 0.15},     // partly cloudy, ungraded, a little brighter towards the sun
    {0.0, -1.00, 5, -2.5, 0.30},     // the same, brighter about the sun
    {0.0, -1.00, 10, -3.0, 0.45},    // the same, a distinct corona
    {-1.0, -0.55, 2, -1.5, 0.15},    // partly cloudy, obscured sun
    {-1.0, -0.55, 5, -2.5, 0.30},    // partly cloudy, brighter about the sun
    {-1.0, -0.55, 10, -3.0, 0.45},   // white-blue, a distinct corona
    {-1.0, -0.32, 10, -3.0, 0.45},   // standard clear, low turbidity
    {-1.0, -0.32, 16, -3.0, 0.30},   // standard clear, polluted
    {-1.0, -0.15, 16, -3.0, 0.30},   // cloudless, turbid, a broad corona
    {-1.0, -0.15, 24, -2.8, 0.15}};  // white-blue, turbid, a broad corona

}  // namespace

double SkyShape::luminance(double cos_zenith, double cos_sun) const {
  if (traditional) return (1 + 2 * cos_zenith) / 3;
  const double gradation = cos_zenith > 0 ? 1 + a * std::exp(b / cos_zenith) : 1 + (b < 0 ? 0 : a);
  if (!has_sun_side()) return std::max(gradation, 0.0);
  const double chi = std::acos(std::clamp(cos_sun, -1.0, 1.0));
  return std::max(gradation * (1 + c * (std::exp(d * chi) - f) + e * cos_sun * cos_sun), 0.0);
}

SkyShape cie_sky(int type) {
  PHOS_CHECK(type >= 1 && type <= 16, "type ", type);
  SkyShape shape;
  shape.traditional = type == 16;
  if (shape.traditional) return shape;
  const double* row = kCie[type - 1];
  shape.a = row[0], shape.b = row[1], shape.c = row[2], shape.d = row[3], shape.e = row[4];
  shape.f = std::exp(shape.d * std::numbers::pi / 2);
  return shape;
}

}  // namespace phos::inline scene
