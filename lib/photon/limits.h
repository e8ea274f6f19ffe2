// Limits of photons: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline photon {

inline constexpr Limit kMostPhotons{"photons of one map", 0x7fffffff, "exit code 5"};
inline constexpr Limit kMostPhotonEvents{
    "surfaces that a photon meets", 65534,
    "the path ends and is counted; exit code 5 where more than one path in a million ends so"};

inline constexpr const Limit* kPhotonLimits[] = {&kMostPhotons, &kMostPhotonEvents};

}  // namespace phos::inline photon
