// Shards: files that each hold a share of one run, "k/n" of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/container.h"

namespace phos::inline file {

/// Share `index` of `count`, counted from 1.
struct Share {
  std::uint64_t index = 1, count = 1;
};
/// Reads "k/n"; an empty text is all of it, 1/1. Throws Error(usage) naming the option unless
/// 1 <= k <= n <= 1048576.
Share parse_share(const std::string& option, const std::string& text);

/// Items [first, first + count) of `total` that a share holds: the whole is cut without gap or overlap.
struct ItemRange {
  std::uint64_t first = 0, count = 0;
};
ItemRange range_of(const Share& share, std::uint64_t total);

/// What one kind of shard is called.
struct ShardKind {
  std::string kind;   ///< of the container: "photons"
  std::string word;   ///< "shard": what messages call it, and the header's entry that holds "k/n"
  std::string whole;  ///< "map": what the shards make together
  std::string maker;  ///< command that makes shards: "phos-photons --shard i/n"
};

struct Shard {
  Container file;
  std::string name;  ///< "k/n"
  Share share;
};

/// Opens every shard of one run, given in any order, and sorts them. Throws Error(mismatch) for shards of
/// different runs, a shard given twice, or one that is missing (naming it); Error(bad_input) for files that
/// are no shards of this kind.
std::vector<Shard> open_shards(const std::vector<std::string>& paths, const ShardKind& kind);

/// Throws Error(mismatch): two shards are of different runs, for this reason.
[[noreturn]] void refuse_other_run(const Shard& a, const Shard& b, const ShardKind& kind,
                                   const std::string& reason);

/// A shard's key is that of the whole run's file with ":shard k/n" behind it.
std::string key_of_whole(const Provenance& shard);

}  // namespace phos::inline file
