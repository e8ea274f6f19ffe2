#include "core/last_words.h"

#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <new>

namespace phos {

namespace {

constexpr int kRoom = 256;
constexpr std::size_t kHandlersRoom = 1 << 16;          // bytes
constexpr std::size_t kLittle = std::size_t{32} << 20;  // bytes; a process that cannot get them has run out

std::atomic<char*> doomed[kRoom];
static_assert(std::atomic<char*>::is_always_lock_free);
char program[64] = "phos";
std::atomic<bool> ending = false;  // a thread says the last words; the others wait for its _exit

constexpr const char* kOutOfMemory =
    "out of memory; ask for less, allow more (ulimit -v), or use a larger machine";

/// In one piece, so that no other thread's words come between.
void say(std::initializer_list<const char*> words) {
  constexpr int kMost = 8;
  iovec piece[kMost];
  int n = 0;
  for (const char* word : words) piece[n++] = {const_cast<char*>(word), std::strlen(word)};
  if (::writev(STDERR_FILENO, piece, n) < 0) return;  // nobody is left to tell
}

bool memory_ran_out() {
  void* some = ::mmap(nullptr, kLittle, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (some == MAP_FAILED) return true;
  ::munmap(some, kLittle);
  return false;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
void watch_for_crashes() {}  // the sanitizers tell more of them
#else
/// Where memory is to be had the same comes again to the system's own handler, as this one returns.
void on_crash(int signal) {
  if (ending.load() || memory_ran_out()) end_now(ExitCode::no_memory, kOutOfMemory);
  std::signal(signal, SIG_DFL);
  static_cast<void>(::raise(signal));
}

void watch_for_crashes() {
  struct sigaction action = {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  static char room[kHandlersRoom];  // there may be no memory for the stack
  const stack_t stack = {.ss_sp = room, .ss_flags = 0, .ss_size = sizeof room};
  sigaltstack(&stack, nullptr);
  for (const int signal : {SIGSEGV, SIGABRT}) sigaction(signal, &action, nullptr);
}
#endif

[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end_now(ExitCode::no_memory, kOutOfMemory);
  } catch (const Error& e) {
    end_now(e.code(), e.what(), e.where().c_str());
  } catch (const std::exception& e) {
    if (for_want_of_memory(e.what())) end_now(ExitCode::no_memory, kOutOfMemory);
    say({program, ": internal error: ", e.what(), "; please report it with the command\n"});
  } catch (...) {
  }
  std::abort();
}

}  // namespace

GoesWithProcess::GoesWithProcess(const std::string& path) {
  char* own = ::strdup(path.c_str());
  if (own == nullptr) throw std::bad_alloc();
  for (int i = 0; i < kRoom; ++i) {
    char* none = nullptr;
    if (!doomed[i].compare_exchange_strong(none, own)) continue;
    slot_ = i;
    return;
  }
  std::free(own);
}

void GoesWithProcess::release() {
  if (slot_ >= 0) std::free(doomed[slot_].exchange(nullptr));
  slot_ = -1;
}

GoesWithProcess& GoesWithProcess::operator=(GoesWithProcess&& other) noexcept {
  if (this == &other) return *this;
  release();
  slot_ = other.slot_, other.slot_ = -1;
  return *this;
}

void set_program_name(const std::string& name) { std::strncpy(program, name.c_str(), sizeof program - 1); }

void end_now(ExitCode code, const char* message, const char* where) noexcept {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);  // no handler of this thread's comes between, to wait for it
  while (ending.exchange(true)) ::pause();
  for (std::atomic<char*>& path : doomed)
    if (char* own = path.exchange(nullptr)) ::unlink(own);
  say({program, ": ", where, *where != '\0' ? ": " : "", message, "\n"});
  _exit(static_cast<int>(code));
}

bool for_want_of_memory(const char* what) noexcept {
  for (const char* sign : {"pthread_create", "Resource temporarily unavailable"})
    if (std::strstr(what, sign) != nullptr) return true;
  return memory_ran_out();
}

void install_last_words() {
  std::set_terminate(on_terminate);
  watch_for_crashes();
}

}  // namespace phos
