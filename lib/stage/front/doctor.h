// phos doctor: has this machine what programs of phos need?
#pragma once

#include "core/error.h"

namespace phos::stage {

/// The command, argv[0] its name. Prints one line for each check, or JSON. check_failed where something that
/// is required is missing. Throws Error(usage).
ExitCode run_doctor(int argc, const char* const* argv);

}  // namespace phos::stage
