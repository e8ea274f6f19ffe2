// A study from its file to its folder of results.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace phos::inline study {

struct StudyOptions {
  std::string file, folder;
  std::optional<std::int64_t> threads;  ///< in place of the study's own
  std::int64_t pictures = 24;           ///< points of each scene and camera whose pictures the page shows
  bool discard = false;                 ///< remove photons and caches once nothing is left to read them
  bool strict = false;                  ///< refuse scenes with parts that are left out (scene/note.h)
  bool list = false;                    ///< print the commands that would run, and run none
};

struct StudyOutcome {
  std::size_t settings = 0, commands = 0, failed = 0;
  std::string listing;  ///< with `list`: the commands that are left, as they are typed
};

/// Runs the commands that have not been run yet and writes results.csv, results.json, plots and index.html
/// into the folder; files of the stages lie in its folder cache, and journal.jsonl says which commands are
/// finished. `say` and `warn` get lines for people. Throws as read_study(), plan_work() and run_work() do.
StudyOutcome run_study(const StudyOptions& options, const std::function<void(const std::string&)>& say,
                       const std::function<void(const std::string&)>& warn);

}  // namespace phos::inline study
