// What hangs together of a soup of triangles.
#pragma once

#include <cstddef>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Of triangles of three corners each. Corners at the same place are one, however the file splits its meshes.
struct ConnectedParts {
  std::vector<std::size_t> place;  ///< of each corner: the same number, the same place
  std::vector<std::size_t> part;   ///< of each triangle: from 0, in the order of their first triangles
  std::size_t parts = 0;
};
ConnectedParts find_connected_parts(const std::vector<Vec3>& corner);

}  // namespace phos::inline scene
