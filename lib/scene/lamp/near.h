// Near lamps and openings: sampled uniformly in the solid angle under which they are seen.
#pragma once

namespace phos::inline scene {

/// Within this many of its radii from its middle: beyond, points that are uniform over it weigh nearly alike.
inline constexpr float kNearRadii = 2;
/// Seen under less than this it is not near: directions would be told apart by rounding.
inline constexpr double kLeastNear_sr = 1e-4;

}  // namespace phos::inline scene
