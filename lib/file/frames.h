// Numbers of frames, and the names of one file for each.
#pragma once

#include <cstdint>
#include <string>

#include "core/options.h"

namespace phos::inline file {

/// Whole frames, both ends included. Frame f is the scene at f / frames_per_s seconds.
struct FrameRange {
  std::int64_t first = 0, last = 0;
  std::int64_t count() const { return last - first + 1; }
  bool contains(std::int64_t frame) const { return first <= frame && frame <= last; }
};
/// --frames A:B, or one frame A; `frames` empty: not given.
void declare_frames(Options& options, std::string& frames, Recorded recorded = Recorded::yes);
/// Throws Error(usage) for a text that is no range, a reversed range, or one that begins below 0.
FrameRange parse_frames(const std::string& frames);

/// A file's name with the frame's number in it, as printf has it: film/%04d.exr (0012), or %d (12); %% is %.
class FramePattern {
 public:
  /// Throws Error(usage, where) for anything else after a %, or for two numbers.
  FramePattern(const std::string& pattern, const std::string& where);
  /// Is there a number in it? Else every frame has one name.
  bool numbered() const { return numbered_; }
  std::string path(std::int64_t frame) const;

 private:
  std::string before_, after_;
  int digits_ = 0;
  bool numbered_ = false;
};

/// Is it a pattern with a number?
bool names_frames(const std::string& name);

/// The pattern of a sequence of `range`. Throws Error(usage, where), with an example, where several frames
/// would have one name.
FramePattern sequence_pattern(const std::string& pattern, const FrameRange& range, const std::string& where);

/// The frames that are there already, for reading: `path` itself, or the pattern of the numbered images
/// (.exr, .hdr) in that folder. Throws Error(bad_input) for a folder without any, or with several sequences.
FramePattern existing_sequence(const std::string& path, const FrameRange& range, const std::string& where);

}  // namespace phos::inline file
