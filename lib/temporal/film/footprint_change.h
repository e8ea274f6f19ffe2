// Footprints of records that live in time (docs/methods.md#f8).
#pragma once

#include <memory>

#include "temporal/film/cache.h"

namespace phos::inline temporal {

/// The change per frame of the numbers of each axis, from a footprint to the next one at the same place,
/// `frames` later, by the same axes. Reach::stays: the light of the next is told on the lengths of the first,
/// which do not change.
std::shared_ptr<const AdaptiveFootprint::Axes> footprint_change(const AdaptiveFootprint::Axes& from,
                                                                const AdaptiveFootprint::Axes& to,
                                                                float frames, Reach reach);

/// Sets the footprint of `r`, which is film.record with the radius of that frame, to the footprint `age`
/// frames after its birth, and fits the radius to its longest axis. An axis that shrinks keeps the least
/// length that interpolation to any other leaves.
void change_footprint(const FilmRecord& film, float age, IrradianceRecord& r);

/// The same of lengths alone.
AdaptiveFootprint::Lengths footprint_change(const AdaptiveFootprint::Lengths& from,
                                            const AdaptiveFootprint::Lengths& to, float frames);
void change_footprint(const FilmRadianceRecord& film, float age, RadianceRecord& r);

}  // namespace phos::inline temporal
