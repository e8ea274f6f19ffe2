// Mirrors and glass in the message of a scene.
#pragma once

#include "scene/scene.h"
#include "view/message/writer.h"

namespace phos::inline view {

/// The table `part`: runs of triangles of one material, which lie in one flat mirror or in none; and the
/// table `mirror`: the planes of scene/mirror/planes.h, mirrors as well as panes.
void add_parts(const Scene& scene, MessageWriter& message);
/// The table `specular`, and the field of `material` that refers to it: the shares of light that each
/// material reflects as a mirror and lets through, for unpolarised light, textures at their mean. A face of
/// solid glass stands for itself; absorption inside solid glass is left out.
void add_specular(const Scene& scene, MessageWriter& message);

}  // namespace phos::inline view
