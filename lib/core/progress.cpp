#include "core/progress.h"

#include <unistd.h>

#include <cstdio>

#include "core/json.h"

namespace phos {

namespace {

std::atomic<ProgressMode> mode{ProgressMode::automatic};
std::atomic<int> running{0};

bool shown_on_terminal() { return isatty(STDERR_FILENO) != 0; }

std::string seconds_text(double s) {
  char buffer[32];
  if (s < 100)
    std::snprintf(buffer, sizeof buffer, "%.0f s", s);
  else if (s < 6000)
    std::snprintf(buffer, sizeof buffer, "%.0f min", s / 60);
  else
    std::snprintf(buffer, sizeof buffer, "%.1f h", s / 3600);
  return buffer;
}

std::string count_text(double n) {
  char buffer[32];
  const char* suffix = n >= 1e9 ? "G" : n >= 1e6 ? "M" : n >= 1e4 ? "k" : "";
  const double unit = n >= 1e9 ? 1e9 : n >= 1e6 ? 1e6 : n >= 1e4 ? 1e3 : 1;
  std::snprintf(buffer, sizeof buffer, unit == 1 ? "%.0f%s" : "%.1f %s", n / unit, suffix);
  return buffer;
}

}  // namespace

void set_progress_mode(ProgressMode m) { mode = m; }

Progress::Progress(std::string label, std::uint64_t total, std::string unit)
    : label_(std::move(label)), unit_(std::move(unit)), total_(total) {
  start_ = shown_ = std::chrono::steady_clock::now();
  inner_ = running++ > 0;
}

Progress::~Progress() {
  if (!inner_ || seen_) show(true);
  --running;
}

void Progress::advance(std::uint64_t steps) {
  done_.fetch_add(steps, std::memory_order_relaxed);
  if (mode == ProgressMode::never) return;
  // Whoever finds the lock free draws; nobody waits for a line of progress.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto now = std::chrono::steady_clock::now();
  const bool often = mode == ProgressMode::automatic && !inner_;
  if (std::chrono::duration<double>(now - shown_).count() < (often ? 0.2 : 2.0)) return;
  shown_ = now, seen_ = true;
  show(false);
}

void Progress::show(bool last) {
  const ProgressMode m = mode;
  if (m == ProgressMode::never || (m == ProgressMode::automatic && !shown_on_terminal())) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const auto done = static_cast<double>(done_.load());
  const double rate = elapsed > 0 ? done / elapsed : 0;
  const double left = rate > 0 ? (static_cast<double>(total_) - done) / rate : 0;
  if (m == ProgressMode::json) {
    Json line;
    line["label"] = label_, line["done"] = done_.load(), line["total"] = total_, line["unit"] = unit_;
    line["per_second"] = rate, line["seconds_left"] = left;
    std::fprintf(stderr, "%s\n", line.dump().c_str());
    return;
  }
  const double percent = total_ > 0 ? 100 * done / static_cast<double>(total_) : 100;
  const std::string tail = last ? seconds_text(elapsed) : seconds_text(left) + " left";
  const bool redraws = m == ProgressMode::automatic;
  std::fprintf(stderr, "%s%s: %3.0f %% of %s %s, %s/s, %s%s%s", redraws ? "\r" : "", label_.c_str(), percent,
               count_text(static_cast<double>(total_)).c_str(), unit_.c_str(), count_text(rate).c_str(),
               tail.c_str(), redraws ? "\x1b[K" : "", redraws && !last ? "" : "\n");
}

}  // namespace phos
