// One declaration per option: it parses, it is the help, and it is the record in a file.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/json.h"

namespace phos {

/// Whether an option changes the result (and so is part of the file's parameters and key) or not (paths,
/// threads). if_given: only where it was given, so that commands that do without are what they were before
/// there was such an option. unless_default: only where its value at the end, which something else than the
/// command line may have settled, is not the default.
enum class Recorded { yes, no, if_given, unless_default };

/// Whether a run that reads files of earlier runs takes the option from them where it is not given. Such an
/// option is recorded.
enum class Adopted {
  no,        ///< of the run alone (placement, output): free to differ
  estimate,  ///< how records are made: from the file that records are added to (adopt_estimate())
  site,      ///< surroundings of the scene: taken from each cache that is read (adopt_site())
};

/// How files record an option, and whether they give it back.
struct InFiles {
  InFiles(Recorded r = Recorded::yes, Adopted a = Adopted::no) : recorded(r), adopted(a) {}
  InFiles(Adopted a) : InFiles(Recorded::yes, a) {}
  Recorded recorded;
  Adopted adopted;
};

struct Range {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false;  ///< lo itself is not allowed
};
inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range kNotNegative{0, std::numeric_limits<double>::infinity(), false};

/// Values of a choice by name.
template <class E>
using Names = std::vector<std::pair<std::string, E>>;

template <class E>
const std::string& name_in(const Names<E>& names, E value) {
  for (const auto& [name, e] : names)
    if (e == value) return name;
  PHOS_CHECK(false, "value ", static_cast<int>(value));
}

/// What becomes of a file that the command line names.
enum class FileUse {
  read,
  written,  ///< "-" stands for standard output
  grown,    ///< read; the output may be the same file, as it keeps the file's records
  folder,   ///< its files are written
};

/// A path of the command line, and the option or input that it was given to ("--stats", "SCENE").
struct GivenFile {
  std::string given_to, path;
  FileUse use = FileUse::read;
};

/// The options and inputs of one tool. The value at the time of declaration is the default shown in the help.
/// `name` is without dashes ("photons"); `unit` is the placeholder in the help ("METRES", "N", "FILE").
class Options {
 public:
  Options(std::string tool, std::string summary, std::string description);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  /// Heading in the help for the options declared after it.
  void section(const std::string& title);

  void flag(const std::string& name, bool& value, const std::string& help, InFiles = {});
  void number(const std::string& name, double& value, const std::string& unit, const std::string& help,
              Range = {}, InFiles = {});
  void number(const std::string& name, std::optional<double>& value, const std::string& unit,
              const std::string& help, Range = {}, InFiles = {});
  void integer(const std::string& name, std::int64_t& value, const std::string& unit, const std::string& help,
               Range = {}, InFiles = {});
  void integer(const std::string& name, std::optional<std::int64_t>& value, const std::string& unit,
               const std::string& help, Range = {}, InFiles = {});
  void text(const std::string& name, std::string& value, const std::string& unit, const std::string& help,
            InFiles = {});
  /// May be given several times, or once with commas (split_at_commas()).
  void list(const std::string& name, std::vector<std::string>& value, const std::string& unit,
            const std::string& help, InFiles = {});
  /// A path. Never recorded (contents are, by hash). "-o" is declared as file("output,o", ...).
  void file(const std::string& name, std::string& value, const std::string& help, FileUse use = FileUse::read,
            bool required = false);
  /// NAME=FILE; may be given several times, or once with commas (split_named_files()). NAMEs are recorded, if
  /// given, FILEs never: such an Adopted option has to be given again.
  void named_files(const std::string& name, std::vector<std::string>& value, const std::string& help,
                   Adopted = Adopted::no);
  /// One of named values.
  template <class E>
  void choice(const std::string& name, E& value, const Names<E>& values, const std::string& help,
              InFiles in_files = {}) {
    std::vector<std::string> names;
    std::size_t index = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      names.push_back(values[i].first);
      if (values[i].second == value) index = i;
    }
    const auto current = [&value, values] {
      std::size_t i = 0;
      while (i + 1 < values.size() && values[i].second != value) ++i;
      return i;
    };
    choice_of_names(
        name, names, index, [&value, values](std::size_t i) { value = values[i].second; }, current, help,
        in_files);
  }
  /// Says that `name` sets the value of `other`, both declared before: parse() refuses a command line that
  /// gives both, and given_as(other) finds either.
  void another_name(const std::string& name, const std::string& other);

  /// Positional inputs (never recorded).
  void input(const std::string& placeholder, std::string& value, const std::string& help,
             bool required = true);
  void inputs(const std::string& placeholder, std::vector<std::string>& values, const std::string& help,
              bool required = true);
  /// A line under "Examples" in the help.
  void example(const std::string& command, const std::string& what);

  /// Reads a command line. False if --help, --version, --man or --options-json was asked for and has been
  /// printed to stdout. Throws Error(usage) with one line otherwise. `@file` reads options from a file (one
  /// per line, name=value or a flag).
  bool parse(int argc, const char* const* argv);

  /// Sets an option that was not given to a value that recorded() of another run has, and records it as if it
  /// had been given. Not for lists and files. Throws Error(usage) as parse() does, and for a value of another
  /// kind.
  void adopt(const std::string& name, const Json& value);

  /// Was the option given on the command line?
  bool given(const std::string& name) const;
  /// The name by which its value was given: its own, or another_name(); "" where it was not given.
  std::string given_as(const std::string& name) const;
  /// The first of these that was, "--" before it; "" if none was.
  std::string first_given(std::initializer_list<const char*> names) const;
  /// The same of all options that were declared in a section.
  std::string first_given_in(const std::string& section) const;
  /// Of every option, in the order of declaration.
  std::vector<std::string> names() const;
  std::vector<std::string> names(Adopted) const;
  /// Every path that the command line names: inputs, files, the FILEs of NAME=FILE, and files of options.
  std::vector<GivenFile> files() const;
  /// The value of an option as it is now; null where there is none of that name.
  Json value(const std::string& name) const;
  /// The value that a record without this option stands for: the default of Recorded::unless_default, null
  /// (not known) of others.
  Json unrecorded_value(const std::string& name) const;
  /// Every recorded option as resolved now (call after automatic values are filled in), sorted by name.
  Json recorded() const;
  /// `tool --name value ...` from recorded(), without paths.
  std::string command() const;
  std::string help() const;
  /// roff for man(1).
  std::string manual() const;
  const std::string& tool() const;

 private:
  void choice_of_names(const std::string& name, const std::vector<std::string>& names, std::size_t index,
                       std::function<void(std::size_t)> set, std::function<std::size_t()> current,
                       const std::string& help, InFiles in_files);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

const char* version();

}  // namespace phos
