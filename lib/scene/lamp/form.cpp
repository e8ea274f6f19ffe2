#include "scene/lamp/form.h"

#include <algorithm>
#include <cmath>

namespace phos::inline scene {
namespace {

constexpr std::size_t kMostPatches = 32;

/// arccos(c) / sin(arccos(c)) for c in [0, 1], a polynomial in 2 c - 1 fitted at Chebyshev points; relative
/// error 2e-12.
double acute_over_sine(double c) {
  constexpr double kFactor[] = {1.2091995761558605,     -0.26360014130677117,    0.069733192088144977,
                                -0.019837145979242205,  0.0058616282241016286,   -0.0017729385310771791,
                                0.00054477992094009947, -0.00016926275937191148, 5.305078881076277e-05,
                                -1.686176411713913e-05, 5.3619636259689643e-06,  -1.5519419285980031e-06,
                                4.8776749565418562e-07, -2.6111313858134919e-07, 8.6488168776553322e-08};
  const double t = 2 * c - 1;
  double sum = 0;
  for (std::size_t i = std::size(kFactor); i-- > 0;) sum = sum * t + kFactor[i];
  return sum;
}

/// Angle between unit vectors over its sine: 1 for equal ones.
double angle_over_sine(double cosine, const DVec3& cross) {
  if (cosine >= 0) return acute_over_sine(cosine);
  const double sine = glm::length(cross);
  if (!(sine > 1e-7)) return 0;  // opposite ones: the edge runs through the origin
  return std::numbers::pi / sine - acute_over_sine(-cosine);
}

/// Sutherland and Hodgman's step for the plane through the origin that faces n. `out` holds one more.
int cut_at_horizon(std::span<const DVec3> in, const DVec3& n, DVec3* out) {
  int count = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const DVec3 &a = in[i], &b = in[(i + 1) % in.size()];
    const double za = glm::dot(a, n), zb = glm::dot(b, n);
    if (za >= 0) out[count++] = a;
    if ((za > 0 && zb < 0) || (za < 0 && zb > 0)) out[count++] = a + (b - a) * (za / (za - zb));
  }
  return count;
}

}  // namespace

double projected_solid_angle(std::span<const DVec3> corners, const DVec3& n) {
  DVec3 above[8], unit[8];
  if (corners.size() >= std::size(above)) return 0;
  const int count = cut_at_horizon(corners, n, above);
  if (count < 3) return 0;
  for (int i = 0; i < count; ++i) {
    const double length = glm::length(above[i]);
    if (!(length > 0)) return 0;
    unit[i] = above[i] / length;
  }
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Clockwise for one who looks from inside the cone: counter-clockwise seen from the surface's side.
    const DVec3 &a = unit[(i + 1) % count], &b = unit[i];
    const DVec3 across = glm::cross(a, b);
    sum += angle_over_sine(glm::dot(a, b), across) * glm::dot(across, n);
  }
  return 0.5 * sum;
}

LampForm::LampForm(const LampPanel& panel) : luminance_(panel.luminance()), double_sided_(panel.two_sided()) {
  if (panel.patches().size() > kMostPatches) return;
  for (const LampPanel::Patch& patch : panel.patches()) {
    const DVec3 a(patch.corner), b = a + DVec3(patch.edge[0]), c = a + DVec3(patch.edge[1]);
    if (patch.parallelogram)
      polygon_.push_back({{a, b, b + DVec3(patch.edge[1]), c}, DVec3(patch.normal), 4});
    else
      polygon_.push_back({{a, b, c}, DVec3(patch.normal), 3});
  }
}

float LampForm::projected_solid_angle(const Vec3& p, const Vec3& n) const {
  const DVec3 origin(p);
  double sum = 0;
  for (const Polygon& polygon : polygon_) {
    if (!double_sided_ && !(glm::dot(origin - polygon.corner[0], polygon.normal) > 0)) continue;
    DVec3 corner[4];
    for (unsigned c = 0; c < polygon.corners; ++c) corner[c] = polygon.corner[c] - origin;
    sum += std::fabs(phos::projected_solid_angle(std::span(corner, polygon.corners), DVec3(n)));
  }
  return static_cast<float>(sum);
}

}  // namespace phos::inline scene
