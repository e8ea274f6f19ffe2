// Which triangles enclose a volume.
#pragma once

#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Of a soup of triangles, three corners each: is this triangle a part of a closed surface, and is it wound
/// so that its front faces outwards? Parts are triangles that hang together by the places of their corners,
/// however the file splits them; a part is closed where every edge belongs to an even number of its triangles
/// and it has a volume.
struct SolidParts {
  std::vector<bool> closed;      ///< by triangle
  std::vector<bool> inside_out;  ///< by triangle of a closed part: its signed volume is negative
};
SolidParts find_solid_parts(const std::vector<Vec3>& corner);

}  // namespace phos::inline scene
