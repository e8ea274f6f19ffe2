// Projection of the glossy part of materials on hemispherical harmonics.
#pragma once

#include <cstdint>
#include <vector>

#include "core/counters.h"
#include "hsh/basis.h"
#include "radiance/brdf/table.h"
#include "scene/scene.h"

namespace phos::inline radiance {

/// The function of the incident direction that is projected, and its basis. `.brdf` files hold the default.
struct LobeFunction {
  BasisKind basis = BasisKind::hsh;  ///< sh: the function is 0 below the horizon
  bool whole = false;                ///< the Lambert part too; no delta lobe
  bool cosine = true;                ///< times the cosine of the incident direction
};

/// Projects the glossy part of one material (its textures at their mean, said in `note`), or `function` of
/// it: the table then holds the integrals of that function times the harmonics. A lobe that is too
/// intricate for the quadrature is marked "trace", whatever the options. Parallel; the same numbers on any
/// number of threads. Counted, per entry: lobes too intricate for the quadrature, albedo
/// above 1. Throws Error(usage) for options out of range.
BrdfTable project_brdf(const Scene& scene, std::uint32_t material, const BrdfTableOptions& options,
                       Counters& counters, const LobeFunction& function = {});

/// Materials that need a table: glossy ones that cover some surface.
std::vector<std::uint32_t> glossy_materials(const Scene& scene);

}  // namespace phos::inline radiance
