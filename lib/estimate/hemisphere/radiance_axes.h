// Lengths of the axes of a radiance record's footprint, from the hits of its rays (docs/methods.md#e8).
#pragma once

#include <vector>

#include "core/vector.h"
#include "estimate/harmonics/light_sums.h"
#include "estimate/hemisphere/footprint_fit.h"
#include "radiance/cache.h"

namespace phos::inline estimate {

/// Light by direction near a place, if all hits of its rays stayed in sight and kept their luminance
/// (docs/methods.md#e3, without the cosine of the place's own surface). Exact at the place. Neighbouring rays
/// with hits alike make one light (some 1,000 in all, or more), and a light comes no nearer than a quarter of
/// its distance.
class RadianceNearby {
 public:
  /// Of a stratified hemisphere, in its frame. Distances below `least_m` count as that much.
  RadianceNearby(const Hemisphere& h, int order, float least_m);
  struct Light {
    std::vector<double> coefficients;  ///< [order^2][3]
    float seen = 1;                    ///< share of the hemisphere that the hits take
  };
  /// At `step` on the tangent plane, along frame.x and frame.y, m.
  Light at(const Vec2& step);
  /// Coefficients at the place, and their change per metre by the hits alone, as `record` holds them.
  void at_place(RadianceRecord& record);

 private:
  struct Hit {
    Vec3 direction{0, 0, 1};
    float inverse_m = 0;
    Vec2 normal{0};  ///< tangential part of its normal over its cosine
    float seen = 0;  ///< share of the hemisphere
    Rgb light{0};    ///< cd/m2 sr
  };
  struct Bundle;
  static Hit hit_of(const Bundle& bundle);

  LightSums sums_;
  std::vector<Hit> hits_;
};

/// The zone of a radiance record.
struct FittedAxes {
  AdaptiveFootprint::Lengths length_m{};  ///< in the record's frame
  float radius_m = 0;                     ///< of the longest axis
  int unresolved = 0;  ///< axes that are as short as they may be and still off by more than rho
};

/// docs/methods.md#e8. `record` is made of `h`, with its gradients; it is read with them, or, unless
/// `with_gradients`, without.
FittedAxes fit_axes(const Hemisphere& h, const RadianceRecord& record, bool with_gradients, float least_m,
                    const FootprintBounds& bounds);

}  // namespace phos::inline estimate
