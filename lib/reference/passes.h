// Passes of light paths, and how the radius within which paths are merged falls from one to the next.
#pragma once

#include <cstdint>

#include "reference/bidirectional.h"

namespace phos::inline reference {

/// Square of the radius of pass i (from 0) over its value in the first pass: r_(i+1)^2 = r_i^2 (i + 2/3) /
/// (i + 1), i from 1 (Knaus and Zwicker 2011): the bias of the mean of all passes and its variance both fall
/// to nothing.
double shrunk_area(std::uint64_t pass);

/// Radius within which eye paths are merged with light paths in the first pass, m: a part of the scene's.
float first_merge_radius_m(const Scene& scene);

/// Light paths of pass `pass`. `item`: of the random stream of the first pass; the items of the passes follow
/// each other. Nothing is merged where `radius_m` is 0.
LightPass make_pass(const LightTracer& tracer, std::uint64_t seed, std::uint64_t pass, std::size_t paths,
                    float radius_m);

/// Bit that distinguishes the random streams of light paths from the streams of eye paths.
inline constexpr std::uint64_t kLightItem = std::uint64_t{1} << 62;

}  // namespace phos::inline reference
