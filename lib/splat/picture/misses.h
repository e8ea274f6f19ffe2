// Visible points without a record: which of them are told, and their file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"
#include "estimate/shading.h"

namespace phos::inline splat {

/// Puts misses in a pseudo-random order, so that the first few already cover the picture, and keeps at most
/// `most`.
void spread_misses(std::vector<Miss>& misses, std::uint64_t seed, std::size_t most);

/// CSV: x,y,z (m, of the world), nx,ny,nz. What phos-irradiance --at reads. Atomic.
void write_misses(const std::string& path, const std::vector<Miss>& misses, const DVec3& origin_m = DVec3(0));

}  // namespace phos::inline splat
