// Adaptive footprints from the hits of a record's rays (docs/methods.md#e).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "direct/direct_light.h"
#include "estimate/hemisphere/hemisphere.h"
#include "record/footprint.h"

namespace phos::inline estimate {

/// Light along an axis as a parabola of s in [0, 1] times its length.
struct AxisFit {
  float length_m = 0;
  Rgb slope{0}, bend{0};  ///< as AdaptiveFootprint::Axis has them
  bool resolved = false;  ///< within rho at a quarter and at three quarters of its length
  int evaluations = 0;
};
/// docs/methods.md#e4 and #e6: the parabola through the light at 0 (`at_place`), at half and at all of
/// `length_m`, which is halved until at a quarter and three quarters of it the parabola is off by at most rho
/// of the light there (of its brightest colour, which counts as at least 0.001 of its value at the place). No
/// shorter than `least_m`: an axis that would be is not resolved. `light` at a distance is asked for two new
/// ones a step: at most 5 + 2 log2(length / least) in all.
AxisFit fit_axis(const Rgb& at_place, const std::function<Rgb(float distance_m)>& light, float length_m,
                 float least_m, float rho);

/// docs/methods.md#e3: light near a place, if all hits of its rays stayed in sight and kept their luminance:
/// hits as equivalent point lights of intensity L d^2 / density that fall off with the emitter's cosine (13).
/// Exact at the place. Neighbouring rays with hits alike make one light (some 256 in all, or more).
/// The share of the hemisphere that a hit takes has a size: it comes no nearer than a quarter of its
/// distance. Occlusion, which such lights know nothing of, enters to first order by the difference of the
/// gradients with and without it (docs/methods.md#b5, #b4). The shares of the hits, moved alike, must add up
/// to 1: light is divided by that sum, so that it is even where all shines alike. Where the sum is far from
/// 1, surfaces have come into sight or gone out of sight, and nothing is known (known()).
class LightNearby {
 public:
  /// `mode`: of ray_gradients(); distances below `least_m` count as that much there. In the frame of the
  /// first pass.
  LightNearby(std::span<const Hemisphere> passes, GradientMode mode, float least_m);
  struct Light {
    Rgb irradiance{0};  ///< lx, may be below 0
    float seen = 1;     ///< the share of the hemisphere that the hits take
  };
  /// At `step` on the tangent plane (along frame.x and frame.y, m), the normal as it is. `of_occlusion`:
  /// the share of the change by occlusion that counts.
  Light at(const Vec2& step, float of_occlusion = 1) const;
  /// Change of irradiance by a turn of the normal by asin(`sine`) towards unit `axis` of the tangent plane,
  /// beyond the part linear in the sine: cosines become smaller, and light below the horizon, which would
  /// count negative, is left out. Light of lamps is added by the same rule. lx
  Rgb bend_by_turn(const Vec2& axis, float sine, std::span<const LampSample> lamps) const;
  /// How fast occlusion changes light along it, lx/m.
  const Rgb& occlusion(int tangent_axis) const { return occlusion_[tangent_axis]; }
  const Frame& frame() const { return frame_; }

 private:
  struct Bundle;
  void add(const Hemisphere& h, float weight, float least_m);
  void add_ray(const Hemisphere& h, std::size_t i, float weight, float least_m, std::vector<Bundle>& bundles);
  void keep(const Bundle& bundle);

  Frame frame_;
  Rgb constant_{0};  // from infinitely far, lx
  float constant_seen_ = 0;
  Rgb occlusion_[2]{Rgb(0), Rgb(0)};
  float occlusion_seen_[2]{0, 0};
  // Columns of the lights; tangential parts, over the squared distance or the emitter's cosine.
  std::vector<float> red_, green_, blue_;     // lx at the place
  std::vector<float> seen_;                   // share of the hemisphere, cosine included
  std::vector<float> towards_x_, towards_y_;  // 1/m: 2 q / d^2
  std::vector<float> facing_x_, facing_y_;    // 1/m: n_q / (-n_q.q)
  std::vector<float> inverse_d2_;             // 1/m2
  mutable std::vector<float> share_;
  std::vector<Vec3> direction_;  // local, of all rays
  std::vector<Rgb> light_;       // lx
};

/// What limits the axes, as radii of weights (zones are accuracy times that).
struct FootprintBounds {
  float least_m = 0, most_m = kInfinity;  ///< of every axis
  float accuracy = 1;                     ///< at which records are read: the fit covers accuracy x radius
  float rho = 0.05f;
  float unseen = 0.1f;  ///< share of the hemisphere that may be unknown at an axis' end
};

struct FittedFootprint {
  std::shared_ptr<const AdaptiveFootprint> footprint;
  float radius_m = 0;  ///< of the longest axis
  int unresolved = 0;  ///< axes that are as short as they may be and still off by more than rho
};

/// Radius along each axis that surroundings leave (docs/methods.md#e1): distance to the nearest surface that
/// a ray has found within 22.5 degrees of the axis and more than 30 degrees from the normal; where there is
/// none, the mean of the distances of the axes beside it, with most_m for an axis that has none either.
/// Within bounds, and no axis more than twice its neighbours (docs/methods.md#e7).
std::array<float, AdaptiveFootprint::kAxes> radii_by_surroundings(std::span<const Hemisphere> passes,
                                                                  const FootprintBounds& bounds);

/// Shortens axes until none is more than twice its neighbours (docs/methods.md#e7).
void limit_slopes(AdaptiveFootprint::Lengths& lengths_m);

/// The footprint of a record at the place of the passes. `direct`: light straight from the lamps at a step on
/// the tangent plane, the same samples of them with visibility tested anew; empty: none counts. `lamps`: its
/// samples at the place. `rotation`: rotation gradient of the record (docs/methods.md#b1).
FittedFootprint fit_footprint(std::span<const Hemisphere> passes, const LightNearby& nearby,
                              const std::function<Rgb(const Vec2& step)>& direct,
                              std::span<const LampSample> lamps, const Vec3 (&rotation)[3],
                              const FootprintBounds& bounds);

}  // namespace phos::inline estimate
