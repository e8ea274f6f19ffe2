// phos-study: measures the cost and the error of settings.
#pragma once

#include "file/tool.h"
#include "study/study.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kStudyAlgorithm = 1;

struct StudyCommand {
  StudyOptions study;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set, and gets
/// the values that were left to it.
void run(Tool& tool, StudyCommand& asked);

}  // namespace phos::stage
