// Shards of photons: the parts of one run, and their union.
#pragma once

#include <string>
#include <vector>

#include "file/shards.h"
#include "photon/photon_file.h"
#include "photon/photon_map.h"

namespace phos::inline photon {

/// A shard: photons in path order, no tree. `shard` is "i/n".
void write_shard(const std::string& path, const Photons& photons, const PhotonTotals& totals,
                 const std::string& shard, Provenance provenance);

/// One shard of a run, in place.
struct PhotonShard {
  Shard shard;
  PhotonColumns columns;
  PhotonTotals totals;
};
/// Every shard of one run, in path order, by the headers alone: the columns are not looked at. Throws as
/// read_shards() else.
std::vector<PhotonShard> open_photon_shards(const std::vector<std::string>& paths);

/// The header of the whole run's file.
struct MergedHeader {
  PhotonTotals totals;
  Provenance provenance;
  bool has_families = false;  ///< Photons::family
};
MergedHeader header_of_merged(const std::vector<PhotonShard>& shards);

/// Every shard of one run, each once, in any order.
struct MergedShards {
  Photons photons;  ///< in path order
  PhotonTotals totals;
  Provenance provenance;  ///< of the whole run
};
/// Throws Error(mismatch) for shards of different runs, a shard given twice, or one that is missing (naming
/// it); Error(bad_input) for damaged files and for files that are no shards.
MergedShards read_shards(const std::vector<std::string>& paths);
/// The key of the whole run's file, by the headers alone; makes the same checks that the files belong
/// together.
std::string key_of_merged(const std::vector<std::string>& paths);

}  // namespace phos::inline photon
