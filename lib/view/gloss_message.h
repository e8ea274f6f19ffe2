// Radiance records as the page draws them.
#pragma once

#include <cstdint>
#include <string>

#include "radiance/gloss_cache.h"
#include "scene/scene.h"

namespace phos::inline view {

/// MessageKind::gloss: the records of `cache`, whose slopes are those that pay at its accuracy, and the lobes
/// of materials that read them. Anisotropic lobes are left out. A record that serves materials of several
/// orders comes once for each. `cache` null: no records.
std::string gloss_message(const Scene& scene, const GlossCache* cache, double accuracy);
/// Does a material read the records, as the page does?
bool reads_records(const GlossCache* cache, std::uint32_t material);
/// Does any, and are there records?
bool has_gloss_records(const Scene& scene, const GlossCache* cache);

}  // namespace phos::inline view
