// How much memory there is.
#pragma once

#include <cstdint>
#include <string>

namespace phos {

/// Bytes that this process may still take: of the machine (Linux: MemAvailable), and no more than its limit
/// of address space (ulimit -v) leaves. The largest number where neither is known.
std::uint64_t free_memory_bytes();

/// Throws Error(no_memory) where `what` (such as "a picture of 2 x 2") takes more bytes than there are free;
/// `advice` says how it takes less. A line for people where it takes a good part (over 1 GiB), else empty.
std::string require_memory(const std::string& what, double bytes, const std::string& advice);

/// "23.4 GiB", "512 MiB".
std::string memory_text(double bytes);

/// Bytes of a size as a command line gives it: a whole number from 1 and K, M, G or T, powers of 1024 bytes
/// ("512M", "2G"). Throws Error(usage) naming the option for any other text, and for a size below `least`.
std::uint64_t parse_memory(const std::string& option, const std::string& size, std::uint64_t least = 1);

}  // namespace phos
