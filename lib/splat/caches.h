// The files that a picture is made from.
#pragma once

#include <string>
#include <vector>

#include "file/container.h"
#include "radiance/brdf/table.h"
#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "scene/scene.h"

namespace phos::inline splat {

struct SplatCaches {
  /// Of all files together, the accuracy of the first (the others' radii are fitted to it), with the
  /// irradiance of radiance records.
  IrradianceCache irradiance;
  RadianceCache radiance;  ///< of all files together; empty where there is no such file, or nothing glossy
  std::vector<BrdfTable> brdf;  ///< empty where there is no such file
};

/// Does a file hold radiance records?
bool is_radiance(const Container& file);

/// Films are taken as they are at the scene's frame. `glossy`: does the scene have glossy materials? Throws
/// Error(mismatch) for records of different paths of light, or a film without that frame.
SplatCaches read_caches(const std::vector<Container>& files, const Scene& scene, bool glossy = true);

}  // namespace phos::inline splat
