// A blind: slats, louvres or bars in a row, and the gaps between them as a place sees them.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Slats are prisms along x of the frame; they follow each other along y. Const, usable from any thread.
class Blind {
 public:
  /// Corners of slats across, (y, z) of the frame in m; each slat's are a run of `corner`.
  struct Slats {
    Frame frame;                   ///< x along the slats, y from one to the next, z across the blind
    DVec3 origin{0};               ///< m
    double from_m = 0, to_m = 0;   ///< their ends, along x
    std::vector<DVec3> corner;     ///< (0, y, z)
    std::vector<std::size_t> end;  ///< of each slat's run
    // Is the sky seen through the gaps by who looks along z, and by who looks against it?
    bool sky_towards_z = true, sky_against_z = true;
  };
  /// At least two slats.
  explicit Blind(Slats slats);

  /// A gap between two slats as seen from a place: all that nothing of the two hides. A box of directions
  /// u x + v y + z (with -z from the blind's other side), seen without end by u and v: a gap in thick slats
  /// is an opening with a depth.
  struct Gap {
    double u[2]{0, 0}, v[2]{0, 0};
    bool towards_z = true;
    /// sr, of a gap that is narrow by v.
    double solid_angle_sr() const;
  };
  /// Appends the gaps through which a place may see the sky. None where the place is within the depth of the
  /// blind or nearer to it than a thousandth of the slats' length.
  void gaps_from(const Vec3& place, std::vector<Gap>& gaps) const;
  /// A unit direction in a gap, from two numbers in [0, 1): u.y goes across the gap. Uniform over the solid
  /// angle of each line along the slats.
  Vec3 sample(const Gap& gap, const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction (unit); 0 outside of the gap, but not where it is
  /// known to be `inside`, whatever its rounding says.
  double density(const Gap& gap, const Vec3& direction, bool inside = false) const;
  /// Does the line from a place in a direction cross the blind?
  bool is_before(const Vec3& place, const Vec3& direction) const;

  const Slats& slats() const { return slats_; }
  std::size_t size() const { return slats_.end.size(); }

 private:
  Slats slats_;
  double lo_m_[2], hi_m_[2];  // of all corners: y, z
};

}  // namespace phos::inline scene
