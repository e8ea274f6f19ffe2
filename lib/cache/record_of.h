// From what arrives at a place to the record of it.
#pragma once

#include <span>
#include <vector>

#include "cache/direct_light.h"
#include "cache/estimator.h"
#include "cache/hemisphere.h"
#include "cache/record_options.h"

namespace phos {

/// Light at a place, with what the radius of a record follows from.
struct PlaceLight {
  Rgb irradiance{0}, stderr_lx{0};
  float distance_m = kInfinity;  ///< of surroundings: harmonic mean or least, as RecordOptions::radius says
  Gradients gradients;
};

/// Means over passes, each weighted by its rays. Gradients by RecordOptions::gradients (the default ones
/// where the record is to have none: its radius asks for them); distances below min_radius_m count as that
/// much in them.
PlaceLight light_of(std::span<const Hemisphere> passes, const RecordOptions& resolved);

/// Adds the light of lamp samples at a place of unit normal n; `samples` of each area light were taken.
/// Gradients are the samples' own (FORMULAS B4: an area light moves as a surface does, a point light by 3 w /
/// d, a directional one not at all): blind to shadow edges. The harmonic distance becomes that of all light,
/// each part by its luminance.
void add_lamps(std::span<const LampSample> lamps, int samples, const Luminaires& lights, const Vec3& n,
               const RecordOptions& resolved, PlaceLight& light);

/// The record of such a place; its radius is the distance, at most max_radius_m, and no more than where the
/// gradient would change a channel by its own value (A7). Throws Error(numerical) where a value exceeds the
/// range of numbers.
Made record_of(const RecordSite& site, const PlaceLight& light, const RecordOptions& resolved);

}  // namespace phos
