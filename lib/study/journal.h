// What the commands of a study took, kept so that an interrupted study goes on where it was.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "study/command.h"

namespace phos::inline study {

/// What one command took.
struct CommandCost {
  double wall_s = 0, cpu_s = 0;
  std::uint64_t peak_bytes = 0;  ///< largest resident set
  std::uint64_t file_bytes = 0;  ///< of its output
};

/// A file with a line for each finished command, by its identity. A line that was cut off is not there.
class StudyJournal {
 public:
  /// Opens or begins it. Throws Error(bad_input) if it cannot be written, or if another study holds it.
  explicit StudyJournal(const std::string& path);
  ~StudyJournal();
  StudyJournal(const StudyJournal&) = delete;
  StudyJournal& operator=(const StudyJournal&) = delete;
  /// Null: not finished yet.
  const CommandCost* find(const std::string& id) const;
  /// Written before this returns.
  void add(const std::string& id, const Command& command, const CommandCost& cost);

 private:
  void read(const std::string& bytes);
  std::string path_;
  int fd_ = -1;
  std::map<std::string, CommandCost> costs_;
};

}  // namespace phos::inline study
