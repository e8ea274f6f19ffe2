// Checks that a glTF document's JSON is as the rest of the reader expects.
#pragma once

#include <string>

#include "core/json.h"

namespace phos::inline scene {

/// Checks types, ranges of numbers, and every index against the length of the array it points into. Throws
/// Error(bad_input) with the place and the value ("accessors[3].bufferView is 7, but there are 5
/// bufferViews").
void check_gltf(const Json& document, const std::string& path);

}  // namespace phos::inline scene
