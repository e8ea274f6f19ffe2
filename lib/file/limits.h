// Limits of files: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline file {

inline constexpr Limit kMostHeaderBytes{"bytes of the header of a phos file", std::int64_t{256} << 20,
                                        "exit code 3"};
inline constexpr Limit kMostJsonLevels{"nested levels of a JSON text", 256, "exit code 3"};
inline constexpr Limit kMostShares{"shards or parts of a run (`--shard`, `--part`)", 1 << 20, "exit code 2"};
inline constexpr Limit kMostFrame{"number of a frame (`--frames`)", 1 << 30, "exit code 2"};
inline constexpr Limit kMostTableColumns{"columns of a tensor that `phos-info --dump` prints", 4096,
                                         "exit code 2"};

inline constexpr const Limit* kFileLimits[] = {&kMostHeaderBytes, &kMostJsonLevels, &kMostShares, &kMostFrame,
                                               &kMostTableColumns};

}  // namespace phos::inline file
