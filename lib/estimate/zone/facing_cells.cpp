#include "estimate/zone/facing_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace phos::inline estimate {
namespace {

constexpr float kRoundedOff = 1e-5f;  // of a length that is compared

/// The way that a normal faces mostly.
std::uint8_t face_of(const Vec3& n) {
  const Vec3 size = glm::abs(n);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return static_cast<std::uint8_t>(1 << (2 * axis + (n[axis] < 0 ? 1 : 0)));
}

/// Ways that a normal may face mostly which is within kSameFacing of this one. A normal is within
/// acos(3^-1/2) of the axis that it faces mostly.
std::uint8_t faces_about(const Vec3& normal) {
  static const float least = std::cos(std::acos(1 / std::sqrt(3.f)) + std::acos(kSameFacing)) - 0.001f;
  std::uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] >= least) faces |= static_cast<std::uint8_t>(1 << (2 * axis));
    if (-normal[axis] >= least) faces |= static_cast<std::uint8_t>(1 << (2 * axis + 1));
  }
  return faces;
}

}  // namespace

FacingCells::FacingCells(const PhotonMap& photons, const std::function<bool(std::uint32_t row)>& counted) {
  for (int level = 0; level < kLevels; ++level) faces_[level].assign(std::size_t{1} << (3 * level), 0);
  for (std::uint32_t row = 0; row < photons.size(); ++row)
    if (counted(row)) bounds_.include(photons.position[row]);
  constexpr int kFinest = kLevels - 1;
  for (std::uint32_t row = 0; row < photons.size(); ++row) {
    if (!counted(row)) continue;
    const Vec3& p = photons.position[row];
    faces({kFinest, along(0, p.x), along(1, p.y), along(2, p.z)}) |=
        face_of(decode_octahedral(photons.normal[row]));
  }
  for (int level = kFinest; level > 0; --level) {
    const int n = 1 << level;
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z) faces({level - 1, x / 2, y / 2, z / 2}) |= faces(Cell{level, x, y, z});
  }
}

/// Of the finest cells; never less for a greater coordinate.
int FacingCells::along(int axis, float coordinate_m) const {
  constexpr int kCells = 1 << (kLevels - 1);
  const float size_m = bounds_.hi[axis] - bounds_.lo[axis];
  if (!(size_m > 0)) return 0;
  const float part = (coordinate_m - bounds_.lo[axis]) / size_m;
  return static_cast<int>(std::clamp(part * kCells, 0.f, kCells - 1.f));
}

std::uint8_t& FacingCells::faces(const Cell& c) {
  const auto n = std::size_t{1} << c.level;
  return faces_[c.level][(static_cast<std::size_t>(c.x) * n + static_cast<std::size_t>(c.y)) * n +
                         static_cast<std::size_t>(c.z)];
}

bool FacingCells::may_hold(const ZonePlace& place, float radius_m) const {
  if (bounds_.empty()) return false;
  const std::uint8_t wanted = faces_about(place.frame.z);
  const Vec3 normal = glm::abs(place.frame.z), size = bounds_.size();
  const float slab = std::max(place.above_m, place.below_m);
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    const float across = std::sqrt(std::max(0.f, 1 - normal[axis] * normal[axis]) + kRoundedOff);
    const float reach = (radius_m * across + slab * normal[axis]) * (1 + kRoundedOff) + 4 * place.rounding_m;
    const float lo = place.p[axis] - reach, hi = place.p[axis] + reach;
    if (lo > bounds_.hi[axis] || hi < bounds_.lo[axis]) return false;
    const auto i = static_cast<std::size_t>(axis);
    first[i] = along(axis, lo), last[i] = along(axis, hi);
  }
  std::array<Cell, 8 * kLevels> open;
  std::size_t n = 0;
  open[n++] = {0, 0, 0, 0};
  while (n > 0) {
    const Cell c = open[--n];
    const int finer = kLevels - 1 - c.level;
    const std::array<int, 3> at{c.x, c.y, c.z};
    bool apart = !(faces(c) & wanted);
    for (std::size_t i = 0; i < 3 && !apart; ++i)
      apart = at[i] < first[i] >> finer || at[i] > last[i] >> finer;
    if (apart) continue;
    // Is all of the cell above the slab, or below it?
    const float side = 1 / static_cast<float>(1 << c.level);
    const Vec3 middle = bounds_.lo + size * ((Vec3(c.x, c.y, c.z) + 0.5f) * side);
    const float half = 0.5f * side * glm::dot(size, normal),
                height = glm::dot(middle - place.p, place.frame.z);
    if (std::fabs(height) >
        slab + half + kRoundedOff * (glm::dot(size, Vec3(1)) + std::fabs(height)) + 4 * place.rounding_m)
      continue;
    if (finer == 0) return true;
    for (int k = 0; k < 8; ++k)
      open[n++] = {c.level + 1, 2 * c.x + (k & 1), 2 * c.y + (k >> 1 & 1), 2 * c.z + (k >> 2)};
  }
  return false;
}

}  // namespace phos::inline estimate
