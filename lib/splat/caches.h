// The files that a picture is made from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/container.h"
#include "radiance/brdf/table.h"
#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "scene/scene.h"

namespace phos::inline splat {

/// How long records live.
struct RecordLives {
  std::vector<std::int32_t> frames;  ///< of each record; 0: of a cache that is no film
  std::int64_t most = 0;             ///< frames that the films let a record live; 0: there is no film
};

struct SplatCaches {
  /// Of all files together, the accuracy of the first (the others' radii are fitted to it), with the
  /// irradiance of radiance records.
  IrradianceCache irradiance;
  RecordLives lives;       ///< of irradiance.records, where asked for
  RadianceCache radiance;  ///< of all files together; empty where there is no such file, or nothing glossy
  std::vector<BrdfTable> brdf;  ///< empty where there is no such file
};

/// Does a file hold radiance records?
bool is_radiance(const Container& file);

/// Films are taken as they are at the scene's frame. `glossy`: does the scene have glossy materials? `lives`:
/// are the lives of records wanted? Throws
/// Error(mismatch) for records of different paths of light, or a film without that frame.
SplatCaches read_caches(const std::vector<Container>& files, const Scene& scene, bool glossy = true,
                        bool lives = false);

}  // namespace phos::inline splat
