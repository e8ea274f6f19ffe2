// Lamps as a few places that light comes from, for shadow maps.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/vector.h"
#include "scene/lamp/luminaires.h"
#include "scene/scene.h"

namespace phos::inline splat {

enum class PlaceShape : int { area = 0, point = 1, spot = 2, directional = 3, map = 4, area_map = 5 };

/// Shares of a colour by degrees: of azimuth, and from straight down. Rows of `axes` are a luminaire's x, y,
/// up.
struct ShareMap {
  static constexpr int kWidth = 361, kHeight = 181;
  std::vector<float> share;  ///< 1 at most; azimuth is the fastest
  float greatest = 0;        ///< the value of 1, in shares of the peak intensity (of solids, per m2)
  Mat3 axes{1};
};
/// Of a light that has a fitting.
ShareMap share_map(const Scene& scene, const Light& light);

struct LampPlace {
  PlaceShape shape = PlaceShape::point;
  Vec3 position{0};                     ///< m; directional: unused
  Vec3 forward{0, 0, -1};               ///< normal of an area, axis of a spot, way of directional light
  Rgb colour{0};                        ///< cd on the axis; directional: lx on a surface that faces it
  double cos_outer = 0, cos_inner = 1;  ///< of a spot: cosines of the half angles
  bool two_sided = false;               ///< an area that shines from both sides
  std::int64_t instance = -1;           ///< the area's own, which throws no shadow on its light
};

/// Places that stand for a light: `samples` for an extended one, else 1.
int place_count(const Light& light, int samples);
/// The k-th of `count` places of light `i`, which fill it evenly. `map`: share_map() of a light that has a
/// fitting. Nothing where it is dark.
std::optional<LampPlace> lamp_place(const Scene& scene, const Luminaires& luminaires, std::size_t i, int k,
                                    int count, const ShareMap& map);

}  // namespace phos::inline splat
