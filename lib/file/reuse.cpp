#include "file/reuse.h"

#include "core/error.h"

namespace phos::inline file {

namespace {

std::string program(const std::string& tool) { return tool.substr(0, tool.find(' ')); }

const Json::Object& members(const Json& v) {
  static const Json::Object kNone;
  return v.is_object() ? v.as_object() : kNone;
}

}  // namespace

std::vector<std::string> differences(const Provenance& then, const Provenance& now) {
  std::vector<std::string> lines;
  if (program(then.tool) != program(now.tool)) lines.push_back(text("tool: ", then.tool, " -> ", now.tool));
  if (then.algorithm != now.algorithm)
    lines.push_back(text("tool algorithm: ", then.algorithm, " -> ", now.algorithm));
  for (const auto& [name, value] : members(now.parameters)) {
    const Json* before = then.parameters.find(name);
    if (value.is_null()) continue;
    if (before == nullptr)
      lines.push_back(text("parameter ", name, ": absent -> ", value.dump()));
    else if (before->dump() != value.dump())  // 1 and 1.0 are one number
      lines.push_back(text("parameter ", name, ": ", before->dump(), " -> ", value.dump()));
  }
  for (const auto& [name, value] : members(then.parameters))
    if (now.parameters.find(name) == nullptr)
      lines.push_back(text("parameter ", name, ": ", value.dump(), " -> absent"));
  for (const auto& [role, hash] : now.inputs) {
    const auto before = then.inputs.find(role);
    if (before == then.inputs.end())
      lines.push_back(text("input ", role, ": new"));
    else if (before->second != hash)
      lines.push_back(text("input ", role, ": changed"));
  }
  for (const auto& [role, hash] : then.inputs)
    if (!now.inputs.contains(role)) lines.push_back(text("input ", role, ": no longer given"));
  return lines;
}

}  // namespace phos::inline file
