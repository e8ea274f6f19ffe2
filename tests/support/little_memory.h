// Runs something in a process of its own that may take little memory.
#pragma once

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <new>
#include <string>

// The address sanitizer needs an address space without end.
#if defined(__SANITIZE_ADDRESS__)
#define PHOS_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PHOS_ADDRESS_SANITIZER 1
#endif
#endif
#ifndef PHOS_ADDRESS_SANITIZER
#define PHOS_ADDRESS_SANITIZER 0
#endif

namespace phos::test {

/// Takes what earlier tests of the process have freed: it is no room.
inline void take_freed_memory() {
  for (std::size_t size = std::size_t{64} << 20; size >= 256; size /= 2) {
    for (;;) {
      const std::size_t before = ::mallinfo2().fordblks;
      void* const taken = std::malloc(size);
      if (taken && ::mallinfo2().fordblks < before) continue;  // kept until the process ends
      std::free(taken);                                        // of new memory
      break;
    }
  }
  ::malloc_trim(0);
}

/// The result of `body` in a child process that may take so much more memory than it has: its exit code, or
/// 128 plus the signal that ended it, and the memory that it took, kB.
struct Child {
  int code;
  long peak_kb;
};

inline Child in_little_memory([[maybe_unused]] std::uint64_t bytes, const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
#if !PHOS_ADDRESS_SANITIZER
    take_freed_memory();
    // Data, not addresses: threads that have ended leave addresses to malloc.
    std::uint64_t data_kb = 0;
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind("VmData:", 0) == 0) data_kb = std::stoull(line.substr(7));
    const std::uint64_t most = data_kb * 1024 + bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_DATA, &limit);
#endif
    int code = 1;
    try {
      code = body();
    } catch (...) {
      code = 100;
    }
    _exit(code);
  }
  int status = 0;
  rusage usage{};
  wait4(pid, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), usage.ru_maxrss};
}

/// `make`, with ever more memory up to `times` the size of `whole`, gives `whole` or throws; both happen.
template <class Bytes>
void expect_whole_or_no_memory(const Bytes& whole, const std::function<Bytes()>& make,
                               std::uint64_t times = 4) {
  constexpr int kWhole = 0, kCut = 1, kNoMemory = 2;
  int made = 0, refused = 0;
  for (std::uint64_t room = 0; room <= times * whole.size(); room += times * whole.size() / 32) {
    const Child child = in_little_memory(room, [&] {
      try {
        return make() == whole ? kWhole : kCut;
      } catch (const std::bad_alloc&) {
        return kNoMemory;
      }
    });
    EXPECT_NE(child.code, kCut) << room;
    ++(child.code == kWhole ? made : refused);
  }
  EXPECT_GT(made, 0);
  EXPECT_TRUE(refused > 0 || PHOS_ADDRESS_SANITIZER);
}

}  // namespace phos::test
