// Shards of photons joined to a map in bounded memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "photon/photon_shards.h"

namespace phos::inline photon {

/// Bytes that PhotonMap::build() and write() of read_shards() hold at most for each photon.
inline constexpr std::uint64_t kBytesOfMergeInMemory = 112;

/// Writes the bytes that PhotonMap::build() and write() of read_shards() write, and holds about
/// `memory_bytes`. Nameless files beside the output take about twice its size meanwhile. Each call throws
/// Error(bad_input) for a full disk.
class MergeOnDisk {
 public:
  /// Opens the shards; throws as read_shards(), but for damaged columns.
  MergeOnDisk(const std::vector<std::string>& shards, std::string output, std::uint64_t memory_bytes);
  ~MergeOnDisk();
  const PhotonTotals& totals() const;

  /// The steps, each once, in this order. sort() throws Error(bad_input) for damaged columns, and
  /// Error(numerical) for more photons than a map can hold.
  void sort();
  void build_tree();
  void write();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline photon
