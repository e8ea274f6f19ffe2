// How lamps shine in gloss, in the message of a scene.
#pragma once

#include "scene/scene.h"
#include "view/message/writer.h"

namespace phos::inline view {

/// The fields `glint` of the table `material`. Textures are at their mean; an anisotropic lobe has the
/// geometric mean of its two widths; measured lobes have none.
void add_glints(const Scene& scene, MessageWriter& message);

}  // namespace phos::inline view
