// Records on every surface.
#pragma once

#include "place/placement.h"

namespace phos::inline place {

/// Covers every surface that is not purely specular, from both sides, but for sides inside of solids.
/// Triangles are halved until each piece lies within the reach of one record or is small beside it; a
/// record is made at the middle of a piece that nothing covers. Repeated, since neighbours shrink each
/// other's reach, until a pass finds less than kSurfaceShare of the area open, or `passes` are done. With
/// `wanted`, surfaces of other materials are none. With placement.error, records start far apart and come
/// nearer to each other where they foretell each other wrongly (Refinement), kErrorPasses times at most;
/// their gradients then follow from their neighbours too.
PlacementReport place_on_surfaces(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                                  const RecordOptions& resolved, const PlacementOptions& placement,
                                  Counters& counters, const MaterialFilter& wanted = {});
inline constexpr double kSurfaceShare = 1e-4;
inline constexpr int kErrorPasses = 10;

}  // namespace phos::inline place
