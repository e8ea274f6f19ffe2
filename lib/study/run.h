// Runs the commands of a study that have not been run yet.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "study/journal.h"
#include "study/work.h"

namespace phos::inline study {

/// Messages of the stages that failed, and of the stages that read their files.
using Failures = std::map<std::size_t, std::string>;

/// Is the command finished, and its file as it left it?
bool is_done(const StageRun& stage, const StudyJournal& journal);

/// Runs the commands that are not done, in StudyWork::order(): references first. A file that is gone though
/// its command is finished is made again only if another command is to read it. A program that fails for
/// reasons of its own (a numerical guard, no memory) fails the settings that need it, which are made known
/// through `warn`; one that calls its options or inputs wrong throws its Error, as does a failing reference.
/// `discard` removes the file of a stage once no command that is left reads it, but for pictures and tables.
Failures run_work(const StudyWork& work, const CommandRunner& runner, StudyJournal& journal, bool discard,
                  const std::function<void(const std::string&)>& warn);

/// The commands that run_work() would run, in order.
std::vector<std::size_t> work_left(const StudyWork& work, const StudyJournal& journal);

}  // namespace phos::inline study
