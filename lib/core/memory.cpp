#include "core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
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

std::uint64_t parse_memory(const std::string& option, const std::string& size, std::uint64_t least) {
  constexpr std::string_view kUnits = "KMGT";
  const char* const end = size.data() + size.size();
  std::uint64_t number = 0;
  const auto [unit, failure] = std::from_chars(size.data(), end, number);
  const std::size_t power = unit + 1 == end ? kUnits.find(*unit) : kUnits.npos;
  if (failure != std::errc() || power == kUnits.npos || number == 0 || number >> 20 > 0)
    throw Error(
        ExitCode::usage, option,
        text('"', size,
             "\" is no size of memory; give a whole number up to 1048575 and K, M, G or T, such as 2G"));
  const std::uint64_t bytes = number << (10 * (power + 1));
  if (bytes < least)
    throw Error(ExitCode::usage, option,
                text(size, " is too little; give ", memory_text(static_cast<double>(least)), " or more"));
  return bytes;
}

}  // namespace phos
