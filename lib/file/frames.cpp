#include "file/frames.h"

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>

#include "core/error.h"
#include "file/limits.h"

namespace phos::inline file {
namespace {

[[noreturn]] void refuse(const std::string& frames) {
  throw Error(
      ExitCode::usage, "--frames",
      text("\"", frames, "\" is no range of frames; give first and last frame as 0:47, or one as 12"));
}

std::int64_t whole(std::string_view digits, const std::string& frames) {
  std::int64_t n = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
  if (error != std::errc() || end != digits.data() + digits.size()) refuse(frames);
  return n;
}

/// A file's name as a pattern; "" for a name without a number before its ending, or of another kind.
std::string pattern_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || (name.substr(dot) != ".exr" && name.substr(dot) != ".hdr")) return "";
  std::size_t begin = dot;
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  if (begin == dot) return "";
  std::string pattern;
  for (const char c : name.substr(0, begin)) pattern += c == '%' ? "%%" : std::string(1, c);
  const std::size_t digits = dot - begin;
  const bool padded = name[begin] == '0' && digits > 1;
  return pattern + (padded ? text("%0", digits, "d") : "%d") + name.substr(dot);
}

/// 0999 and 1000 are of one sequence: where there is a padded pattern, the plain one of the same name is it.
std::set<std::string> patterns_in(const std::filesystem::path& folder) {
  std::set<std::string> all;
  std::error_code unreadable;
  std::filesystem::directory_iterator entries(folder, unreadable);
  if (unreadable)
    throw Error(ExitCode::bad_input, folder.string(), text("cannot be read: ", unreadable.message()));
  for (const auto& entry : entries)
    if (const std::string p = pattern_of(entry.path().filename().string()); !p.empty()) all.insert(p);
  std::set<std::string> padded;
  for (const std::string& p : all)
    if (const std::size_t at = p.rfind("%0"); at != std::string::npos)
      padded.insert(p.substr(0, at) + "%d" + p.substr(p.rfind('.')));
  for (const std::string& p : padded) all.erase(p);
  return all;
}

}  // namespace

void declare_frames(Options& options, std::string& frames, Recorded recorded) {
  options.text("frames", frames, "A:B", "frames A to B of the animation, both included, or one frame",
               recorded);
}

FrameRange parse_frames(const std::string& frames) {
  const std::size_t colon = frames.find(':');
  const std::string_view all = frames;
  if (frames.empty())
    throw Error(ExitCode::usage, "--frames", "is missing; give first and last frame as 0:47, or one as 12");
  FrameRange range;
  range.first = whole(all.substr(0, colon), frames);
  range.last = colon == std::string::npos ? range.first : whole(all.substr(colon + 1), frames);
  if (range.first < 0)
    throw Error(ExitCode::usage, "--frames",
                text(frames, " begins before frame 0; frames are counted from 0"));
  if (range.last < range.first)
    throw Error(ExitCode::usage, "--frames",
                text(frames, " ends before it begins; give ", range.last, ":", range.first));
  if (range.last > kMostFrame.most)
    throw Error(ExitCode::usage, "--frames",
                text(frames, " is out of range; frames go up to ", written(kMostFrame)));
  return range;
}

FramePattern::FramePattern(const std::string& pattern, const std::string& where) {
  const auto fail = [&](const std::string& why) {
    throw Error(ExitCode::usage, where,
                text("\"", pattern, "\" ", why,
                     "; write the frame's number as one %d or %04d, and a percent sign as %%"));
  };
  std::string* out = &before_;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      *out += pattern[i];
      continue;
    }
    if (pattern.substr(i, 2) == "%%") {
      *out += '%', ++i;
      continue;
    }
    const std::size_t d = pattern.find_first_not_of("0123456789", i + 1);
    const std::string width = pattern.substr(i + 1, d == std::string::npos ? d : d - i - 1);
    if (d == std::string::npos || pattern[d] != 'd' || width.size() > 3 ||
        (!width.empty() && (width[0] != '0' || width.size() == 1)))
      fail("has a % that is not the number of a frame");
    if (numbered_) fail("has two numbers");
    numbered_ = true;
    digits_ = width.empty() ? 0 : std::stoi(width);
    out = &after_;
    i = d;
  }
}

std::string FramePattern::path(std::int64_t frame) const {
  if (!numbered_) return before_;
  std::string digits = std::to_string(frame);
  if (digits.size() < static_cast<std::size_t>(digits_))
    digits.insert(0, static_cast<std::size_t>(digits_) - digits.size(), '0');
  return before_ + digits + after_;
}

bool names_frames(const std::string& name) {
  try {
    return FramePattern(name, "").numbered();
  } catch (const Error&) {
    return false;
  }
}

FramePattern sequence_pattern(const std::string& pattern, const FrameRange& range, const std::string& where) {
  FramePattern names(pattern, where);
  if (range.count() > 1 && !names.numbered()) {
    const std::size_t slash = pattern.rfind('/') + 1, dot = pattern.rfind('.');
    const std::size_t end = dot == std::string::npos || dot < slash ? pattern.size() : dot;
    throw Error(
        ExitCode::usage, where,
        text("\"", pattern, "\" is one name for ", range.count(), " frames; put their number in it, as in ",
             pattern.substr(0, end), end > slash ? "-" : "", "%04d", pattern.substr(end)));
  }
  return names;
}

FramePattern existing_sequence(const std::string& path, const FrameRange& range, const std::string& where) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return sequence_pattern(path, range, where);
  const std::set<std::string> patterns = patterns_in(path);
  if (patterns.empty())
    throw Error(ExitCode::bad_input, path,
                "holds no numbered images (0000.exr); name them as folder/%04d.exr");
  if (patterns.size() > 1)
    throw Error(ExitCode::bad_input, path,
                text("holds several sequences (", *patterns.begin(), ", ", *std::next(patterns.begin()),
                     "); name one, as folder/", *patterns.begin()));
  std::string folder;
  for (const char c : path) folder += c == '%' ? "%%" : std::string(1, c);
  return {folder + "/" + *patterns.begin(), where};
}

}  // namespace phos::inline file
