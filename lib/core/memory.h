// How much memory there is.
#pragma once

#include <cstdint>
#include <string>

namespace phos {

/// Bytes that this process may still take: of the machine (Linux: MemAvailable), and no more than its limit
/// of address space (ulimit -v) leaves. The largest number where neither is known.
std::uint64_t free_memory_bytes();

/// "23.4 GiB", "512 MiB".
std::string memory_text(double bytes);

}  // namespace phos
