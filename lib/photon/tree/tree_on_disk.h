// A kd-tree over more points than memory holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "file/scratch/scratch_file.h"

namespace phos::inline photon {

/// Appends to `contents` the bytes of build_tree() over `count` points (1 to 2^31-1): `points` holds one
/// TreePoint for each, whose row is its number. A node whose points fit in memory is built there; the points
/// of a larger one are split in the file, by the same swaps. Holds about `memory_bytes`, but no less than two
/// points. Throws Error(bad_input) for a full disk.
void build_tree_on_disk(ScratchFile& points, std::size_t count, int leaf_size, std::uint64_t memory_bytes,
                        const std::string& output, ScratchFile& contents);

}  // namespace phos::inline photon
