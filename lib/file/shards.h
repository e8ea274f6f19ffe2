// Shards: files that each hold the share "k/n" of one run.
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
/// Reads "k/n"; an empty text is the whole run, 1/1. Throws Error(usage) naming the option unless
/// 1 <= k <= n <= 1048576.
Share parse_share(const std::string& option, const std::string& text);

/// Items [first, first + count) of `total` that a share holds: the whole is cut without gap or overlap.
struct ItemRange {
  std::uint64_t first = 0, count = 0;
};
ItemRange range_of(const Share& share, std::uint64_t total);

/// The "k/n" of a shard's or a part's header; "?" where it does not say it.
std::string share_of(const Container& file);

/// What one kind of shard is called.
struct ShardKind {
  FileKind kind;      ///< of the container
  FileForm form;      ///< shard or part: the word in messages, and the header's entry that holds "k/n"
  std::string whole;  ///< "map": the whole that the shards make together
  std::string maker;  ///< command that makes shards: "phos-photons --shard i/n"
  const char* word() const { return name_of(form); }
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

/// A shard's key is the key of the whole run's file, followed by ":shard k/n".
std::string key_of_whole(const Provenance& shard);

}  // namespace phos::inline file
