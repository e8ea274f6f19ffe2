// Runs something in a process of its own that may take little memory.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>

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

/// What a child process that may take this much memory beyond what it has says of `body`: its exit code, or
/// 128 and the signal that ended it; and the memory that it took, kB.
struct Child {
  int code;
  long peak_kb;
};

inline Child in_little_memory([[maybe_unused]] std::uint64_t bytes, const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
#if !PHOS_ADDRESS_SANITIZER
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
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

}  // namespace phos::test
