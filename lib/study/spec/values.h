// The values that a study gives an option: one, a list, or a range.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "study/spec/tools.h"

namespace phos::inline study {

/// Values in the order in which they are tried. A range is a table {from, to, steps, scale}: `steps` values
/// from one end to the other, both included, evenly spaced (scale "linear", the default) or in equal ratios
/// ("log"); whole numbers are rounded, others to six digits. Throws Error(usage) with `where` for an empty
/// list, a value given twice, and a range that lacks an end, has fewer than two steps or more steps than
/// whole numbers, runs backwards, or is logarithmic and does not start above 0.
std::vector<Json> values_of(const ToolOption& option, const Json& asked, const std::string& where);

}  // namespace phos::inline study
