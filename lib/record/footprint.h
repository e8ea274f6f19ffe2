// Adaptive footprints of irradiance records (Ribardiere, Carre, Bouatouch 2011; docs/methods.md#e).
// A1, E1, E2, E4, E5: entries there.
//
// A record without one serves a disc: it reaches accuracy x radius_m all round, and its light changes by
// first order gradients. With one, reach and change depend on the direction: eight axes on the tangent plane,
// 45 degrees apart, each with a length and a parabola of the light along it. Code that reads records asks
// record_error() and extrapolate() and need not know which kind it has; radius_m belongs to the longest axis,
// so that whatever bounds a record's zone by a sphere stays right. Both kinds weigh alike and may be mixed.
//
// Border: between axes of lengths d1 and d2 it is |RP''| of E1, (1 - t) d1 + t d2, t from the chord. With
// P = a u1 + b u2 along the unit axes, s = |RP| / |RP''| = |P| (a/d1 + b/d2) / (a + b): no angle is needed.
// Weight: s' = sqrt(s^2 + (h / shortest)^2), h the height over the tangent plane, is continuous above the
// record too. The error of A1 is the reach of s' and the turn, so that the weight is 1 at the record and 0
// where the weight of E2 is, which is infinite there.
// Change along an axis: slope s + bend s^2 / 2 (E4; both in lx over the whole length). Between axes the slope
// follows the plane through both ends (linear light is met exactly), bends linear in b / (a + b).
// Change by a turn: the same, with the sine of the angle in the place of lengths (E5).
// E = E_R + both changes, at least 0. Beyond the axes the light of the border stands.
#pragma once

#include <array>
#include <memory>

#include "core/vector.h"

namespace phos::inline record {

class AdaptiveFootprint {
 public:
  static constexpr int kAxes = 8;

  struct Axis {
    float length_m = 0;     ///< along which the parabola was fitted; > 0
    Rgb slope{0}, bend{0};  ///< lx: E changes by slope s + bend s^2 / 2 at s x length
    Rgb turn_slope{0},
        turn_bend{0};  ///< lx per radian and radian^2, of the sine of the turn towards this axis
  };
  using Axes = std::array<Axis, kAxes>;
  using Lengths = std::array<float, kAxes>;  ///< of the axes, m

  /// Axis k lies at 45 k degrees from unit x towards cross(n, x), n the record's normal.
  AdaptiveFootprint(const Vec3& x, const Vec3& n, const Axes& axes);
  /// Light is even in it.
  AdaptiveFootprint(const Vec3& x, const Vec3& n, const Lengths& lengths_m);

  const Vec3& x() const { return x_; }
  const Vec3& y() const { return y_; }
  const Axes& axes() const { return axes_; }
  Lengths lengths_m() const;
  /// 1 / length of each axis.
  const std::array<float, kAxes>& inverse_m() const { return inverse_m_; }
  float longest_m() const { return longest_m_; }
  float shortest_m() const { return shortest_m_; }
  /// Of a disc as large as the longest axis, about: the mean square of the axes' lengths over that.
  float share_of_disc() const;
  /// Unit vector of axis k, along x and cross(n, x).
  static Vec2 direction(int k);

  /// eps (docs/methods.md#a1) at `step` from a record whose longest axis has this radius, with the radius of
  /// the direction; n_p and n are the normals there and at the record. Never less than with radius_m all
  /// round.
  float error(const Vec3& step, const Vec3& n_p, const Vec3& n, float radius_m) const;
  /// E - E_R at `step` where the normal is n_p, before limits. lx
  Rgb change(const Vec3& step, const Vec3& n_p) const;

  /// The same zone and light, told by axes that start at unit x of the tangent plane. Exact along the new
  /// axes; exact everywhere where x lies along one of its own.
  AdaptiveFootprint with_axes_from(const Vec3& x, const Vec3& n) const;
  /// The footprint where its surface has turned: the first axis lies as near to x as the tangent plane of n
  /// allows.
  AdaptiveFootprint moved_to(const Vec3& x, const Vec3& n) const;

 private:
  Vec3 x_, y_;
  Axes axes_;
  std::array<float, kAxes> inverse_m_;
  float longest_m_, shortest_m_;
};

/// The axis as far as `length_m`, told by the parabola through its own light there, halfway and at the record
/// (docs/methods.md#e4): exact where it is no longer than the axis. Beyond the axis the light of its end
/// stands.
AdaptiveFootprint::Axis with_length(const AdaptiveFootprint::Axis& axis, float length_m);

/// Is each of them finite and above 0?
bool are_lengths(const AdaptiveFootprint::Lengths& lengths_m);

/// What is wrong with one that was read, in words that follow "has"; nullptr: nothing.
const char* what_is_wrong(const AdaptiveFootprint& footprint, const Vec3& normal);

}  // namespace phos::inline record
