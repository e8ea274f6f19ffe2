// The content of a container, for people and for programs, as phos-info prints it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "file/container.h"

namespace phos::inline file {

/// Header, and of each tensor dtype, shape, unit, meaning as the table of the kind says it, and the least,
/// greatest and mean finite value, with the number of non-finite ones. Tensors of 2 to 4 columns have one
/// value per column. Octahedral codes and bytes of opaque blocks
/// ("kdtree") have none: as numbers they mean nothing. Same numbers on any number of threads.
Json describe(const Container& file);

/// describe() as text for people.
std::string describe_text(const Container& file);

/// Only the content that a difference in rounding does not change: kinds, commands, parameters, names,
/// shapes, dtypes, units, counters, whole numbers of the extra values. For golden files.
std::string canonical_text(const Container& file);

/// Is this tensor a column of octahedral directions?
bool is_octahedral(const Tensor& tensor);

}  // namespace phos::inline file
