// Points on a lamp to which the pixels of a block send their rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/random.h"
#include "core/sampling.h"

namespace phos::inline splat {

/// Strata of a lamp each way, and pixels each way of a block, of which each sends its first ray to one.
inline constexpr int kLampStrata = 4;

/// The part, of 4 x 4 of a lamp, to which the first ray of the pixel at (x, y) of a picture goes: the pixels
/// of any 4 x 4 meet each part once, the pixels of any 2 x 2 a quarter each.
struct Stratum {
  Stratum(std::size_t x, std::size_t y) : column(corner(x)), row(corner(y)) {}
  /// Of 0 .. 3: the half, and the part of that half.
  static std::uint32_t corner(std::size_t at) {
    return static_cast<std::uint32_t>((at & 1) << 1 | (at >> 1 & 1));
  }
  std::uint32_t column, row;
};

/// Points on a lamp of the rays of one pixel: Sobol' points, so that the more there are, the finer they cover
/// it, with their digits shifted such that each ray of the pixels of a 4 x 4 block, too, meets each stratum
/// once.
class LampPoints {
 public:
  LampPoints() = default;
  LampPoints(const Stratum& stratum, bool by_u_alone, RandomStream& random) : by_u_alone_(by_u_alone) {
    const std::uint32_t first =
        by_u_alone ? stratum.column << 30 : (stratum.row * kLampStrata + stratum.column) << 28;
    shift_[0] = first | random.bits() >> (by_u_alone ? 2 : 4);
    shift_[1] = by_u_alone ? stratum.row << 30 | random.bits() >> 2 : random.bits();
    turn_ = random.bits();
  }
  /// u_triangle and u of ray s.
  std::pair<float, Vec2> at(int s) const {
    const Vec2 p = sobol_point(s, shift_[0], shift_[1]);
    if (by_u_alone_) return {0.f, p};
    return {p.x, {golden_point(s, turn_), p.y}};
  }

 private:
  bool by_u_alone_ = true;
  std::uint32_t shift_[2]{}, turn_ = 0;
};

}  // namespace phos::inline splat
