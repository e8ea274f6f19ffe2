#include "image/primaries.h"

#include <initializer_list>

namespace phos {

namespace {

/// XYZ with Y = 1.
glm::dvec3 xyz_of(const Vec2& xy) {
  const glm::dvec2 p(xy);
  return {p.x / p.y, 1.0, (1.0 - p.x - p.y) / p.y};
}

glm::dmat3 matrix(const Primaries& p) {
  const glm::dmat3 columns(xyz_of(p.red), xyz_of(p.green), xyz_of(p.blue));
  const glm::dvec3 scale = glm::inverse(columns) * xyz_of(p.white);
  return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

}  // namespace

bool is_valid(const Primaries& p) {
  for (const Vec2& xy : {p.red, p.green, p.blue, p.white})
    if (!std::isfinite(xy.x) || !std::isfinite(xy.y) || std::fabs(xy.x) > 10 || !(xy.y > 1e-4f) || xy.y > 10)
      return false;
  if (std::fabs(glm::determinant(glm::dmat3(xyz_of(p.red), xyz_of(p.green), xyz_of(p.blue)))) < 1e-6)
    return false;
  return std::fabs(glm::determinant(matrix(p))) > 1e-9;
}

Mat3 rgb_to_xyz(const Primaries& p) { return Mat3(matrix(p)); }

Mat3 convert_primaries(const Primaries& from, const Primaries& to) {
  if (from == to) return Mat3(1);
  const glm::dvec3 adapt = xyz_of(to.white) / xyz_of(from.white);
  const glm::dmat3 scale(glm::dvec3(adapt.x, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, adapt.z));
  return Mat3(glm::inverse(matrix(to)) * scale * matrix(from));
}

}  // namespace phos
