// Options that a run takes from the record of an earlier run (Adopted).
#pragma once

#include <string>

#include "core/json.h"
#include "core/options.h"
#include "file/container.h"

namespace phos::inline file {

/// A recorded value for a message: text without quotes.
std::string shown(const Json& value);

/// Sets an option that was not given to a value that `earlier` records (Options::adopt()). Throws
/// Error(bad_input) that names file and option where the option cannot have this value.
void adopt_recorded(Options& options, const std::string& name, const Json& value, const Container& earlier);

/// For a run that adds to `earlier`: every option declared Adopted::estimate takes the value that `earlier`
/// records. An option that `earlier` does not know stays as it is. Throws Error(mismatch) for one that was
/// given and differs, and Error(bad_input) as adopt_recorded() does.
void adopt_estimate(Options& options, const Container& earlier);

}  // namespace phos::inline file
