// A command of a pipeline: one program, run and measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/json.h"

namespace phos::inline study {

struct Command {
  std::string tool;                    ///< "phos-photons"
  std::vector<std::string> arguments;  ///< inputs and options, without -o
  std::string output{};                ///< the value of -o; empty: none
};

/// As it is typed into a shell: words quoted where they need it.
std::string shell_line(const Command& command);
/// One word of a command.
std::string shell_word(const std::string& word);

/// What a run took and said.
struct CommandRun {
  int code = 0;                  ///< its exit code; 128 + signal if one ended it
  std::string out, message;      ///< stdout; the last line of stderr
  double wall_s = 0, cpu_s = 0;  ///< cpu_s: user and system, of all its threads
  std::uint64_t peak_bytes = 0;  ///< largest resident set
  Json stats;                    ///< of its --stats; null if it wrote none
};

/// Runs programs of `folder` (where this very program lies, unless told), one at a time, each with `common`
/// after its own arguments ("--threads", "2").
class CommandRunner {
 public:
  explicit CommandRunner(std::vector<std::string> common = {}, std::string folder = own_folder());
  /// Waits for it. Interrupted: passes that on, waits, and throws Error(interrupted). Throws Error(bad_input)
  /// where the program is not there; one that fails is for the caller to judge, by its code.
  CommandRun run(const Command& command) const;
  /// run(), and Error with the program's own message and code where it fails.
  CommandRun require(const Command& command) const;
  const std::string& folder() const { return folder_; }

  static std::string own_folder();

 private:
  std::vector<std::string> common_;
  std::string folder_;
};

}  // namespace phos::inline study
