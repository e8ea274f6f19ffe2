// Numbers out of a glTF accessor: strided, sparse, normalised, of any component type.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf/document.h"

namespace phos::inline scene {

/// The accessor's values as floats, `components` each, in order. Normalised integers are mapped to [0,1] or
/// [-1,1]. Throws Error(bad_input) if it has another number of components or reaches outside its buffer.
std::vector<float> read_floats(const GltfDocument& document, int accessor, int components);
/// Unsigned integers (triangle indices, joints). Throws Error(bad_input) for other component types.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor, int components = 1);
/// Numbers per element of the accessor (3 for VEC3).
int accessor_components(const GltfDocument& document, int accessor);

}  // namespace phos::inline scene
