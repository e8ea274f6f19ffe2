#include "core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"

namespace phos {
namespace {

constexpr double kMebi = 1024.0 * 1024.0;

/// Of /proc/meminfo; the largest number where there is none.
std::uint64_t available_on_machine() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  std::uint64_t kibibytes = 0;
  while (file >> name >> kibibytes) {
    std::getline(file, unit);
    if (name == "MemAvailable:") return kibibytes << 10;
  }
  return std::numeric_limits<std::uint64_t>::max();
}

/// Of address space; the largest number where there is no limit.
std::uint64_t left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<std::uint64_t>::max();
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  const std::uint64_t taken = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > taken ? limit.rlim_cur - taken : 0;
}

}  // namespace

std::uint64_t free_memory_bytes() { return std::min(available_on_machine(), left_of_limit()); }

std::string require_memory(const std::string& what, double bytes, const std::string& advice) {
  constexpr double kMuch = 1024.0 * 1024 * 1024;
  const auto free = static_cast<double>(free_memory_bytes());
  const std::string takes = text(what, " takes about ", memory_text(bytes), " of memory");
  if (bytes > free)
    throw Error(ExitCode::no_memory, "", text(takes, ", and ", memory_text(free), " are free; ", advice));
  return bytes > kMuch ? takes : "";
}

std::string memory_text(double bytes) {
  const double mebibytes = bytes / kMebi;
  if (mebibytes < 1024) return text(std::llround(mebibytes), " MiB");
  const double tenths = std::round(mebibytes / 102.4);
  return text(tenths / 10, " GiB");
}

}  // namespace phos
