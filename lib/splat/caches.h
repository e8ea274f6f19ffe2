// The files that a picture is made from.
#pragma once

#include <string>
#include <vector>

#include "cache/brdf_table.h"
#include "cache/irradiance_cache.h"
#include "file/container.h"

namespace phos {

struct SplatCaches {
  IrradianceCache irradiance;   ///< of all files together, the strictest accuracy
  std::vector<BrdfTable> brdf;  ///< empty where there is no such file
};

/// Opens .irradiance and .brdf files, told from their content. Throws Error(bad_input) for any other, or
/// where there is no irradiance among them.
std::vector<Container> open_caches(const std::vector<std::string>& paths);
/// Throws Error(mismatch) for irradiance of different paths of light.
SplatCaches read_caches(const std::vector<Container>& files);

}  // namespace phos
