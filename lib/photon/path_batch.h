// Paths that advance side by side.
#pragma once

#include <cstdint>

#include "photon/flight.h"
#include "photon/path_tracer.h"

namespace phos::inline photon {

/// Are so many paths of a part too long that nothing seems to absorb the light? Its photons would fill any
/// memory.
inline bool has_no_end(const PathPart& part) { return part.too_long() >= 16; }

/// Traces paths [begin, end), each with its aimed ones, as PathTracer::trace() does one after the other: the
/// photons are the same, but in `part` in an order of their own (PathPart::turn). In a large scene many paths
/// advance together, and ask the memory for the surfaces that they have met before they read them, which
/// takes a tenth less time. Stops once the part has_no_end().
void trace_paths(const PathTracer& tracer, std::uint64_t begin, std::uint64_t end, PathPart& part);

}  // namespace phos::inline photon
