#include "core/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "core/options/arguments.h"
#include "core/options/described.h"
#include "core/options/help.h"
#include "core/options/manual.h"
#include "core/options/number.h"
#include "core/options/sheet.h"
#include "core/text/append_item.h"
#include "core/text/comma_list.h"
#include "core/text/likeness.h"
#include "core/text/named_files.h"

namespace phos {

struct Options::Impl : OptionSheet {
  std::string section = "Options";
  CLI::App app;
  std::vector<std::string> option_files;  // of @FILE
  bool help = false, version = false, manual = false, options_json = false;

  OptionDeclaration& declare(const std::string& names, const std::string& unit, const std::string& help_text,
                             InFiles in_files) {
    PHOS_CHECK(in_files.adopted == Adopted::no || in_files.recorded != Recorded::no, "option ", names);
    OptionDeclaration d;
    const std::size_t comma = names.find(',');
    d.name = names.substr(0, comma);
    if (comma != std::string::npos) d.short_name = names.substr(comma + 1);
    d.section = section, d.unit = unit, d.help = help_text, d.in_files = in_files;
    declarations.push_back(std::move(d));
    return declarations.back();
  }
  OptionDeclaration& declare_number(const std::string& names, const std::string& unit,
                                    const std::string& help_text, const char* kind, const Range& range,
                                    InFiles in_files) {
    OptionDeclaration& d = declare(names, unit, help_text, in_files);
    d.kind = kind, d.range = range, d.limits = limits_text(range);
    return d;
  }
  static std::string flags_of(const OptionDeclaration& d) {
    return (d.short_name.empty() ? "" : "-" + d.short_name + ",") + "--" + d.name;
  }
  /// An option that takes one value; `set` gets its text.
  void add(OptionDeclaration& d, const std::function<void(const std::string&)>& set) {
    d.initial = d.value();
    d.set = set;
    d.parsed = app.add_option_function<std::string>(flags_of(d), set)->take_last();
  }
  /// An option that may be given several times, each time with several items, which `split` takes apart.
  template <class Split>
  void add_several(OptionDeclaration& d, std::vector<std::string>& value, const Split& split) {
    const auto set = [&value, split](const std::vector<std::string>& words) {
      value.clear();
      for (const std::string& word : words)
        for (std::string& item : split(word)) value.push_back(std::move(item));
    };
    d.parsed = app.add_option_function<std::vector<std::string>>(flags_of(d), set)
                   ->expected(1)
                   ->take_all()
                   ->allow_extra_args(false);
  }
  [[noreturn]] void refuse_unknown(const std::string& option, const std::string& see) const {
    std::vector<std::string> names{"--help", "--version", "--man"};
    for (const OptionDeclaration& d : declarations)
      if (!d.is_input) names.push_back("--" + d.name);
    throw Error(ExitCode::usage, option, "no such option" + did_you_mean(option, names) + see);
  }
};

Options::Options(std::string tool, std::string summary, std::string description)
    : impl_(std::make_unique<Impl>()) {
  impl_->tool = std::move(tool), impl_->summary = std::move(summary),
  impl_->description = std::move(description);
  impl_->app.set_help_flag();
  impl_->app.add_flag("--help,-h", impl_->help);
  impl_->app.add_flag("--version", impl_->version);
  impl_->app.add_flag("--man", impl_->manual);
  impl_->app.add_flag("--options-json", impl_->options_json);
}

Options::~Options() = default;

const std::string& Options::tool() const { return impl_->tool; }
void Options::section(const std::string& title) { impl_->section = title; }
void Options::example(const std::string& command, const std::string& what) {
  impl_->examples.push_back({command, what});
}

void Options::flag(const std::string& name, bool& value, const std::string& help, InFiles in_files) {
  OptionDeclaration& d = impl_->declare(name, "", help, in_files);
  d.is_flag = true, d.kind = "flag";
  d.value = [&value] { return Json(value); };
  d.initial = d.value();
  d.set = [&value](const std::string& s) { value = s == "true"; };
  d.parsed = impl_->app.add_flag(Impl::flags_of(d), value);
}

void Options::number(const std::string& name, double& value, const std::string& unit, const std::string& help,
                     Range range, InFiles in_files) {
  OptionDeclaration& d = impl_->declare_number(name, unit, help, "number", range, in_files);
  d.default_text = shortest(value);
  d.value = [&value] { return Json(value); };
  impl_->add(
      d, [&value, range, n = d.name](const std::string& s) { value = parse_number<double>(n, s, range); });
}

void Options::number(const std::string& name, std::optional<double>& value, const std::string& unit,
                     const std::string& help, Range range, InFiles in_files) {
  OptionDeclaration& d = impl_->declare_number(name, unit, help, "number", range, in_files);
  d.default_text = value ? shortest(*value) : "";
  d.value = [&value] { return value ? Json(*value) : Json(); };
  impl_->add(
      d, [&value, range, n = d.name](const std::string& s) { value = parse_number<double>(n, s, range); });
}

void Options::integer(const std::string& name, std::int64_t& value, const std::string& unit,
                      const std::string& help, Range range, InFiles in_files) {
  OptionDeclaration& d = impl_->declare_number(name, unit, help, "integer", range, in_files);
  d.default_text = std::to_string(value);
  d.value = [&value] { return Json(value); };
  impl_->add(d, [&value, range, n = d.name](const std::string& s) {
    value = parse_number<std::int64_t>(n, s, range);
  });
}

void Options::integer(const std::string& name, std::optional<std::int64_t>& value, const std::string& unit,
                      const std::string& help, Range range, InFiles in_files) {
  OptionDeclaration& d = impl_->declare_number(name, unit, help, "integer", range, in_files);
  d.default_text = value ? std::to_string(*value) : "";
  d.value = [&value] { return value ? Json(*value) : Json(); };
  impl_->add(d, [&value, range, n = d.name](const std::string& s) {
    value = parse_number<std::int64_t>(n, s, range);
  });
}

void Options::text(const std::string& name, std::string& value, const std::string& unit,
                   const std::string& help, InFiles in_files) {
  OptionDeclaration& d = impl_->declare(name, unit, help, in_files);
  d.default_text = value;
  d.value = [&value] { return Json(value); };
  impl_->add(d, [&value](const std::string& s) { value = s; });
}

void Options::list(const std::string& name, std::vector<std::string>& value, const std::string& unit,
                   const std::string& help, InFiles in_files) {
  OptionDeclaration& d = impl_->declare(name, unit, help, in_files);
  d.kind = "list";
  d.value = [&value] {
    Json items = Json::Array{};
    for (const std::string& s : value) items.push_back(s);
    return items;
  };
  impl_->add_several(d, value, split_at_commas);
}

void Options::named_files(const std::string& name, std::vector<std::string>& value, const std::string& help,
                          Adopted adopted) {
  OptionDeclaration& d = impl_->declare(name, "NAME=FILE", phos::text(help, "; ", kNamedFileCommas),
                                        {Recorded::if_given, adopted});
  d.kind = "list";
  d.value = [&value] {
    Json names = Json::Array{};
    for (const std::string& s : value) names.push_back(name_of(s));
    return names;
  };
  // A name may hold the sign too: whatever follows one may be the file.
  d.paths = [&value] {
    std::vector<std::string> paths;
    for (const std::string& s : value)
      for (std::size_t at = 0; (at = s.find('=', at)) != std::string::npos;) paths.push_back(s.substr(++at));
    return paths;
  };
  impl_->add_several(d, value, split_named_files);
}

void Options::file(const std::string& name, std::string& value, const std::string& help, FileUse use,
                   bool required) {
  OptionDeclaration& d = impl_->declare(name, "FILE", help, Recorded::no);
  d.required = required, d.kind = "file", d.use = use;
  d.value = [&value] { return Json(value); };
  d.paths = [&value] { return std::vector<std::string>{value}; };
  impl_->add(d, [&value, use](const std::string& s) {
    value = use == FileUse::written && s == "-" ? "/dev/stdout" : s;
  });
}

void Options::choice_of_names(const std::string& name, const std::vector<std::string>& names,
                              std::size_t index, std::function<void(std::size_t)> set,
                              std::function<std::size_t()> current, const std::string& help,
                              InFiles in_files) {
  OptionDeclaration& d = impl_->declare(name, "WHICH", help, in_files);
  d.choices = names, d.default_text = names[index], d.kind = "choice";
  d.value = [current, names] { return Json(names[current()]); };
  impl_->add(d, [names, set, n = d.name](const std::string& s) {
    const auto found = std::find(names.begin(), names.end(), s);
    if (found == names.end()) {
      std::string all;
      for (const std::string& other : names) append_item(all, other);
      reject_option(n, phos::text("\"", s, "\" is not one of: ", all, did_you_mean(s, names)));
    }
    set(static_cast<std::size_t>(found - names.begin()));
  });
}

void Options::input(const std::string& placeholder, std::string& value, const std::string& help,
                    bool required) {
  OptionDeclaration& d = impl_->declare(placeholder, placeholder, help, Recorded::no);
  d.is_input = true, d.required = required, d.kind = "input";
  d.value = [&value] { return Json(value); };
  d.paths = [&value] { return std::vector<std::string>{value}; };
  d.parsed = impl_->app.add_option(placeholder, value);
}

void Options::inputs(const std::string& placeholder, std::vector<std::string>& values,
                     const std::string& help, bool required) {
  OptionDeclaration& d = impl_->declare(placeholder, placeholder + "...", help, Recorded::no);
  d.is_input = true, d.required = required, d.kind = "inputs";
  d.value = [] { return Json(); };
  d.paths = [&values] { return values; };
  d.parsed = impl_->app.add_option(placeholder, values)->expected(-1);
}

bool Options::parse(int argc, const char* const* argv) {
  std::vector<std::string> arguments = expand_files(argc, argv, impl_->option_files);
  const bool empty = arguments.empty();
  std::reverse(arguments.begin(), arguments.end());  // CLI11 pops from the back
  const std::string see = "; see " + impl_->tool + " --help";
  try {
    impl_->app.parse(arguments);
  } catch (const CLI::ExtrasError& e) {
    for (const std::string& word : impl_->app.remaining())
      if (word.starts_with("-")) impl_->refuse_unknown(word.substr(0, word.find('=')), see);
    throw Error(ExitCode::usage, "", e.what() + see);
  } catch (const CLI::ParseError& e) {
    std::string message = e.what();
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw Error(ExitCode::usage, "", message + see);
  }
  if (impl_->help || impl_->version || impl_->manual || impl_->options_json) {
    const std::string out = impl_->help      ? help()
                            : impl_->version ? impl_->tool + " " + phos::version() + "\n"
                            : impl_->manual  ? manual()
                                             : described(*impl_).dump(2) + "\n";
    std::fputs(out.c_str(), stdout);
    return false;
  }
  for (const OptionDeclaration& d : impl_->declarations)
    if (d.required && d.parsed->count() == 0)
      throw Error(ExitCode::usage, "",
                  (empty ? "usage: " + impl_->usage() : phos::text(d.left(), " is missing")) + see);
  for (const OptionDeclaration& d : impl_->declarations)
    if (!d.other_name.empty() && given(d.name) && given(d.other_name))
      reject_option(d.name, phos::text("sets the same as --", d.other_name, "; give one of the two"));
  return true;
}

void Options::another_name(const std::string& name, const std::string& other) {
  OptionDeclaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr && impl_->find(other) != nullptr, "option ", name, " or ", other);
  d->other_name = other;
}

void Options::adopt(const std::string& name, const Json& value) {
  OptionDeclaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr && d->set && d->in_files.recorded != Recorded::no, "option ", name);
  const std::string kind = d->kind;
  const bool fits = kind == "flag"                          ? value.is_bool()
                    : kind == "number" || kind == "integer" ? value.is_number()
                                                            : value.is_string();
  if (!fits) reject_option(name, "has a value of another kind; make the file that states it again");
  d->set(value.is_string() ? value.as_string() : value.dump());
  d->was_adopted = true;
}

bool Options::given(const std::string& name) const {
  const OptionDeclaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr, "option ", name);
  return d->parsed->count() > 0;
}

std::string Options::given_as(const std::string& name) const {
  if (given(name)) return name;
  for (const OptionDeclaration& d : impl_->declarations)
    if (d.other_name == name && given(d.name)) return d.name;
  return "";
}

std::string Options::first_given(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (given(name)) return std::string("--") + name;
  return "";
}

std::string Options::first_given_in(const std::string& section) const {
  for (const OptionDeclaration& d : impl_->declarations)
    if (!d.is_input && d.section == section && given(d.name)) return "--" + d.name;
  return "";
}

std::vector<std::string> Options::names() const {
  std::vector<std::string> names;
  for (const OptionDeclaration& d : impl_->declarations)
    if (!d.is_input) names.push_back(d.name);
  return names;
}

std::vector<std::string> Options::names(Adopted adopted) const { return impl_->names(adopted); }

std::vector<GivenFile> Options::files() const {
  std::vector<GivenFile> all;
  for (const OptionDeclaration& d : impl_->declarations) {
    if (!d.paths) continue;
    for (const std::string& path : d.paths())
      if (!path.empty()) all.push_back({d.is_input ? d.name : "--" + d.name, path, d.use});
  }
  for (const std::string& path : impl_->option_files) all.push_back({"@FILE", path, FileUse::read});
  return all;
}

Json Options::value(const std::string& name) const {
  const OptionDeclaration* d = impl_->find(name);
  return d ? d->value() : Json();
}

Json Options::unrecorded_value(const std::string& name) const {
  const OptionDeclaration* d = impl_->find(name);
  return d && d->in_files.recorded == Recorded::unless_default ? d->initial : Json();
}

Json Options::recorded() const {
  Json all = Json::Object{};
  for (const OptionDeclaration& d : impl_->declarations) {
    const Json value = d.value();
    if (d.in_files.recorded == Recorded::yes ||
        (d.in_files.recorded == Recorded::if_given && (d.was_adopted || given(d.name))) ||
        (d.in_files.recorded == Recorded::unless_default && !(value == d.initial)))
      all[d.name] = value;
  }
  return all;
}

std::string Options::command() const {
  std::string command = impl_->tool;
  const Json all = recorded();
  for (const auto& [name, value] : all.as_object()) {
    if (value.is_null() || (value.is_bool() && !value.as_bool())) continue;
    if (value.is_bool()) {
      command += " --" + name;
    } else if (value.is_array()) {
      for (const Json& item : value.as_array()) command += " --" + name + " " + item.as_string();
    } else if (value.is_string()) {
      if (value.as_string().empty()) continue;
      const bool plain = value.as_string().find_first_of(" \t\"'\\$`*?<>|&;()#~") == std::string::npos;
      command += " --" + name + " " + (plain ? value.as_string() : value.dump());
    } else {
      command += " --" + name + " " + value.dump();
    }
  }
  return command;
}

std::string Options::help() const { return help_text(*impl_); }
std::string Options::manual() const { return manual_page(*impl_); }

const char* version() { return PHOS_VERSION; }

}  // namespace phos
