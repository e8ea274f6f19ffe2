// The environment as a rectangle in a plane of one orientation shows it.
#pragma once

#include <vector>

#include "core/vector.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {

/// Directions (x, y, z) before a plane, y > 0, by alpha = atan(x / y) and beta = atan(z / y): a rectangle
/// whose edges lie along x and z is a box of them from wherever it is seen (docs/methods.md#t6: Bitterli,
/// Novak and Jarosz 2015). The light of any box is four look-ups of a summed-area table, and directions in it
/// are drawn by it. The sun is not part of it. Const, usable from any thread.
class RectifiedMap {
 public:
  /// Orthogonal unit axes; y points at the environment.
  struct Axes {
    DVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  };
  RectifiedMap(const Environment& light, const Axes& axes);

  const Axes& axes() const { return axes_; }

  /// From lo to hi, rad, within (-pi / 2, pi / 2).
  struct Box {
    double alpha[2]{0, 0}, beta[2]{0, 0};
  };
  /// As a place sees the rectangle of these opposite corners: differences to the place, m. Empty where the
  /// place lies in its plane or beyond.
  Box box(const DVec3& to_corner, const DVec3& to_opposite) const;
  bool holds(const Box& box, const Vec3& direction) const;

  /// Light through a box: integral of the luminance over its solid angle, lx. Texels count as at least a
  /// fiftieth of the mean, so that none that shines is left out for the table's coarseness.
  double light_lx(const Box& box) const;
  /// A unit direction in the box, from two numbers in [0, 1), each monotonous. light_lx(box) must be above 0.
  Vec3 sample(const Box& box, const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction (unit) that lies in a box of that light.
  double density(double light_lx, const Vec3& direction) const;

 private:
  double sum(double alpha, double beta) const;

  Axes axes_;
  std::vector<double> sum_;  // of cells below and left, lx; rows by beta, kCells + 1 each
};

}  // namespace phos::inline scene
