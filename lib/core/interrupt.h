// Ctrl-C, SIGTERM and SIGHUP end a tool at its next chunk of work, with nothing half-written.
#pragma once

#include <string>

namespace phos {

/// First signal: work stops at the next check. Second signal: the process ends at once, without its temporary
/// files.
void install_interrupt_handler();
bool interrupted();
/// For a program that ends by a signal and saves its results then: forgets the signal, so that work may go on
/// until the next one. False: none has come.
bool take_interrupt();
/// Throws Error(interrupted) if a signal has come.
void throw_if_interrupted();
/// What a process that is interrupted from now on says in place of "nothing was written": for work in several
/// files, of which some are done.
void say_if_interrupted(std::string words);

/// While one of these lives, in any thread, the first signal ends the process at once: for a long call into a
/// package that cannot be stopped, where nothing is being written but temporary files. One that has come
/// before throws Error(interrupted).
class StopAtOnce {
 public:
  StopAtOnce();
  ~StopAtOnce();
  StopAtOnce(const StopAtOnce&) = delete;
  StopAtOnce& operator=(const StopAtOnce&) = delete;
};

}  // namespace phos
