// From the light that arrives at a place to the record there.
#pragma once

#include <span>
#include <vector>

#include "direct/direct_light.h"
#include "estimate/estimator.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/record_options.h"

namespace phos::inline estimate {

/// Light at a place, with the lengths from which the radius of a record follows.
struct PlaceLight {
  Rgb irradiance{0}, stderr_lx{0};
  DVec3 shared_lx2{0};           ///< the part of its variance that places nearby have in common
  float distance_m = kInfinity;  ///< of surroundings: harmonic mean or least, as RecordOptions::radius says
  float light_m = kInfinity;     ///< harmonic mean distance that the light comes from, by RadiusRule::light
  Gradients gradients;
};

/// Means over passes, each weighted by its rays. Gradients by RecordOptions::gradients (the default ones
/// where the record is to have none: its radius asks for them); distances below min_radius_m count as that
/// much in them.
PlaceLight light_of(std::span<const Hemisphere> passes, const RecordOptions& resolved);

/// Adds the light of lamp samples at a place of unit normal n; `samples` of each area light were taken.
/// Gradients are the samples' own (docs/methods.md#b4: an area light moves as a surface does, a point light
/// by 3 w / d, a directional one not at all): blind to shadow edges. The harmonic distances become
/// the distances of all light, each part by its luminance.
void add_lamps(std::span<const LampSample> lamps, int samples, const Luminaires& lights, const Vec3& n,
               const RecordOptions& resolved, PlaceLight& light);

/// How much of radius_m the gradient of irradiance leaves, m: to where it would change a channel by the
/// channel's own value (docs/methods.md#a7). Channels much dimmer than the brightest have no say.
float within_gradient_m(const Rgb& irradiance, const Vec3 (&translation_gradient)[3], float radius_m);

/// Throws Error(numerical), with the place in the world, unless all that was found at p, which is counted
/// from origin_m, is finite.
void require_finite(const DVec3& origin_m, const Vec3& p, const Rgb& irradiance, const Rgb& stderr_lx,
                    const Vec3 (&rotation_gradient)[3], const Vec3 (&translation_gradient)[3]);

/// What require_finite() throws.
[[noreturn]] void throw_beyond_range(const DVec3& origin_m, const Vec3& p);

/// The record of such a place; its radius is the less of both distances, at most max_radius_m, and no more
/// than where the gradient would change a channel by its own value (docs/methods.md#a7). Throws
/// Error(numerical) where a value exceeds the range of numbers; `origin_m` is the scene's.
Made record_of(const RecordSite& site, const PlaceLight& light, const RecordOptions& resolved,
               const DVec3& origin_m = DVec3(0));

/// The record that its hemispheres (one or more passes, averaged) give: irradiance, standard error,
/// distance, radius and gradients (docs/methods.md#a7: harmonic or least distance, then limited by the
/// gradient). Shared by all estimators that sample hemispheres.
Made record_of(const RecordSite& site, std::span<const Hemisphere> passes, const RecordOptions& resolved);

}  // namespace phos::inline estimate
