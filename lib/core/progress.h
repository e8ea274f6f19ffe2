// Progress on stderr: total, rate, time left.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace phos {

enum class ProgressMode {
  automatic,  ///< a line that redraws itself if stderr is a terminal, else nothing
  always,     ///< also without a terminal (one line per step of about 2 s)
  never,
  json,  ///< one JSON object per line: label, done, total, unit, per_second, seconds_left
};

void set_progress_mode(ProgressMode mode);

/// One running piece of work. advance() may be called from any thread. Work within other work is shown only
/// where it takes seconds.
class Progress {
 public:
  Progress(std::string label, std::uint64_t total, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void advance(std::uint64_t steps = 1);

 private:
  void show(bool last);
  std::string label_, unit_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::chrono::steady_clock::time_point start_, shown_;
  std::mutex mutex_;
  bool inner_, seen_ = false;  ///< within other work; shown at least once
};

}  // namespace phos
