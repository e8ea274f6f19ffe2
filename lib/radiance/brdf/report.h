// What there is to say of a table of glossy reflection: in a header, in figures, in words.
#pragma once

#include <string>
#include <vector>

#include "core/counters.h"
#include "core/json.h"
#include "radiance/brdf/table.h"

namespace phos::inline radiance {

/// Name and shape of a table (material, index, isotropic, resolution, order, albedo, note): its header in the
/// `.brdf` file.
Json header_of(const BrdfTable& table);

/// The same with summarize(), for --stats. `model`: name of the material's model.
Json figures_of(const BrdfTable& table, const std::string& model);

/// "floor": phong, orders 6 to 9, ...
std::string sentence_of(const BrdfTable& table, const std::string& model);

/// What the user should know of events that project_brdf() counted; nothing if all went well.
std::vector<std::string> warnings_of(const BrdfTable& table, const Counters& counters);

}  // namespace phos::inline radiance
