#include "study/command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/error.h"
#include "core/interrupt.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "study/scratch_folder.h"

extern char** environ;

namespace phos::inline study {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File scratch_file() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw Error(ExitCode::bad_input, "temporary file", std::strerror(errno));
  return file;
}

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string all;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, file)) > 0;) all.append(part, n);
  return all;
}

std::string last_line(std::string s) {
  while (!s.empty() && s.back() == '\n') s.pop_back();
  const std::size_t start = s.rfind('\n');
  return start == std::string::npos ? s : s.substr(start + 1);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

pid_t start(const std::string& program, std::vector<std::string> words, int out, int err) {
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, 1);
  posix_spawn_file_actions_adddup2(&actions, err, 2);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&usual, s);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is for us: we pass it on
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  pid_t pid = -1;
  const int failed = posix_spawn(&pid, program.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error(ExitCode::bad_input, program, text("cannot be run: ", std::strerror(failed)));
  return pid;
}

}  // namespace

std::string shell_word(const std::string& word) {
  static const char* const kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const Command& command) {
  std::string line = shell_word(command.tool);
  for (const std::string& w : command.arguments) line.append(" ").append(shell_word(w));
  if (!command.output.empty()) line.append(" -o ").append(shell_word(command.output));
  return line;
}

std::string CommandRunner::own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

CommandRunner::CommandRunner(std::vector<std::string> common, std::string folder)
    : common_(std::move(common)), folder_(std::move(folder)) {}

CommandRun CommandRunner::run(const Command& command) const {
  throw_if_interrupted();
  const std::string program = folder_ + "/" + command.tool;
  const File out = scratch_file(), err = scratch_file();
  const ScratchFolder scratch;
  const std::string stats = scratch.file("stats.json");
  std::vector<std::string> words{program};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  words.insert(words.end(), common_.begin(), common_.end());
  if (!command.output.empty()) words.insert(words.end(), {"-o", command.output});
  words.insert(words.end(), {"--stats", stats});

  const auto begun = std::chrono::steady_clock::now();
  const pid_t pid = start(program, std::move(words), ::fileno(out.get()), ::fileno(err.get()));
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
  int status = 0;
  rusage used{};
  for (bool told = false;;) {
    pollfd ended{handle, POLLIN, 0};
    if (handle >= 0) ::poll(&ended, 1, 100);
    if (::wait4(pid, &status, handle >= 0 ? WNOHANG : 0, &used) == pid) break;
    if (interrupted() && !told) ::kill(pid, SIGINT), told = true;
  }
  if (handle >= 0) ::close(handle);

  CommandRun run;
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  run.cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime);
  run.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = contents(out.get());
  run.message = last_line(contents(err.get()));
  throw_if_interrupted();
  if (std::filesystem::exists(stats)) run.stats = parse_json(read_text(stats), command.tool);
  return run;
}

CommandRun CommandRunner::require(const Command& command) const {
  CommandRun run = this->run(command);
  if (run.code == 0) return run;
  std::string message = run.message.empty() ? text("ended with code ", run.code) : run.message;
  if (message.starts_with(command.tool + ": ")) message.erase(0, command.tool.size() + 2);
  throw Error(run.code <= static_cast<int>(ExitCode::no_memory) || run.code == 130
                  ? static_cast<ExitCode>(run.code)
                  : ExitCode::bad_input,
              command.tool, message);
}

}  // namespace phos::inline study
