// Compressed geometry of glTF files, which is not decoded.
#pragma once

#include "core/json.h"

namespace phos::inline scene {

/// Throws Error(bad_input) with `path` for a mesh or buffer whose data an extension compresses, unless the
/// file holds them uncompressed beside it; names mesh and extension. `document` has passed check_gltf().
void require_uncompressed(const Json& document, const std::string& path);

}  // namespace phos::inline scene
