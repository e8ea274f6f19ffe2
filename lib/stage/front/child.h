// Work in a process of its own, so that neither a crash nor a hang of a library ends this process.
#pragma once

#include <functional>
#include <string>

namespace phos::stage {

struct ChildResult {
  bool done = false;
  std::string said;  ///< its standard output without the last line end; where not done: the reason
};

/// Runs `work` in a child process whose standard output is gathered, and whose input and error lead nowhere.
/// `work` returns, exits or replaces the process (exec); done: it returned, or ended with code 0, within
/// `seconds`. The message of an Error that it throws is the reason. Call it while this process has one
/// thread.
ChildResult in_child(const std::function<void()>& work, unsigned seconds);

}  // namespace phos::stage
