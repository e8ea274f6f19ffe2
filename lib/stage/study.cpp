#include "stage/study.h"

#include <cstdio>

#include "core/parallel.h"

namespace phos::stage {
void run(Tool& tool, StudyCommand& asked) {
  StudyOptions& study = asked.study;
  const Options& options = tool.options();
  if (options.given("seed"))
    throw Error(ExitCode::usage, "--seed", "seeds are the study's own: [study] seeds = [0, 1, 2]");
  tool.writes("--output", study.folder, {"results.csv", "results.json", "index.html"});
  study.strict = tool.strict();
  if (options.given("threads")) study.threads = thread_count();
  const StudyOutcome outcome = run_study(
      study, [&](const std::string& line) { tool.say(line); },
      [&](const std::string& line) { tool.warn(line); });
  std::fwrite(outcome.listing.data(), 1, outcome.listing.size(), stdout);
  tool.stat("settings", outcome.settings), tool.stat("commands", outcome.commands);
  tool.stat("failed", outcome.failed);
  if (outcome.failed == 0) return;
  tool.warn(text(outcome.failed, " of ", outcome.settings, " settings failed; results hold the rest"));
  tool.set_exit(ExitCode::check_failed);
}

}  // namespace phos::stage
