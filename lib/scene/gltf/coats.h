// KHR_materials_clearcoat and KHR_materials_sheen, within the material models that there are.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Puts clear coats and sheen into the metallic-roughness materials of the document, scene.material[i] being
/// materials[i], textures decoded: right in what is reflected in the mean over all directions.
///
/// A coat (glTF: a Fresnel lobe of index 1.5 over the base, which it dims) takes the place of the base's own
/// lobe where it is the brighter of the two and the base is no metal; the light that both lobes reflect
/// beyond that one goes to the base's diffuse part. Over a metal it is added to the metal's reflectance.
/// Sheen is added to the diffuse part. Under a base colour texture the addition is in proportion to the
/// texture. Materials that transmit and materials of extras.phos stay as they are.
void lay_coats(const GltfDocument& document, Scene& scene);

/// Mean over the hemisphere of the albedo of glTF's sheen (Charlie) of colour 1.
double mean_sheen_albedo(double roughness);

}  // namespace phos::inline scene
