#include "image/primaries.h"

#include <algorithm>
#include <cmath>

namespace phos::inline image {

namespace {

/// (x, y, z), which add up to 1.
glm::dvec3 xyz(const Vec2& xy) {
  const glm::dvec2 p(xy);
  return {p.x, p.y, 1.0 - p.x - p.y};
}

/// XYZ with Y = 1.
glm::dvec3 white_of(const Primaries& p) { return xyz(p.white) / static_cast<double>(p.white.y); }

glm::dmat3 columns_of(const Primaries& p) { return {xyz(p.red), xyz(p.green), xyz(p.blue)}; }

/// Primaries may have y of 0 or below (CIE XYZ, ACES AP0): no column is divided by it.
glm::dmat3 matrix(const Primaries& p) {
  const glm::dmat3 columns = columns_of(p);
  const glm::dvec3 scale = glm::inverse(columns) * white_of(p);
  return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

}  // namespace

bool is_valid(const Primaries& p) {
  for (const Vec2& xy : {p.red, p.green, p.blue, p.white})
    if (!(std::fabs(xy.x) <= 10 && std::fabs(xy.y) <= 10)) return false;
  const glm::dvec3 white = xyz(p.white);
  if (!(std::min({white.x, white.y, white.z}) > 1e-4)) return false;
  if (std::fabs(glm::determinant(columns_of(p))) < 1e-6) return false;
  return std::fabs(glm::determinant(matrix(p))) > 1e-9;
}

Mat3 rgb_to_xyz(const Primaries& p) { return Mat3(matrix(p)); }

Mat3 convert_primaries(const Primaries& from, const Primaries& to) {
  if (from == to) return Mat3(1);
  const glm::dvec3 adapt = white_of(to) / white_of(from);
  const glm::dmat3 scale(glm::dvec3(adapt.x, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, adapt.z));
  return Mat3(glm::inverse(matrix(to)) * scale * matrix(from));
}

}  // namespace phos::inline image
