#include "scene/lamp_form.h"

#include <algorithm>
#include <cmath>

#include "scene/luminaires.h"

namespace phos {
namespace {

constexpr std::uint32_t kMostTriangles = 32;

/// Angle between unit vectors over its sine: 1 for equal ones.
double angle_over_sine(double sine, double cosine) {
  if (sine > 1e-7) return std::atan2(sine, cosine) / sine;
  return cosine > 0 ? 1.0 : 0.0;  // opposite ones: the edge runs through the origin
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
    sum += angle_over_sine(glm::length(across), glm::dot(a, b)) * glm::dot(across, n);
  }
  return 0.5 * sum;
}

LampForm::LampForm(const Scene& scene, const Light& light) {
  if (light.kind != Light::Kind::area) return;
  const Instance& instance = scene.instance[light.instance];
  const Material& material = scene.material[instance.material];
  if (!shines_evenly(scene, instance) || instance.triangle_count > kMostTriangles) return;
  luminance_ = material.emission;
  double_sided_ = material.double_sided;
  for (std::uint32_t t = 0; t < instance.triangle_count; ++t) {
    const Triangle& triangle = scene.triangle[instance.first_triangle + t];
    Polygon polygon{{}, DVec3(geometric_normal(scene, instance.first_triangle + t)), 3};
    for (int c = 0; c < 3; ++c) polygon.corner[c] = DVec3(scene.position[triangle.v[c]]);
    polygon_.push_back(polygon);
  }
}

float LampForm::projected_solid_angle(const Vec3& p, const Vec3& n) const {
  const DVec3 origin(p);
  double sum = 0;
  for (const Polygon& polygon : polygon_) {
    if (!double_sided_ && !(glm::dot(origin - polygon.corner[0], polygon.normal) > 0)) continue;
    DVec3 corner[4];
    for (int c = 0; c < polygon.corners; ++c) corner[c] = polygon.corner[c] - origin;
    sum += std::fabs(
        phos::projected_solid_angle(std::span(corner, static_cast<std::size_t>(polygon.corners)), DVec3(n)));
  }
  return static_cast<float>(sum);
}

}  // namespace phos
