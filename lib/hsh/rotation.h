// Rotation of functions given by their harmonics.
#pragma once

#include <memory>
#include <span>

#include "core/vector.h"
#include "hsh/basis.h"
#include "hsh/limits.h"

namespace phos::inline hsh {

/// Angles of R = Rz(gamma) Ry(beta) Rz(alpha), radians; Ry(beta) takes +z to (sin beta, 0, cos beta). beta in
/// [0, pi]. Where beta is next to 0 (or pi) gamma is 0 and alpha holds the whole turn.
struct ZyzAngles {
  float alpha = 0, beta = 0, gamma = 0;
};
/// Of the rotation from one local frame to another: (R f)(w) = f(R^-1 w), R = to^T from (a direction's local
/// coordinates in `from`, mapped to those in `to`).
ZyzAngles rotation_angles(const Frame& from, const Frame& to);

/// About z, SH or HSH, in place, O(coefficients). `channels` numbers side by side per index.
void rotate_about_z(std::span<float> coefficients, float angle, int channels = 1);

/// How HSH are rotated, and the light that is assumed below the old horizon.
enum class HshRotation : unsigned char {
  via_sh,         ///< to SH of twice the order, rotated, and back: nothing below the horizon
  digon,          ///< the digon that leaves the hemisphere deleted, then as SH, angle mapped (Gautron 2004)
  zero_fill,      ///< precomputed matrices (Gautron 2004): nothing below the horizon
  constant_fill,  ///< the default: the light at the horizon goes on below it; keeps a constant exactly
  even_fill,      ///< mirrored at the horizon
};

/// A way of rotating HSH, by the name that options have for it.
struct HshRotationRow {
  HshRotation method;
  const char *name, *does;
};
inline constexpr HshRotationRow kHshRotations[] = {
    {HshRotation::via_sh, "via-sh", "through SH of twice the order"},
    {HshRotation::digon, "digon",
     "the part that leaves the hemisphere is cut off, the rest rotated as SH, by the mapped angle"},
    {HshRotation::zero_fill, "zero-fill", "by matrices, with no light from below the old horizon"},
    {HshRotation::constant_fill, "constant-fill",
     "by matrices, with the light of the horizon below it, as records are rotated"},
    {HshRotation::even_fill, "even-fill", "by matrices, with the light mirrored at the horizon"},
};

/// Rotates HSH of one order: whatever the method, two turns about z and a matrix between them. Matrices are
/// made by whole degrees when first needed, once per order and method for the whole program, and
/// interpolated; beyond `max_beta` the matrix of that very angle is made anew (slow). Const, usable from any
/// thread; the same numbers for any number of threads.
class HshRotator {
 public:
  static constexpr int kMaxOrder = kMostOrder.as<int>();
  /// Throws Error(usage) for an order outside 1 .. 30, or max_beta outside [0, pi/2].
  HshRotator(int order, HshRotation method = HshRotation::constant_fill, float max_beta = 0.55f);
  ~HshRotator();
  int order() const;
  /// in and out [channels * order^2], not the same memory. A beta below 0.1 degrees only turns about z.
  void rotate(const ZyzAngles& angles, std::span<const float> in, std::span<float> out,
              int channels = 1) const;
  /// The transpose: the sum of out_i f_i equals the sum of in_i (rotated f)_i for every f. It turns the
  /// factor of rotated functions in place of the functions.
  void rotate_transposed(const ZyzAngles& angles, std::span<const float> in, std::span<float> out,
                         int channels = 1) const;

 private:
  struct Tables;
  void apply(const ZyzAngles& angles, bool transposed, std::span<const float> in, std::span<float> out,
             int channels) const;
  std::shared_ptr<const Tables> tables_;
  float max_beta_;
};

/// Exact rotation of SH, band by band; made for one rotation and used for many functions. Const, usable from
/// any thread.
class ShRotation {
 public:
  /// Throws Error(usage) for an order outside 1 .. HarmonicBasis::kMaxOrder.
  ShRotation(int order, const ZyzAngles& angles);
  ~ShRotation();
  /// in and out [channels * order^2], not the same memory.
  void rotate(std::span<const float> in, std::span<float> out, int channels = 1) const;

 private:
  struct Turns;
  std::unique_ptr<const Turns> turns_;
};

}  // namespace phos::inline hsh
