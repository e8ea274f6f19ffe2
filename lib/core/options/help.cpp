#include "core/options/help.h"

#include "core/facts/exit_codes.h"
#include "core/options/sheet.h"
#include "core/text/wrap.h"

namespace phos {

std::string help_text(const OptionSheet& sheet) {
  constexpr std::size_t kColumn = 28;
  std::string out = sheet.tool + " - " + sheet.summary + "\n\nUsage: " + sheet.usage() + "\n\n" +
                    wrap(sheet.description, 0) + "\n";
  const auto line = [&](const std::string& left, const std::string& right) {
    out += list_entry(left, right, kColumn);
  };
  bool heading = false;
  for (const OptionDeclaration& d : sheet.declarations) {
    if (!d.is_input) continue;
    if (!heading) out += "\nInputs:\n";
    heading = true;
    line(d.left(), sheet.detail(d));
  }
  for (const std::string& section : sheet.sections()) {
    out += "\n" + section + ":\n";
    for (const OptionDeclaration& d : sheet.declarations)
      if (!d.is_input && d.section == section) line(d.left(), sheet.detail(d));
  }
  out += "\nOther:\n";
  line("-h, --help", "print this text");
  line("--version", "print the version");
  line("--man", "print the manual page; phos-X --man | man -l - shows it");
  line("--options-json",
       "print every option with its kind, unit, range, choices and default, for other programs");
  line("@FILE", "read options from a file: one per line, name=value, or a flag alone; # starts a comment");
  if (!sheet.examples.empty()) out += "\nExamples:\n";
  for (const OptionExample& e : sheet.examples) out += "  " + e.command + "\n      " + wrap(e.what, 6) + "\n";
  out += "\nExit codes:\n";
  for (const ExitMeaning& row : exit_meanings())
    line(std::to_string(static_cast<int>(row.code)), std::string(row.meaning));
  return out;
}

}  // namespace phos
