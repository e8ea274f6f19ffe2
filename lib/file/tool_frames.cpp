// A sequence: one command, one file for each frame.
#include <chrono>

#include "core/interrupt.h"
#include "file/atomic_file.h"
#include "file/tool.h"

namespace phos::inline file {
namespace {

Json counts_of(const Counters& counters) {
  Json counts(Json::Object{});
  for (const auto& [event, n] : counters.counts()) counts[event] = n;
  return counts;
}

/// Times of the frames together.
void add_seconds(std::map<std::string, double>& all, const Json& stats) {
  for (const auto& [name, value] : stats.as_object())
    if (name.starts_with("seconds.") && value.is_number()) all[name] += value.as_number();
}

}  // namespace

void Tool::takes_frames(std::optional<double>& frame) {
  frame_ = &frame;
  options_.text(
      "frames", frames_, "A:B",
      "frames A to B of the animation, one file each; the name of the output holds the frame number as %04d",
      Recorded::no);
}

void Tool::require_frames_of_pattern() const {
  if (frame_ == nullptr || !frames_.empty() || !names_frames(output_)) return;
  throw Error(
      ExitCode::usage, "--output",
      text("\"", output_, "\" names a sequence; say which frames: --frames 0:47, or one: --frames 12"));
}

std::optional<FrameRange> Tool::frames() const {
  if (frames_.empty()) return std::nullopt;
  return parse_frames(frames_);
}

std::string Tool::frame_path(const std::string& pattern, const std::string& option) const {
  if (!at_frame_ || pattern.empty()) return pattern;
  return sequence_pattern(pattern, parse_frames(frames_), option).path(*at_frame_);
}

void Tool::begin_frame(std::int64_t frame, const FramePattern& names) {
  at_frame_ = frame;
  *frame_ = static_cast<double>(frame);
  for (const auto& refresh : fresh_) refresh();
  inputs_.clear();
  history_ = Json::Array{};
  asked_key_.clear();
  stats_ = Json::Object{};
  counters_ = {};
  output_ = names.path(frame);
  if (!output_.empty() && !why_) require_writable(output_);
}

void Tool::run_frames(const std::function<void()>& body) {
  for (const char* other : {"frame", "time"})
    if (options_.given(other)) throw Error(ExitCode::usage, "--frames", text("give either it or --", other));
  const FrameRange range = parse_frames(frames_);
  if (output_.empty() && range.count() > 1)
    throw Error(ExitCode::usage, "-o", "several frames need a name for each: -o film/%04d.exr");
  const FramePattern names = sequence_pattern(output_, range, "--output");
  Json each = Json::Array{};
  Counters counters;
  std::map<std::string, double> seconds;
  Progress progress("frames", static_cast<std::uint64_t>(range.count()), "frames");
  for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
    const auto start = std::chrono::steady_clock::now();
    begin_frame(frame, names);
    throw_if_interrupted();
    body();
    say_if_interrupted(text("interrupted; frames ", range.first, " to ", frame, " are done",
                            keyed_ ? ", --reuse goes on from there" : ""));
    stats_["frame"] = frame;
    stats_["seconds.total"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    stats_["counters"] = counts_of(counters_);
    counters.merge(counters_);
    add_seconds(seconds, stats_);
    each.push_back(stats_);
    progress.advance();
  }
  at_frame_.reset();
  frame_->reset();
  counters_ = counters;
  stats_ = Json::Object{};
  for (const auto& [name, sum] : seconds) stats_[name] = sum;
  stats_["frames"] = std::move(each);
}

}  // namespace phos::inline file
