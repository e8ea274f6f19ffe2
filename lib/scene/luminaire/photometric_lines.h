// Lines and numbers of photometric files, for their readers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

/// A line without its end (LF, CR LF or CR) and the blanks about it; its number counts from 1.
struct PhotometricLine {
  std::string_view words;
  std::size_t number = 0;
};
/// A byte-order mark is left out, and all from a Ctrl-Z on (files of MS-DOS end so).
std::vector<PhotometricLine> photometric_lines(std::string_view bytes);

[[noreturn]] void fail_at(const std::string& where, std::size_t line, const std::string& message);

/// Words for people, UTF-8: blanks about them left out, control characters blank, other bytes read as
/// Latin-1.
std::string plain_text(std::string_view words);

/// A finite number, or nothing.
bool photometric_number(std::string_view word, double& value);

inline constexpr const char* kAskTheMaker = "ask the maker for a sound file";
/// Angles must ascend by kLeastStep_deg at least; `mend` ends the message if they do not.
void require_ascending(const std::vector<double>& deg, const char* which, const std::string& where,
                       std::size_t line, const char* mend = kAskTheMaker);

/// A measured value, as it is stored. Slightly negative ones (1 % of the greatest; noise of the photometer)
/// become 0 and one warning; others are an error that names the line of the lowest.
struct CandelaList {
  std::vector<double> cd;
  std::vector<std::size_t> line;
  /// All multiplied by `factor` (not negative).
  std::vector<float> finish(double factor, const std::string& where,
                            std::vector<std::string>& warnings) const;
};

/// Planes of a half or a quarter of the circle, mirrored into the whole circle. `azimuth_deg` ascends and
/// ends where the mirrors stand; `row[i]` is the plane of the file that node i shows.
struct Planes {
  std::vector<double> azimuth_deg;
  std::vector<std::size_t> row;
  /// Mirrors all planes in the plane of azimuth `deg`, which is the last or the first plane.
  void mirror_at_end();
};

}  // namespace phos::inline scene
