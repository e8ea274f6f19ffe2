// Photons of all shards in space order, without holding them all in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/column.h"
#include "core/vector.h"
#include "file/scratch/scratch_file.h"
#include "photon/photon_shards.h"
#include "photon/tree/space_order.h"

namespace phos::inline photon {

/// A row of all columns of photons.
struct PhotonRow {
  Vec3 position;
  Rgb flux;
  std::uint32_t direction, normal, source_normal;
  float distance;
  std::uint32_t family;  ///< 0 where there are none
  std::uint8_t path, bounce;
  std::uint16_t unused;
};

/// Rows of shards in space_order(), as over the columns of all shards one after another. Rows that fit in
/// memory are sorted there and written as a run; then the runs are merged.
class SortedRows {
 public:
  /// `bounds`: of all positions, which must be in KdTree::in_range(). Holds about `memory_bytes`, but no less
  /// than two rows of each run, and a file beside `output`. Throws Error(bad_input) for a full disk.
  SortedRows(std::span<const PhotonShard> shards, const Bounds& bounds, std::uint64_t memory_bytes,
             const std::string& output);

  /// The next rows, in the memory given; fewer at the end, then none.
  std::span<const PhotonRow> take(std::span<PhotonRow> memory);

 private:
  struct Run {
    std::uint64_t next, end;  ///< rows of the file that are not read yet
    Column<PhotonRow> rows;
    std::size_t at = 0;  ///< in `rows`
  };
  struct Head {
    std::uint64_t cube;
    std::size_t run;
    auto operator<=>(const Head&) const = default;
  };

  void add_runs(std::span<const PhotonShard> shards, std::size_t rows_of_run);
  void add_run(std::span<const PhotonShard> shards, std::size_t first_shard, std::size_t first_row,
               std::size_t count);
  void push_head(std::size_t run);

  SpaceCubes cube_;
  ScratchFile file_;
  std::vector<Run> runs_;
  std::vector<Head> heads_;  ///< a heap of the least
  std::size_t buffer_;       ///< rows of a run in memory
};

}  // namespace phos::inline photon
