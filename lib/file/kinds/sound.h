// Is a file what the table of its kind says?
#pragma once

#include "file/container.h"
#include "file/kinds/shape_pattern.h"

namespace phos::inline file {

/// The tensor. Throws Error(bad_input) naming it where there is none.
const Tensor& require_tensor(const Container& file, const std::string& name);

/// Throws Error(bad_input), naming tensor and file, for a tensor that lacks, is of another type, or of a
/// shape that does not fit its row and the others. Tensors without a row are let pass. Looks at no data.
Extents require_layout(const Container& file);

/// Throws Error(bad_input), naming tensor, row and file, for the first number that fails the check of its
/// row. Aborts for a layout that require_layout() has not seen.
void require_sound_numbers(const Container& file);

}  // namespace phos::inline file
