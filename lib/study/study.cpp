#include "study/study.h"

#include "core/error.h"
#include "core/text/quantity.h"
#include "file/folder.h"
#include "file/write_text.h"
#include "scene/note.h"
#include "study/html/page.h"
#include "study/results/csv.h"
#include "study/results/json.h"
#include "study/results/plots.h"
#include "study/results/results.h"
#include "study/results/runs.h"
#include "study/spec/check.h"

namespace phos::inline study {

namespace {

CommandRunner runner_of(const StudyFile& study) {
  return CommandRunner({"--threads", std::to_string(study.threads), "--quiet", "--progress", "never"});
}

/// The best of each kind, in words.
std::string front_of(const StudyFile& study, const StudyWork& work, const StudyResults& results,
                     std::optional<Summary> PointResult::*kind, const char* name) {
  std::size_t all = 0, front = 0;
  const PointResult* least = nullptr;
  for (const PointResult& p : results.points) {
    if (!p.own(kind)) continue;
    ++all;
    if ((p.*kind)->best_in_time) ++front;
    if (!least || (p.*kind)->told_error() < (least->*kind)->told_error()) least = &p;
  }
  if (!least) return "";
  const Summary& s = *(least->*kind);
  return text(name, ": ", front, " of ", all, " settings are on the front; the least error is ",
              s.resolved ? "" : "at most ", percent(s.told_error()), " in ", duration(s.time.mean), " (",
              describe(study, work.settings[least->setting]), ")");
}

}  // namespace

StudyOutcome run_study(const StudyOptions& options, const std::function<void(const std::string&)>& say,
                       const std::function<void(const std::string&)>& warn) {
  StudyFile study = read_study(options.file, CommandRunner());
  if (options.threads) study.threads = *options.threads;
  const CommandRunner runner = runner_of(study);
  const StudyWork work = plan_work(study, runner, options.folder + "/cache");
  for (const SceneLoss& loss : work.losses) warn(text(loss.scene, ": ", loss.line));
  for (const SceneLoss& loss : work.losses)
    if (options.strict && loss.refused) throw Error(ExitCode::bad_input, loss.scene, kRefusedForLosses);
  make_folder(options.folder + "/cache");
  StudyJournal journal(options.folder + "/journal.jsonl");

  StudyOutcome outcome{work.settings.size(), work_left(work, journal).size(), 0, ""};
  say(text(outcome.settings, outcome.settings == 1 ? " setting, " : " settings, ", study.seeds.size(),
           study.seeds.size() == 1 ? " seed; " : " seeds; ", outcome.commands, " of ", work.order().size(),
           " commands are to be run"));
  if (options.list) {
    for (const std::size_t i : work_left(work, journal))
      outcome.listing.append(shell_line(work.stages[i].command)).append("\n");
    return outcome;
  }
  const Failures failures = run_work(work, runner, journal, options.discard, warn);
  const StudyResults results = summarise(study, work, measure_runs(study, work, journal, failures));
  for (const PointResult& p : results.points)
    if (!p.failed.empty()) ++outcome.failed;
  for (const std::string& sentence : doubts(results)) warn(sentence);

  write_text(options.folder + "/results.csv", results_csv(study, work, results));
  write_text(options.folder + "/results.json", results_json(study, work, journal, results).dump(2) + "\n");
  const std::vector<NamedPlot> plots = plots_of(study, work, results);
  for (const NamedPlot& plot : plots) {
    constexpr int kScale = 2;
    write_text(text(options.folder, "/", plot.name, ".svg"), plot_svg(plot.plot));
    write_png(text(options.folder, "/", plot.name, ".png"), plot_picture(plot.plot, kScale));
  }
  write_text(options.folder + "/index.html",
             study_page({study, work, results, plots, static_cast<std::size_t>(options.pictures)}));
  for (const auto& line : {front_of(study, work, results, &PointResult::picture, "pictures"),
                           front_of(study, work, results, &PointResult::lux, "lux")})
    if (!line.empty()) say(line);
  return outcome;
}

}  // namespace phos::inline study
