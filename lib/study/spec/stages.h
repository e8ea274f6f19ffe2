// The stages that a study can run, and how their commands share results.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace phos::inline study {

/// A program, and the sections whose files it reads besides the scene, where the study has them.
struct StageKind {
  const char* section;
  const char* tool;
  const char* extension;
  std::vector<const char*> reads;
};
/// In the order of the flow: a stage reads only stages before it.
std::span<const StageKind> stage_kinds();
const StageKind* find_stage(const std::string& section);

/// One command that a study runs.
struct StageRun {
  std::string section;
  Command command;                  ///< its output lies in the study's folder
  std::vector<std::size_t> inputs;  ///< stages whose files it reads
  std::string id;  ///< of the command that makes it: equal for commands that give equal files
};

/// The commands of a study, each once. A command's identity is a hash over its program's contents, its
/// words, the contents of the files that it reads and the identities of its inputs; files are named by it, so
/// that they stay right whatever the study becomes.
class Stages {
 public:
  /// `folder`: where files go. `study` must outlive this.
  Stages(const StudyFile& study, const CommandRunner& runner, std::string folder);
  /// `words` come after the scene and the inputs' files. Returns its index, an earlier one for an equal
  /// command.
  std::size_t add(const std::string& section, const std::string& tool, const std::string& extension,
                  const std::string& scene, std::vector<std::size_t> inputs, std::vector<std::string> words);
  const StageRun& operator[](std::size_t i) const { return runs_[i]; }
  std::size_t size() const { return runs_.size(); }
  /// A stage and all that it needs, each once, inputs first.
  std::vector<std::size_t> chain(std::size_t last) const;
  /// The chain as it is typed, with files named `name`.photons, `name`.irradiance, ...
  std::vector<std::string> shell_lines(std::size_t last, const std::string& name) const;

 private:
  const std::string& hash_of(const std::string& path);

  const StudyFile& study_;
  std::string programs_, folder_;
  std::vector<StageRun> runs_;
  std::map<std::string, std::size_t> by_id_;
  std::map<std::string, std::string> hashes_;
};

}  // namespace phos::inline study
