// How fast light changes, and how long a record may live by that (docs/methods.md#f1 to #f4).
#pragma once

#include <cstdint>
#include <span>

#include "core/vector.h"

namespace phos::inline temporal {

/// docs/methods.md#f2: relative change per frame, |l1 - l0| / max(|l0|, floor), of vectors of numbers (RGB,
/// coefficients: their basis is orthonormal, so that it is the change of radiance over the hemisphere).
/// `floor` is above 0, in their unit. 0 where nothing changes, also at l0 = 0.
double change_rate(std::span<const float> now, std::span<const float> next, double floor);
double change_rate(const Rgb& now, const Rgb& next, double floor);

/// docs/methods.md#f4: whole frames, clamp(floor(accuracy / rate), 1, max_life); a rate of 0 gives max_life.
std::int64_t life_of(double rate, double accuracy, std::int64_t max_life);

/// The weight by age (docs/methods.md#f1), bounded, for products with weights in space: max(0, 1 - rate age /
/// accuracy), 0 from max_life on; 1 at age 0.
double time_weight(double rate, double age, double accuracy, std::int64_t max_life);

}  // namespace phos::inline temporal
