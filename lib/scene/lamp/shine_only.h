// A scene in which some of its lamps shine, and the others are dark.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// Names of the lamps of a scene, each once, sorted: of its lights, of the nodes that emit, and "environment"
/// for a map, sky and sun. Works before finalize() and after.
std::vector<std::string> lamp_names(const Scene& scene);

/// Before finalize(). Makes every lamp dark that `names` (comma by comma: split_known_names()) leaves out:
/// removes its light, replaces the material of its surface by a copy without emission, and takes the
/// environment away. Geometry and reflectance stay. Light is additive, so the light of disjoint groups of
/// lamps adds up to all light. Throws Error(usage) for "--lamps" that names the likest lamp where no lamp has
/// the name.
void shine_only(Scene& scene, const std::string& names);

/// Indices in scene.light of the lamps that `names` lists, in rising order; all where it is "". Names that no
/// light has are passed over: finalize() takes black lamps away.
std::vector<std::uint32_t> lamps_named(const Scene& scene, const std::string& names);

}  // namespace phos::inline scene
