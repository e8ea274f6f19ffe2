// Many directions decoded at once.
#pragma once

#include <cstdint>
#include <span>

#include "core/vector.h"

namespace phos {

/// decode_octahedral() of each code, the same bits; `unit` is at least as long as `codes`. Several times as
/// fast.
void decode_octahedral(std::span<const std::uint32_t> codes, std::span<Vec3> unit);

}  // namespace phos
