// One run of a tool, hit by a fault at some moment, and the files that it left.
#pragma once

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <functional>

#include "support/fault_stages.h"

namespace phos::test {

using Seconds = std::chrono::duration<double>;

/// A tool, run with limits, and looked after while it runs.
struct Hit {
  std::function<void()> in_child = [] {};  ///< before the program starts
  std::string tools = PHOS_TOOLS;          ///< the folder of the programs
  double after_s = -1;                     ///< when `action` happens; below 0: never
  std::function<void(pid_t)> action = [](pid_t) {};
};

struct Outcome {
  int code = -1;  ///< 128 + signal if killed
  std::string err;
  double seconds = 0;
  std::uint64_t peak_address_space = 0;  ///< bytes, as far as looking each millisecond tells
  bool hung = false;
};

inline std::uint64_t address_space(pid_t pid) {
  std::istringstream status(slurp("/proc/" + std::to_string(pid) + "/status"));
  for (std::string word; status >> word;)
    if (word == "VmPeak:") {
      std::uint64_t kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

inline Outcome run_hit(std::vector<std::string> words, const std::string& scratch_folder, const Hit& hit) {
  constexpr double kHung_s = 120;
  const std::string err = scratch_folder + "/err";
  words[0] = hit.tools + "/phos-" + words[0];
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return Seconds(std::chrono::steady_clock::now() - start).count(); };
  const pid_t pid = fork();
  if (pid == 0) {
    for (const auto& [path, flags, to] : {std::tuple{"/dev/null", O_RDONLY, 0},
                                          {"/dev/null", O_WRONLY, 1},
                                          {err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 2}})
      dup2(open(path, flags, 0644), to);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    setenv("TMPDIR", (scratch_folder + "/tmp").c_str(), 1);
    hit.in_child();
    execv(argv[0], argv.data());
    _exit(127);
  }
  Outcome outcome;
  int status = 0;
  bool acted = hit.after_s < 0;
  while (waitpid(pid, &status, WNOHANG) == 0) {
    outcome.peak_address_space = std::max(outcome.peak_address_space, address_space(pid));
    if (!acted && elapsed() >= hit.after_s) hit.action(pid), acted = true;
    if (elapsed() > kHung_s && !outcome.hung) kill(pid, SIGKILL), outcome.hung = true;
    const double left = acted ? 1e-3 : std::min(1e-3, hit.after_s - elapsed());
    std::this_thread::sleep_for(Seconds(std::max(left, 0.0)));
  }
  outcome.seconds = elapsed();
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.err = slurp(err);
  return outcome;
}

inline void limit(int what, std::uint64_t most) {
  const rlimit both{most, most};
  setrlimit(static_cast<__rlimit_resource>(what), &both);
}

/// Ends the processes that a killed planner or study left running: all with `folder` in their command lines.
inline void wait_for_orphans(const std::string& folder) {
  for (bool some = true; some;) {
    some = false;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename().string();
      if (name.find_first_not_of("0123456789") != std::string::npos || name == std::to_string(getpid()))
        continue;
      const std::string line = slurp(entry.path().string() + "/cmdline");
      if (line.find("/phos-") != std::string::npos && line.find(folder) != std::string::npos) some = true;
    }
    if (some) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace phos::test
