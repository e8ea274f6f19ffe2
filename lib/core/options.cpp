#include "core/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/facts/exit_codes.h"
#include "core/facts/limit.h"
#include "core/text/comma_list.h"
#include "core/text/likeness.h"
#include "core/text/named_files.h"
#include "core/text/wrap.h"

namespace phos {

namespace {

/// What one declaration holds; help, manual and record are all made from it.
struct Declaration {
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
};

struct Example {
  std::string command, what;
};

std::string limits_text(const Range& range) {
  const bool has_lo = std::isfinite(range.lo);
  const bool has_hi = std::isfinite(range.hi);
  if (has_lo && has_hi)
    return text(range.lo_open ? "above " : "", shortest(range.lo), " to ", shortest(range.hi));
  if (has_lo) return text(range.lo_open ? "above " : "at least ", shortest(range.lo));
  if (has_hi) return text("at most ", shortest(range.hi));
  return "";
}

[[noreturn]] void reject(const std::string& name, const std::string& why) {
  throw Error(ExitCode::usage, "--" + name, why);
}

template <class T>
T parse_number(const std::string& name, const std::string& s, const Range& range) {
  T v{};
  const char* begin = s.data() + (s.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, s.data() + s.size(), v);
  if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(static_cast<double>(v)))
    reject(name, text("\"", s, "\" is not ", std::is_integral_v<T> ? "a whole number" : "a number"));
  const auto wide = static_cast<double>(v);
  if (wide < range.lo || wide > range.hi || (range.lo_open && wide == range.lo))
    reject(name, text(s, " is out of range; it must be ", limits_text(range)));
  return v;
}

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

std::string exit_code(const ExitMeaning& row) { return std::to_string(static_cast<int>(row.code)); }

}  // namespace

struct Options::Impl {
  std::string tool, summary, description, section = "Options";
  CLI::App app;
  std::vector<Declaration> declarations;
  std::vector<Example> examples;
  std::vector<std::string> option_files;  // of @FILE
  bool help = false, version = false, manual = false, options_json = false;

  Declaration& declare(const std::string& names, const std::string& unit, const std::string& help_text,
                       InFiles in_files) {
    PHOS_CHECK(in_files.adopted == Adopted::no || in_files.recorded != Recorded::no, "option ", names);
    Declaration d;
    const std::size_t comma = names.find(',');
    d.name = names.substr(0, comma);
    if (comma != std::string::npos) d.short_name = names.substr(comma + 1);
    d.section = section, d.unit = unit, d.help = help_text, d.in_files = in_files;
    declarations.push_back(std::move(d));
    return declarations.back();
  }
  Declaration& declare_number(const std::string& names, const std::string& unit, const std::string& help_text,
                              const char* kind, const Range& range, InFiles in_files) {
    Declaration& d = declare(names, unit, help_text, in_files);
    d.kind = kind, d.range = range, d.limits = limits_text(range);
    return d;
  }
  static std::string flags_of(const Declaration& d) {
    return (d.short_name.empty() ? "" : "-" + d.short_name + ",") + "--" + d.name;
  }
  /// An option that takes one value; `set` gets its text.
  void add(Declaration& d, const std::function<void(const std::string&)>& set) {
    d.initial = d.value();
    d.set = set;
    d.parsed = app.add_option_function<std::string>(flags_of(d), set)->take_last();
  }
  /// An option that may be given several times, each time with several items, which `split` takes apart.
  template <class Split>
  void add_several(Declaration& d, std::vector<std::string>& value, const Split& split) {
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
  Declaration* find(const std::string& name) {
    for (Declaration& d : declarations)
      if (d.name == name) return &d;
    return nullptr;
  }
  const Declaration* find(const std::string& name) const {
    for (const Declaration& d : declarations)
      if (d.name == name) return &d;
    return nullptr;
  }
  [[noreturn]] void refuse_unknown(const std::string& option, const std::string& see) const {
    std::vector<std::string> names{"--help", "--version", "--man"};
    for (const Declaration& d : declarations)
      if (!d.is_input) names.push_back("--" + d.name);
    throw Error(ExitCode::usage, option, "no such option" + did_you_mean(option, names) + see);
  }
  std::vector<std::string> names(Adopted adopted) const {
    std::vector<std::string> names;
    for (const Declaration& d : declarations)
      if (!d.is_input && d.in_files.adopted == adopted) names.push_back(d.name);
    return names;
  }
  std::string detail(const Declaration& d) const {
    std::string s = d.help;
    if (d.use == FileUse::grown) {
      std::string list;
      for (const std::string& name : names(Adopted::estimate)) list += (list.empty() ? "--" : ", --") + name;
      if (!list.empty()) s += "; what is not given of these options is taken from it: " + list;
    }
    if (!d.choices.empty()) {
      s += " (";
      for (std::size_t i = 0; i < d.choices.size(); ++i) s += (i == 0 ? "" : ", ") + d.choices[i];
      s += ")";
    }
    if (!d.limits.empty()) s += "; " + d.limits;
    if (d.required) s += d.is_input ? "" : " [required]";
    if (!d.default_text.empty()) s += " [" + d.default_text + "]";
    return s;
  }
  static std::string left(const Declaration& d) {
    if (d.is_input) return d.unit;
    return (d.short_name.empty() ? "" : "-" + d.short_name + ", ") + "--" + d.name +
           (d.is_flag ? "" : " " + d.unit);
  }
  std::string usage() const {
    std::string s = tool + " [options]";
    for (const Declaration& d : declarations)
      if (d.is_input) s += " " + (d.required ? d.unit : "[" + d.unit + "]");
    for (const Declaration& d : declarations)
      if (!d.is_input && d.required)
        s += " " + (d.short_name.empty() ? "--" + d.name : "-" + d.short_name) + " " + d.unit;
    return s;
  }
  /// The content of --help, for programs.
  Json described() const {
    Json::Array all;
    for (const Declaration& d : declarations) {
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
    whole["tool"] = tool, whole["version"] = phos::version(), whole["summary"] = summary;
    whole["options"] = std::move(all);
    return whole;
  }
  std::vector<std::string> sections() const {
    std::vector<std::string> names;
    for (const Declaration& d : declarations)
      if (!d.is_input && std::find(names.begin(), names.end(), d.section) == names.end())
        names.push_back(d.section);
    return names;
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
  Declaration& d = impl_->declare(name, "", help, in_files);
  d.is_flag = true, d.kind = "flag";
  d.value = [&value] { return Json(value); };
  d.initial = d.value();
  d.set = [&value](const std::string& s) { value = s == "true"; };
  d.parsed = impl_->app.add_flag(Impl::flags_of(d), value);
}

void Options::number(const std::string& name, double& value, const std::string& unit, const std::string& help,
                     Range range, InFiles in_files) {
  Declaration& d = impl_->declare_number(name, unit, help, "number", range, in_files);
  d.default_text = shortest(value);
  d.value = [&value] { return Json(value); };
  impl_->add(
      d, [&value, range, n = d.name](const std::string& s) { value = parse_number<double>(n, s, range); });
}

void Options::number(const std::string& name, std::optional<double>& value, const std::string& unit,
                     const std::string& help, Range range, InFiles in_files) {
  Declaration& d = impl_->declare_number(name, unit, help, "number", range, in_files);
  d.default_text = value ? shortest(*value) : "";
  d.value = [&value] { return value ? Json(*value) : Json(); };
  impl_->add(
      d, [&value, range, n = d.name](const std::string& s) { value = parse_number<double>(n, s, range); });
}

void Options::integer(const std::string& name, std::int64_t& value, const std::string& unit,
                      const std::string& help, Range range, InFiles in_files) {
  Declaration& d = impl_->declare_number(name, unit, help, "integer", range, in_files);
  d.default_text = std::to_string(value);
  d.value = [&value] { return Json(value); };
  impl_->add(d, [&value, range, n = d.name](const std::string& s) {
    value = parse_number<std::int64_t>(n, s, range);
  });
}

void Options::integer(const std::string& name, std::optional<std::int64_t>& value, const std::string& unit,
                      const std::string& help, Range range, InFiles in_files) {
  Declaration& d = impl_->declare_number(name, unit, help, "integer", range, in_files);
  d.default_text = value ? std::to_string(*value) : "";
  d.value = [&value] { return value ? Json(*value) : Json(); };
  impl_->add(d, [&value, range, n = d.name](const std::string& s) {
    value = parse_number<std::int64_t>(n, s, range);
  });
}

void Options::text(const std::string& name, std::string& value, const std::string& unit,
                   const std::string& help, InFiles in_files) {
  Declaration& d = impl_->declare(name, unit, help, in_files);
  d.default_text = value;
  d.value = [&value] { return Json(value); };
  impl_->add(d, [&value](const std::string& s) { value = s; });
}

void Options::list(const std::string& name, std::vector<std::string>& value, const std::string& unit,
                   const std::string& help, InFiles in_files) {
  Declaration& d = impl_->declare(name, unit, help, in_files);
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
  Declaration& d = impl_->declare(name, "NAME=FILE", phos::text(help, "; ", kNamedFileCommas),
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
  Declaration& d = impl_->declare(name, "FILE", help, Recorded::no);
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
  Declaration& d = impl_->declare(name, "WHICH", help, in_files);
  d.choices = names, d.default_text = names[index], d.kind = "choice";
  d.value = [current, names] { return Json(names[current()]); };
  impl_->add(d, [names, set, n = d.name](const std::string& s) {
    const auto found = std::find(names.begin(), names.end(), s);
    if (found == names.end()) {
      std::string all;
      for (const std::string& other : names) all += (all.empty() ? "" : ", ") + other;
      reject(n, phos::text("\"", s, "\" is not one of: ", all));
    }
    set(static_cast<std::size_t>(found - names.begin()));
  });
}

void Options::input(const std::string& placeholder, std::string& value, const std::string& help,
                    bool required) {
  Declaration& d = impl_->declare(placeholder, placeholder, help, Recorded::no);
  d.is_input = true, d.required = required, d.kind = "input";
  d.value = [&value] { return Json(value); };
  d.paths = [&value] { return std::vector<std::string>{value}; };
  d.parsed = impl_->app.add_option(placeholder, value);
}

void Options::inputs(const std::string& placeholder, std::vector<std::string>& values,
                     const std::string& help, bool required) {
  Declaration& d = impl_->declare(placeholder, placeholder + "...", help, Recorded::no);
  d.is_input = true, d.required = required, d.kind = "inputs";
  d.value = [] { return Json(); };
  d.paths = [&values] { return values; };
  d.parsed = impl_->app.add_option(placeholder, values)->expected(-1);
}

namespace {

/// Any file, or a pipe; not without end.
std::string options_text(const std::string& path) {
  constexpr auto kMost = kMostOptionsFileBytes.as<std::size_t>();
  std::ifstream in(path, std::ios::binary);
  std::string text(kMost + 1, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (!in && !in.eof())) throw Error(ExitCode::bad_input, path, "options file cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMost) throw Error(ExitCode::bad_input, path, "options file is larger than 1 MiB");
  return text;
}

/// Replaces each @file by the options it holds: one per line, `name=value`, `name value` or a flag; # starts
/// a comment.
std::vector<std::string> expand_files(int argc, const char* const* argv, std::vector<std::string>& files) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.size() < 2 || argument[0] != '@') {
      arguments.push_back(argument);
      continue;
    }
    files.push_back(argument.substr(1));
    std::istringstream in(options_text(files.back()));
    for (std::string line; std::getline(in, line);) {
      line = line.substr(0, line.find('#'));
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string::npos) continue;
      line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
      if (!line.starts_with("--")) line = "--" + line;
      const std::size_t split = line.find_first_of("= \t");
      arguments.push_back(line.substr(0, split));
      if (split == std::string::npos) continue;
      const std::size_t value = line.find_first_not_of("= \t", split);
      arguments.push_back(value == std::string::npos ? "" : line.substr(value));  // "name =": of nothing
    }
  }
  return arguments;
}

}  // namespace

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
                                             : impl_->described().dump(2) + "\n";
    std::fputs(out.c_str(), stdout);
    return false;
  }
  for (const Declaration& d : impl_->declarations)
    if (d.required && d.parsed->count() == 0)
      throw Error(ExitCode::usage, "",
                  (empty ? "usage: " + impl_->usage() : phos::text(Impl::left(d), " is missing")) + see);
  for (const Declaration& d : impl_->declarations)
    if (!d.other_name.empty() && given(d.name) && given(d.other_name))
      reject(d.name, phos::text("says what --", d.other_name, " says; give one of the two"));
  return true;
}

void Options::another_name(const std::string& name, const std::string& other) {
  Declaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr && impl_->find(other) != nullptr, "option ", name, " or ", other);
  d->other_name = other;
}

void Options::adopt(const std::string& name, const Json& value) {
  Declaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr && d->set && d->in_files.recorded != Recorded::no, "option ", name);
  const std::string kind = d->kind;
  const bool fits = kind == "flag"                          ? value.is_bool()
                    : kind == "number" || kind == "integer" ? value.is_number()
                                                            : value.is_string();
  if (!fits) reject(name, "is of another kind");
  d->set(value.is_string() ? value.as_string() : value.dump());
  d->was_adopted = true;
}

bool Options::given(const std::string& name) const {
  const Declaration* d = impl_->find(name);
  PHOS_CHECK(d != nullptr, "option ", name);
  return d->parsed->count() > 0;
}

std::string Options::given_as(const std::string& name) const {
  if (given(name)) return name;
  for (const Declaration& d : impl_->declarations)
    if (d.other_name == name && given(d.name)) return d.name;
  return "";
}

std::string Options::first_given(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (given(name)) return std::string("--") + name;
  return "";
}

std::string Options::first_given_in(const std::string& section) const {
  for (const Declaration& d : impl_->declarations)
    if (!d.is_input && d.section == section && given(d.name)) return "--" + d.name;
  return "";
}

std::vector<std::string> Options::names() const {
  std::vector<std::string> names;
  for (const Declaration& d : impl_->declarations)
    if (!d.is_input) names.push_back(d.name);
  return names;
}

std::vector<std::string> Options::names(Adopted adopted) const { return impl_->names(adopted); }

std::vector<GivenFile> Options::files() const {
  std::vector<GivenFile> all;
  for (const Declaration& d : impl_->declarations) {
    if (!d.paths) continue;
    for (const std::string& path : d.paths())
      if (!path.empty()) all.push_back({d.is_input ? d.name : "--" + d.name, path, d.use});
  }
  for (const std::string& path : impl_->option_files) all.push_back({"@FILE", path, FileUse::read});
  return all;
}

Json Options::value(const std::string& name) const {
  const Declaration* d = impl_->find(name);
  return d ? d->value() : Json();
}

Json Options::unrecorded_value(const std::string& name) const {
  const Declaration* d = impl_->find(name);
  return d && d->in_files.recorded == Recorded::unless_default ? d->initial : Json();
}

Json Options::recorded() const {
  Json all = Json::Object{};
  for (const Declaration& d : impl_->declarations) {
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

std::string Options::help() const {
  constexpr std::size_t kColumn = 28;
  std::string out = impl_->tool + " - " + impl_->summary + "\n\nUsage: " + impl_->usage() + "\n\n" +
                    wrap(impl_->description, 0) + "\n";
  const auto line = [&](const std::string& left, const std::string& right) {
    out += list_entry(left, right, kColumn);
  };
  bool heading = false;
  for (const Declaration& d : impl_->declarations) {
    if (!d.is_input) continue;
    if (!heading) out += "\nInputs:\n";
    heading = true;
    line(Impl::left(d), impl_->detail(d));
  }
  for (const std::string& section : impl_->sections()) {
    out += "\n" + section + ":\n";
    for (const Declaration& d : impl_->declarations)
      if (!d.is_input && d.section == section) line(Impl::left(d), impl_->detail(d));
  }
  out += "\nOther:\n";
  line("-h, --help", "this text");
  line("--version", "version");
  line("--man", "the manual page, for man -l -");
  line("--options-json", "every option with its kind, unit, range, choices and default, for other programs");
  line("@FILE", "reads options from a file: one per line, name=value, or a flag alone; # starts a comment");
  if (!impl_->examples.empty()) out += "\nExamples:\n";
  for (const Example& e : impl_->examples) out += "  " + e.command + "\n      " + wrap(e.what, 6) + "\n";
  out += "\nExit codes:\n";
  for (const ExitMeaning& row : exit_meanings()) line(exit_code(row), std::string(row.meaning));
  return out;
}

std::string Options::manual() const {
  std::string title = impl_->tool;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return static_cast<char>(std::toupper(c)); });
  std::string out = ".TH " + title + " 1 \"\" \"phos " + phos::version() + "\" \"phos manual\"\n";
  out += ".SH NAME\n" + roff(impl_->tool) + " \\- " + roff(impl_->summary) + "\n";
  out += ".SH SYNOPSIS\n.B " + roff(impl_->usage()) + "\n.SH DESCRIPTION\n" + roff(impl_->description) + "\n";
  const auto entry = [&](const std::string& left, const std::string& right) {
    out += ".TP\n.B " + roff(left) + "\n" + roff(right) + "\n";
  };
  out += ".SH INPUTS\n";
  for (const Declaration& d : impl_->declarations)
    if (d.is_input) entry(Impl::left(d), impl_->detail(d));
  out += ".SH OPTIONS\n";
  for (const std::string& section : impl_->sections()) {
    out += ".SS " + roff(section) + "\n";
    for (const Declaration& d : impl_->declarations)
      if (!d.is_input && d.section == section) entry(Impl::left(d), impl_->detail(d));
  }
  if (!impl_->examples.empty()) out += ".SH EXAMPLES\n";
  for (const Example& e : impl_->examples) entry(e.command, e.what);
  out += ".SH EXIT STATUS\n";
  for (const ExitMeaning& row : exit_meanings()) entry(exit_code(row), std::string(row.meaning));
  return out;
}

const char* version() { return PHOS_VERSION; }

}  // namespace phos
