#include "core/interrupt.h"

#include <atomic>
#include <csignal>
#include <deque>
#include <mutex>

#include "core/error.h"
#include "core/last_words.h"

namespace phos {

namespace {

std::atomic<bool> asked_to_stop{false};
std::atomic<int> not_to_be_stopped{0};  // calls that do not look whether they should stop
std::atomic<const char*> said{"interrupted; nothing was written, what was there before is unchanged"};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

void on_signal(int) {
  const bool again = asked_to_stop.exchange(true);
  if (not_to_be_stopped.load() > 0) end_now(ExitCode::interrupted, said.load());
  if (again) end_now(ExitCode::interrupted, "interrupted twice; what was there before is unchanged");
}

}  // namespace

void install_interrupt_handler() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

bool interrupted() { return asked_to_stop.load(std::memory_order_relaxed); }

bool take_interrupt() { return asked_to_stop.exchange(false); }

void throw_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "", said.load());
}

void say_if_interrupted(std::string words) {
  static std::mutex one_at_a_time;
  // All of them, to the very end of the process: a handler may be reading a set that another thread replaces.
  static auto& kept = *new std::deque<std::string>;
  const std::lock_guard lock(one_at_a_time);
  said.store(kept.emplace_back(std::move(words)).c_str());
}

StopAtOnce::StopAtOnce() {
  ++not_to_be_stopped;
  if (!interrupted()) return;
  --not_to_be_stopped;
  throw_if_interrupted();
}

StopAtOnce::~StopAtOnce() { --not_to_be_stopped; }

}  // namespace phos
