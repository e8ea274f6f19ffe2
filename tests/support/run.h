// Runs the built programs as a user would, and finds test data.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace phos::test {

struct Run {
  int code = -1;  ///< exit code; 128 + signal if it was killed
  std::string out, err;
};

inline std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

inline void spill(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A fresh, empty folder for this test.
inline std::string scratch(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::path(PHOS_SCRATCH) / (name + "-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

/// Path of a file in data/.
inline std::string data(const std::string& name) { return std::string(PHOS_SOURCE) + "/data/" + name; }

/// Path beside the project ("../shared/..."); "" if it is not there.
inline std::string shared(const std::string& name) {
  const std::string path = std::string(PHOS_SOURCE) + "/../shared/" + name;
  return std::filesystem::exists(path) ? path : "";
}

/// A program started and not yet waited for.
class Process {
 public:
  /// arguments[0] is the tool without "phos-", or "phos".
  explicit Process(const std::vector<std::string>& arguments, const std::string& folder = "") {
    files_ = scratch("run" + std::to_string(counter()++));
    std::vector<std::string> words = arguments;
    words[0] = std::string(PHOS_TOOLS) + (words[0] == "phos" ? "/" : "/phos-") + words[0];
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      redirect("/dev/null", O_RDONLY, 0);
      redirect(files_ + "/out", O_WRONLY | O_CREAT | O_TRUNC, 1);
      redirect(files_ + "/err", O_WRONLY | O_CREAT | O_TRUNC, 2);
      if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(126);
      setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
      execv(argv[0], argv.data());
      _exit(127);
    }
  }
  void signal(int number) const { kill(pid_, number); }
  /// What it has printed so far.
  std::string out() const { return slurp(files_ + "/out"); }
  Run wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    Run run;
    run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = slurp(files_ + "/out"), run.err = slurp(files_ + "/err");
    std::filesystem::remove_all(files_);
    return run;
  }

 private:
  static int& counter() {
    static int n = 0;
    return n;
  }
  static void redirect(const std::string& path, int flags, int to) {
    const int fd = open(path.c_str(), flags, 0644);
    dup2(fd, to);
    close(fd);
  }
  std::string files_;
  pid_t pid_ = -1;
};

/// run_tool({"photons", "--photons", "1000", scene, "-o", out})
inline Run run_tool(const std::vector<std::string>& arguments, const std::string& folder = "") {
  return Process(arguments, folder).wait();
}

/// Starts a tool, interrupts it after `delay`, and waits.
inline Run run_and_interrupt(const std::vector<std::string>& arguments, std::chrono::milliseconds delay) {
  const Process process(arguments);
  std::this_thread::sleep_for(delay);
  process.signal(SIGINT);
  return process.wait();
}

/// One line of message: no newline but the last.
/// The standard error of a program without its warnings.
inline std::string without_warnings(const std::string& said) {
  std::string rest;
  for (std::size_t at = 0; at < said.size();) {
    const std::size_t end = std::min(said.find('\n', at), said.size() - 1) + 1;
    const std::string line = said.substr(at, end - at);
    if (line.find(": warning: ") == std::string::npos) rest += line;
    at = end;
  }
  return rest;
}
inline bool is_one_line(const std::string& s) { return !s.empty() && s.find('\n') == s.size() - 1; }

}  // namespace phos::test
