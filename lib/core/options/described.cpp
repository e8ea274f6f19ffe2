#include "core/options/described.h"

#include <cmath>

#include "core/options/sheet.h"

namespace phos {

Json described(const OptionSheet& sheet) {
  Json::Array all;
  for (const OptionDeclaration& d : sheet.declarations) {
    Json o;
    o["name"] = d.name, o["kind"] = d.kind, o["unit"] = d.unit, o["help"] = d.help;
    o["default"] = d.is_input ? Json() : d.value();
    o["required"] = d.required, o["recorded"] = d.in_files.recorded != Recorded::no;
    if (!d.is_input) o["section"] = d.section;
    if (d.in_files.adopted != Adopted::no)
      o["adopted"] = d.in_files.adopted == Adopted::estimate ? "estimate" : "site";
    if (!d.short_name.empty()) o["short"] = d.short_name;
    if (!d.choices.empty()) o["choices"] = Json::Array(d.choices.begin(), d.choices.end());
    if (std::isfinite(d.range.lo)) o["min"] = d.range.lo, o["min_excluded"] = d.range.lo_open;
    if (std::isfinite(d.range.hi)) o["max"] = d.range.hi;
    all.push_back(std::move(o));
  }
  Json whole;
  whole["tool"] = sheet.tool, whole["version"] = phos::version(), whole["summary"] = sheet.summary;
  whole["options"] = std::move(all);
  return whole;
}

}  // namespace phos
