// The differences between an existing output and the output that a command would make.
#pragma once

#include <string>
#include <vector>

#include "file/container.h"

namespace phos::inline file {

/// One line per difference between how `then` was made and how `now` would be: algorithm, parameters, inputs.
/// A parameter that is null now is found while working, so it is not compared.
std::vector<std::string> differences(const Provenance& then, const Provenance& now);

}  // namespace phos::inline file
