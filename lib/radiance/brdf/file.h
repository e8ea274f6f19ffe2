// The `.brdf` file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "file/container.h"
#include "radiance/brdf/table.h"

namespace phos::inline radiance {

/// The `.brdf` file. No table: an empty file ("the scene has no gloss").
void write_brdf(const std::string& path, std::span<const BrdfTable> tables, Provenance provenance);
/// Throws Error(bad_input) for a damaged file (checksums verified) or one of another kind.
std::vector<BrdfTable> read_brdf(const Container& file);

}  // namespace phos::inline radiance
