#include "study/run.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"

namespace phos::inline study {

namespace {

std::uint64_t size_of(const std::string& path) {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(path, none);
  return none ? 0 : bytes;
}

/// Do the options or the inputs need mending, so that going on is idle?
bool is_users(int code) {
  return code == static_cast<int>(ExitCode::usage) || code == static_cast<int>(ExitCode::mismatch) ||
         code == static_cast<int>(ExitCode::interrupted);
}

/// Messages that differ in numbers alone are one.
std::string without_digits(std::string s) {
  std::erase_if(s, [](char c) { return c >= '0' && c <= '9'; });
  return s;
}

/// Is it a program's warning of a part of the scene that is left out, which the study itself has given?
bool is_told(const std::vector<SceneLoss>& losses, const std::string& line) {
  return std::any_of(losses.begin(), losses.end(),
                     [&](const SceneLoss& loss) { return line.ends_with(": " + loss.line); });
}

/// Its message, without its name.
std::string words_of(const CommandRun& run, const Command& command) {
  if (run.message.empty()) return text("ended with code ", run.code);
  const std::string name = command.tool + ": ";
  return run.message.starts_with(name) ? run.message.substr(name.size()) : run.message;
}

}  // namespace

bool is_done(const StageRun& stage, const StudyJournal& journal) {
  const CommandCost* cost = journal.find(stage.id);
  return cost && std::filesystem::exists(stage.command.output) &&
         size_of(stage.command.output) == cost->file_bytes;
}

// Commands that are not finished, or whose results the study itself reads and which are gone; and the
// commands for the files that these read, where such files are gone.
std::vector<std::size_t> work_left(const StudyWork& work, const StudyJournal& journal) {
  const std::vector<std::size_t> order = work.order();
  std::set<std::size_t> read_by_us, run;
  for (const auto* references : {&work.pictures, &work.lux})
    for (const ReferenceWork& r : *references) read_by_us.insert(r.stages.begin(), r.stages.end());
  for (const Job& job : work.jobs) {
    if (job.picture) read_by_us.insert(*job.picture);
    if (job.lux) read_by_us.insert(*job.lux);
  }
  for (const std::size_t i : order) {
    const bool there = is_done(work.stages[i], journal);
    if (!journal.find(work.stages[i].id) || (read_by_us.contains(i) && !there)) run.insert(i);
  }
  for (auto i = order.rbegin(); i != order.rend(); ++i)  // readers come after the makers of their inputs
    if (run.contains(*i))
      for (const std::size_t input : work.stages[*i].inputs)
        if (!is_done(work.stages[input], journal)) run.insert(input);
  std::vector<std::size_t> left;
  for (const std::size_t i : order)
    if (run.contains(i)) left.push_back(i);
  return left;
}

namespace {

/// How many commands that are left read each file.
class Readers {
 public:
  Readers(const StudyWork& work, const std::vector<std::size_t>& left) : work_(work) {
    for (const std::size_t i : left)
      for (const std::size_t input : work.stages[i].inputs) ++left_[input];
  }
  /// One reader has run: removes the files that no command reads any more.
  void discard_inputs(const StageRun& reader) {
    for (const std::size_t input : reader.inputs) {
      std::error_code none;
      if (--left_[input] == 0) std::filesystem::remove(work_.stages[input].command.output, none);
    }
  }

 private:
  const StudyWork& work_;
  std::map<std::size_t, std::size_t> left_;
};

/// The message with which it failed; "" if it did not.
std::string run_stage(const StageRun& stage, const CommandRunner& runner, StudyJournal& journal,
                      const std::function<void(const std::string&)>& warn) {
  const CommandRun run = runner.run(stage.command);
  if (run.code == 0) {
    if (!run.message.empty()) warn(run.message);  // programs are quiet: all their messages are warnings
    if (!journal.find(stage.id))
      journal.add(stage.id, stage.command,
                  {run.wall_s, run.cpu_s, run.peak_bytes, size_of(stage.command.output)});
    return "";
  }
  std::string said = words_of(run, stage.command);
  if (is_users(run.code) || stage.section == "reference")
    throw Error(run.code <= 5 || run.code == 130 ? static_cast<ExitCode>(run.code) : ExitCode::bad_input,
                shell_line(stage.command), said);
  warn(text(shell_line(stage.command), ": ", said));
  return said;
}

}  // namespace

Failures run_work(const StudyWork& work, const CommandRunner& runner, StudyJournal& journal, bool discard,
                  const std::function<void(const std::string&)>& warn) {
  const std::vector<std::size_t> left = work_left(work, journal);
  Failures failures;
  Readers readers(work, left);
  std::set<std::string> said;
  const auto warn_once = [&](const std::string& line) {
    if (is_told(work.losses, line)) return;
    if (said.insert(without_digits(line)).second) warn(line);
  };
  Progress progress("study", left.size(), "commands");
  std::size_t done = 0;
  const auto tell_done = [&] {
    say_if_interrupted(text("interrupted; ", done, " of ", left.size(),
                            " commands are done, the same command goes on from there"));
  };
  tell_done();
  for (const std::size_t i : left) {
    const StageRun& stage = work.stages[i];
    std::string failure;
    for (const std::size_t input : stage.inputs)
      if (failures.contains(input)) failure = failures.at(input);
    if (failure.empty()) failure = run_stage(stage, runner, journal, warn_once);
    if (failure.empty())
      ++done, tell_done();
    else
      failures.emplace(i, failure);
    if (discard) readers.discard_inputs(stage);
    progress.advance();
  }
  return failures;
}

}  // namespace phos::inline study
