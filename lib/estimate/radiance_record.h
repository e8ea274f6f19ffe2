// Light around a place as hemispherical harmonics: from a sampled hemisphere to a radiance record.
#pragma once

#include <memory>
#include <span>

#include "estimate/estimator.h"
#include "estimate/harmonics/light_sums.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/record_options.h"
#include "radiance/cache.h"

namespace phos::inline estimate {

/// How the change of coefficients with the place is found. The hits of the rays keep their luminance;
/// analytic and numeric let all hits stay in sight, and so are blind to occlusion.
enum class RadianceGradient {
  analytic,  ///< derivative of each ray's own term (docs/methods.md#j3)
  hybrid,    ///< and edges between neighbouring rays, that move with the nearer hit (as docs/methods.md#b5 of
             ///< irradiance); of hemispheres stratified by solid angle, and of others by the borders that are
             ///< given
  numeric,   ///< differences between displaced places, the hits kept: the same as analytic to about 1e-4
  none,
};

/// What that asks of sums of light.
SlopesBy slopes_by(RadianceGradient gradient);

/// A border between the pieces of an unstructured hemisphere that two neighbouring rays stand for: an arc of
/// a great circle through the place.
struct RayBorder {
  std::uint32_t before = 0, after = 0;  ///< rays
  Vec3 direction{0, 0, 1};              ///< of its middle; unit, in the hemisphere's frame
  /// Of the unit normal of the circle, from `before` to `after`: x and y, times the length of the arc, rad.
  Vec2 across{0};
};

/// Turns hemispheres into coefficients; holds the basis and memory, for one thread.
class RadianceProjector {
 public:
  /// Throws Error(usage) unless 1 <= order <= HshRotator::kMaxOrder.
  explicit RadianceProjector(int order);
  ~RadianceProjector();

  /// The record of a hemisphere, but for position and radius. c = sum of L H omega; in the gradients the
  /// emitter's cosine is kept above 0.05 and distances above `least_m`. Distance: harmonic mean over solid
  /// angle, misses counting as infinitely far. Standard error: RadianceError. `borders`: of an
  /// unstructured hemisphere, for RadianceGradient::hybrid; none: as analytic.
  RadianceRecord project(const Hemisphere& h, RadianceGradient mode, float least_m,
                         std::span<const RayBorder> borders = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws Error(numerical), with the record's place in the world, unless all its numbers are finite.
void require_finite(const DVec3& origin_m, const RadianceRecord& record);

/// The part of the variance of a record's luminance of irradiance that comes from Hemisphere::source.
float shared_part(const Hemisphere& h, const Rgb& stderr_lx);

/// How much of radius_m the gradient leaves, m: to where a colour's gradient would change the coefficients by
/// their own norm (as within_gradient_m of irradiance).
float within_gradient_m(const RadianceRecord& record, float radius_m);

/// How far such a record reaches before bounds: its distance (`harmonic`, or the least of the rays), at most
/// max_radius_m, and no farther than within_gradient_m.
float reach_m(const RadianceRecord& record, const Hemisphere& h, const RecordOptions& resolved);

}  // namespace phos::inline estimate
