// Checks a file against the table of its kind.
#pragma once

#include <cstddef>
#include <optional>

#include "file/container.h"
#include "file/kinds/shape_pattern.h"

namespace phos::inline file {

/// The tensor of that name. Throws Error(bad_input) with the name where there is none.
const Tensor& require_tensor(const Container& file, const std::string& name);

/// Throws Error(bad_input), naming tensor and file, for a tensor that is missing, that has another type, or
/// whose shape does not fit its row and the other tensors. Tensors without a row pass. Reads no data.
Extents require_layout(const Container& file);

/// Throws Error(bad_input), naming tensor, row and file, for the first number that fails the check of its
/// row. Aborts for a layout that require_layout() has not seen. With a `window`, about as many bytes of the
/// file are in memory at a time.
void require_sound_numbers(const Container& file, std::optional<std::size_t> window = {});

}  // namespace phos::inline file
