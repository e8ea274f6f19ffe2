#include "stage/front/child.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#include "core/error.h"

namespace phos::stage {
namespace {

constexpr int kFailed = 1;

void redirect(int from, int to) {
  ::dup2(from, to);
  if (from != to) ::close(from);
}

[[noreturn]] void run(const std::function<void()>& work, int out, unsigned seconds) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, SIG_DFL);
  redirect(::open("/dev/null", O_RDONLY), 0);
  redirect(out, 1);
  redirect(::open("/dev/null", O_WRONLY), 2);
  ::alarm(seconds);  // goes on through exec
  std::string why;
  try {
    work();
  } catch (const std::bad_alloc&) {
    why = "out of memory";
  } catch (const std::exception& e) {
    why = e.what();
  }
  std::cout << why << std::flush;
  std::fflush(stdout);
  ::_exit(why.empty() ? 0 : kFailed);
}

std::string all_of(int fd) {
  std::string all;
  char some[4096];
  for (;;) {
    const ssize_t n = ::read(fd, some, sizeof some);
    if (n > 0) all.append(some, static_cast<std::size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) break;
  }
  while (!all.empty() && all.back() == '\n') all.pop_back();
  return all;
}

}  // namespace

ChildResult in_child(const std::function<void()>& work, unsigned seconds) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {false, std::strerror(errno)};
  std::cout.flush();
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child < 0) {
    const int error = errno;
    ::close(ends[0]), ::close(ends[1]);
    return {false, std::strerror(error)};
  }
  if (child == 0) run(work, ends[1], seconds);
  ::close(ends[1]);
  ChildResult result{false, all_of(ends[0])};
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    result.said = WTERMSIG(status) == SIGALRM ? text("takes more than ", seconds, " s")
                                              : text("crashes (", ::strsignal(WTERMSIG(status)), ")");
  else if (WEXITSTATUS(status) == 0)
    result.done = true;
  else if (result.said.empty())
    result.said = text("ends with code ", WEXITSTATUS(status));
  return result;
}

}  // namespace phos::stage
