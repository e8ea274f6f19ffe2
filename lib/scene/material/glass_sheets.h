// Sheets that a file calls solid glass.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Parts of instances of KHR_materials_volume that enclose nothing, as they lie in one plane: panes that
/// exporters draw as one sheet with a thickness. Their instances get a material of their own, a thin pane of
/// that thickness: attenuation along the slanted way through it. Of a box without thickness one of its two
/// faces is left out. Said in scene.warnings.
void make_sheets_thin(Scene& scene);

}  // namespace phos::inline scene
