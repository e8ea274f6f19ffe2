#include "scene/luminaire/photometric_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace phos::inline scene {
namespace {

constexpr double kNoise = 0.01;  // of the greatest value

std::string_view trimmed(std::string_view s) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

}  // namespace

std::vector<PhotometricLine> photometric_lines(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  bytes = bytes.substr(0, bytes.find('\x1a'));
  std::vector<PhotometricLine> lines;
  std::size_t number = 0;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
    lines.push_back({trimmed(bytes.substr(0, end)), ++number});
    const bool both = end + 1 < bytes.size() && bytes[end] == '\r' && bytes[end + 1] == '\n';
    bytes.remove_prefix(std::min(bytes.size(), end + (both ? 2 : 1)));
  }
  return lines;
}

void fail_at(const std::string& where, std::size_t line, const std::string& message) {
  throw Error(ExitCode::bad_input, text(where, ":", line), message);
}

std::string plain_text(std::string_view words) {
  const auto latin_1 = [](std::string& out, unsigned char c) {
    out += static_cast<char>(0xc0 | c >> 6), out += static_cast<char>(0x80 | (c & 0x3f));
  };
  words = trimmed(words).substr(0, 256);
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto c = static_cast<unsigned char>(words[i]);
    // Two-byte sequences of UTF-8 cover Latin-1; longer ones are kept where they are whole.
    const std::size_t more = c >= 0xf0 && c < 0xf5   ? 3
                             : c >= 0xe0 && c < 0xf0 ? 2
                             : c >= 0xc2 && c < 0xe0 ? 1
                                                     : 0;
    const std::string_view tail = words.substr(i + 1, more);
    const bool whole = more > 0 && tail.size() == more &&
                       std::all_of(tail.begin(), tail.end(), [](char t) { return (t & 0xc0) == 0x80; });
    if (c < 0x80) {
      out += c < 32 || c == 127 ? ' ' : static_cast<char>(c);
    } else if (whole) {
      out.append(words.substr(i, more + 1));
      i += more;
    } else {
      latin_1(out, c);
    }
  }
  return std::string(trimmed(out));
}

bool photometric_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value) && !word.empty();
}

void require_ascending(const std::vector<double>& deg, const char* which, const std::string& where,
                       std::size_t line, const char* mend) {
  for (std::size_t i = 1; i < deg.size(); ++i) {
    if (!(deg[i] >= deg[i - 1] + kLeastStep_deg))
      fail_at(where, line,
              text(which, " angles must ascend, but ", deg[i - 1], " is followed by ", deg[i], "; ", mend));
  }
}

std::vector<float> CandelaList::finish(double factor, const std::string& where,
                                       std::vector<std::string>& warnings) const {
  const auto lowest = std::min_element(cd.begin(), cd.end());
  const double most = cd.empty() ? 0 : *std::max_element(cd.begin(), cd.end());
  if (lowest != cd.end() && *lowest < 0) {
    const std::size_t at = line[static_cast<std::size_t>(lowest - cd.begin())];
    if (!(-*lowest <= kNoise * most))
      fail_at(where, at, text("an intensity is negative: ", *lowest, "; ", kAskTheMaker));
    const auto n = std::count_if(cd.begin(), cd.end(), [](double v) { return v < 0; });
    warnings.push_back(text(n, " intensities are slightly negative (down to ", *lowest,
                            "), which is noise of the measurement: they are taken as 0"));
  }
  if (!(most * factor <= 1e30))
    throw Error(ExitCode::bad_input, where,
                text("the greatest intensity, ", most * factor, " cd, is beyond 1e30; ", kAskTheMaker));
  std::vector<float> out;
  for (const double v : cd) out.push_back(static_cast<float>(std::max(0.0, v) * factor));
  return out;
}

void Planes::mirror_at_end() {
  const double end = azimuth_deg.back();
  for (std::size_t i = azimuth_deg.size() - 1; i-- > 0;) {
    azimuth_deg.push_back(2 * end - azimuth_deg[i]);
    row.push_back(row[i]);
  }
}

}  // namespace phos::inline scene
