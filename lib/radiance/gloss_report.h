// What computes the gloss of each material, told to people and scripts.
#pragma once

#include <string>

#include "core/json.h"
#include "radiance/gloss_tables.h"

namespace phos::inline radiance {

/// Per glossy material: "material" (its name), "index", "order" (bands of its radiance records, 0: none),
/// "traced_share" (of directions) and "why".
Json gloss_report(const Scene& scene, const GlossTables& tables);

/// A line for each.
std::string gloss_text(const Json& report);

/// Adds the report to the answer of describe_scene() as "gloss", and to the requirements there: radiance
/// records and traced gloss stand in for "gloss".
void add_gloss(Json& description, const Json& report);

}  // namespace phos::inline radiance
