// What a page wants of the growing cache.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "place/candidates.h"

namespace phos::inline view {

struct GrowthWish {
  std::uint32_t since = 0;  ///< serial number of the last change that the page has
  double share = 1;         ///< of the accuracy at which records are to cover the points
  bool save = false;
  std::vector<SurfaceSample> points;
};

/// The least share that a page may ask for.
inline constexpr double kLeastShareAsked = 0.5;
/// Points this far beyond the bounds of the scene, in diagonals, are refused.
inline constexpr float kBeyond = 0.01f;

/// Reads MessageKind::wish. Throws Error(bad_input) for another message, a share out of range, more than
/// `most` points, points far off the scene, and normals without a direction.
GrowthWish read_growth_wish(std::string_view message, const Bounds& scene, std::size_t most);

}  // namespace phos::inline view
