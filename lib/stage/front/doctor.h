// phos doctor: does this machine meet the requirements of the programs of phos?
#pragma once

#include "core/error.h"

namespace phos::stage {

/// Runs the command; argv[0] is its name. Prints one line for each check, or JSON. Returns check_failed where
/// a requirement is missing. Throws Error(usage).
ExitCode run_doctor(int argc, const char* const* argv);

}  // namespace phos::stage
