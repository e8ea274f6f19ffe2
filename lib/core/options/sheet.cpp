#include "core/options/sheet.h"

#include <algorithm>

#include "core/error.h"
#include "core/text/append_item.h"

namespace phos {

std::string OptionDeclaration::left() const {
  if (is_input) return unit;
  return (short_name.empty() ? "" : "-" + short_name + ", ") + "--" + name + (is_flag ? "" : " " + unit);
}

OptionDeclaration* OptionSheet::find(const std::string& name) {
  for (OptionDeclaration& d : declarations)
    if (d.name == name) return &d;
  return nullptr;
}

const OptionDeclaration* OptionSheet::find(const std::string& name) const {
  for (const OptionDeclaration& d : declarations)
    if (d.name == name) return &d;
  return nullptr;
}

std::vector<std::string> OptionSheet::names(Adopted adopted) const {
  std::vector<std::string> names;
  for (const OptionDeclaration& d : declarations)
    if (!d.is_input && d.in_files.adopted == adopted) names.push_back(d.name);
  return names;
}

std::vector<std::string> OptionSheet::sections() const {
  std::vector<std::string> names;
  for (const OptionDeclaration& d : declarations)
    if (!d.is_input && std::find(names.begin(), names.end(), d.section) == names.end())
      names.push_back(d.section);
  return names;
}

std::string OptionSheet::usage() const {
  std::string s = tool + " [options]";
  for (const OptionDeclaration& d : declarations)
    if (d.is_input) s += text(' ', d.required ? d.unit : text('[', d.unit, ']'));
  for (const OptionDeclaration& d : declarations)
    if (!d.is_input && d.required)
      s += d.short_name.empty() ? text(" --", d.name, ' ', d.unit) : text(" -", d.short_name, ' ', d.unit);
  return s;
}

std::string OptionSheet::detail(const OptionDeclaration& d) const {
  std::string s = d.help;
  if (d.use == FileUse::grown) {
    std::string list;
    for (const std::string& name : names(Adopted::estimate)) append_item(list, "--" + name);
    if (!list.empty()) s += "; options that are not given are taken from this file: " + list;
  }
  if (!d.choices.empty()) {
    s += " (";
    for (std::size_t i = 0; i < d.choices.size(); ++i) s.append(i == 0 ? "" : ", ").append(d.choices[i]);
    s += ")";
  }
  if (!d.limits.empty()) s += "; " + d.limits;
  if (d.required) s += d.is_input ? "" : " [required]";
  if (!d.default_text.empty()) s += " [" + d.default_text + "]";
  return s;
}

}  // namespace phos
