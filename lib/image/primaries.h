// Colour of other primaries to Rec.709.
#pragma once

#include "core/vector.h"

namespace phos::inline image {

/// CIE xy of the primaries and the white of an RGB space.
struct Primaries {
  Vec2 red, green, blue, white;
  bool operator==(const Primaries&) const = default;
  /// All zeros, which writers put where they know none.
  bool not_given() const { return *this == Primaries{Vec2(0), Vec2(0), Vec2(0), Vec2(0)}; }
};

inline constexpr Primaries kRec709{{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};
/// Radiance's standard: equal-energy white (Ward, "Real Pixels", 1991; Radiance color.h).
inline constexpr Primaries kRadiance{
    {0.640f, 0.330f}, {0.290f, 0.600f}, {0.150f, 0.060f}, {1.0f / 3, 1.0f / 3}};

/// False for values that span no colour space (collinear, not finite) or have a white without X, Y or Z.
/// Primaries that no light has, as ACES AP0 and CIE XYZ have, are valid.
bool is_valid(const Primaries& p);

/// XYZ of RGB; white has Y = 1. (SMPTE RP 177)
Mat3 rgb_to_xyz(const Primaries& p);

/// Between two RGB spaces. Luminance is kept exactly, and white stays white: X and Z are scaled by the ratio
/// of the whites. (Cone-space adaptation would keep hues slightly better, but not luminance.)
Mat3 convert_primaries(const Primaries& from, const Primaries& to);

}  // namespace phos::inline image
