// The weight of a record at a place, and how its light is carried there (record/weight.inc), for one place.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vector.h"

namespace phos::inline record {

/// The least weight that counts: below it a record is not valid, and a point without others is a miss.
inline constexpr float kLeastWeight = 1e-6f;
/// How far a record may lie behind the plane between itself and the point it lights, in units of its radius.
inline constexpr float kFrontTolerance = 0.01f;
/// How far over a record's plane a point may lie that it lights: its mean distance to the surroundings,
/// however large its radius has been made. In a niche or behind a cornice this distance is small, and places
/// beyond have other light.
inline float over_limit_m(float distance_m, float radius_m) {
  return std::max(distance_m, kFrontTolerance * radius_m);
}
/// An extrapolated irradiance is at most this many times the record's.
inline constexpr float kGrowthLimit = 2;

inline float root(float x) { return std::sqrt(x); }
inline float in_units(float x, float unit) { return x / unit; }

#define CONSTANT inline constexpr
#define FORMULA inline
#define Real float
#define Vec const Vec3&
#define Own float
#define OwnVec const Vec3&
#include "record/weight.inc"
#undef CONSTANT
#undef FORMULA
#undef Real
#undef Vec
#undef Own
#undef OwnVec

}  // namespace phos::inline record
