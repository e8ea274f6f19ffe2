// The declarations of a program, from which its help, its manual page and its description in JSON are made.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/json.h"
#include "core/options.h"

namespace CLI {
class Option;
}

namespace phos {

/// What one declaration holds; help, manual and record are all made from it.
struct OptionDeclaration {
  std::string section, name, short_name, unit, help, limits;
  const char* kind = "text";
  std::vector<std::string> choices;
  Range range;
  InFiles in_files;
  std::string other_name;  // of the option whose value this one sets
  bool is_flag = false, is_input = false, required = false;
  std::function<Json()> value;
  std::function<void(const std::string&)> set;  // of options that take one value, or "true" and "false"
  bool was_adopted = false;
  FileUse use = FileUse::read;
  std::function<std::vector<std::string>()> paths;  // of options that name files
  std::string default_text;
  Json initial;  // value at the declaration, of Recorded::unless_default
  CLI::Option* parsed = nullptr;

  /// As lists of options show it: "-o, --output FILE", or the placeholder of an input.
  std::string left() const;
};

/// A command line and what it does.
struct OptionExample {
  std::string command, what;
};

/// All of a program, in the order of declaration.
struct OptionSheet {
  std::string tool, summary, description;
  std::vector<OptionDeclaration> declarations;
  std::vector<OptionExample> examples;

  /// Null: there is none of that name.
  OptionDeclaration* find(const std::string& name);
  const OptionDeclaration* find(const std::string& name) const;
  std::vector<std::string> names(Adopted adopted) const;
  /// The headings, without that of the inputs.
  std::vector<std::string> sections() const;
  /// "phos-splat [options] SCENE -o FILE"
  std::string usage() const;
  /// The help of one declaration with its choices, limits and default.
  std::string detail(const OptionDeclaration& d) const;
};

}  // namespace phos
