// Ctrl-C, SIGTERM and SIGHUP end a tool at its next chunk of work, with nothing half-written.
#pragma once

namespace phos {

/// First signal: work stops at the next check. Second signal: the process ends at once.
void install_interrupt_handler();
bool interrupted();
/// Throws Error(interrupted) if a signal has come.
void throw_if_interrupted();

}  // namespace phos
