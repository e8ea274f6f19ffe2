// Ends that no exception reaches: the last actions of a process that must end inside of a signal, of a
// package, or of a function that may not throw. All of it is safe in a signal handler.
#pragma once

#include <string>

#include "core/error.h"

namespace phos {

/// Names a file that goes with the process, however that ends (but by SIGKILL). Room for 256 at a time;
/// beyond that a file is not known here and is removed by its owner alone.
class GoesWithProcess {
 public:
  GoesWithProcess() = default;
  explicit GoesWithProcess(const std::string& path);
  /// The file stays: it is finished, or already removed.
  void release();
  ~GoesWithProcess() { release(); }
  GoesWithProcess(GoesWithProcess&& other) noexcept : slot_(other.slot_) { other.slot_ = -1; }
  GoesWithProcess& operator=(GoesWithProcess&& other) noexcept;

 private:
  int slot_ = -1;
};

/// The name that last words begin with ("phos-photons").
void set_program_name(const std::string& name);

/// Removes the files above, writes "program: message" to stderr and ends the process.
[[noreturn]] void end_now(ExitCode code, const char* message, const char* where = "") noexcept;

/// From now on a lack of memory that no handler of ours sees ends the process with one line and
/// ExitCode::no_memory: std::bad_alloc where nothing may be thrown, and the crash or abort() of a package
/// that got no memory (told by whether some can still be had). Other crashes stay as they are.
void install_last_words();

/// Whether an error that a package describes so comes from a lack of memory: it says that no thread can be
/// started, or next to nothing is to be had now.
bool for_want_of_memory(const char* what) noexcept;

}  // namespace phos
