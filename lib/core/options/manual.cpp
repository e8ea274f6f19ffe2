#include "core/options/manual.h"

#include <algorithm>
#include <cctype>

#include "core/facts/exit_codes.h"
#include "core/options/sheet.h"

namespace phos {
namespace {

std::string roff(const std::string& s) {
  std::string out;
  for (const char c : s) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += "\\&", out += c;
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string manual_page(const OptionSheet& sheet) {
  std::string title = sheet.tool;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return static_cast<char>(std::toupper(c)); });
  std::string out = ".TH " + title + " 1 \"\" \"phos " + phos::version() + "\" \"phos manual\"\n";
  out += ".SH NAME\n" + roff(sheet.tool) + " \\- " + roff(sheet.summary) + "\n";
  out += ".SH SYNOPSIS\n.B " + roff(sheet.usage()) + "\n.SH DESCRIPTION\n" + roff(sheet.description) + "\n";
  const auto entry = [&](const std::string& left, const std::string& right) {
    out += ".TP\n.B " + roff(left) + "\n" + roff(right) + "\n";
  };
  out += ".SH INPUTS\n";
  for (const OptionDeclaration& d : sheet.declarations)
    if (d.is_input) entry(d.left(), sheet.detail(d));
  out += ".SH OPTIONS\n";
  for (const std::string& section : sheet.sections()) {
    out += ".SS " + roff(section) + "\n";
    for (const OptionDeclaration& d : sheet.declarations)
      if (!d.is_input && d.section == section) entry(d.left(), sheet.detail(d));
  }
  if (!sheet.examples.empty()) out += ".SH EXAMPLES\n";
  for (const OptionExample& e : sheet.examples) entry(e.command, e.what);
  out += ".SH EXIT STATUS\n";
  for (const ExitMeaning& row : exit_meanings())
    entry(std::to_string(static_cast<int>(row.code)), std::string(row.meaning));
  return out;
}

}  // namespace phos
