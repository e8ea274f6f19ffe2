// docs/reference/measured-limits.md: for each quantity the range in which it is right, written by the tests
// that found it. A test program takes --update, which writes its lines anew.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "support/golden.h"

namespace phos::test {

/// One line of the page.
struct Limit {
  std::string quantity, along;  ///< "direct light", "length, times": together they name the line
  double from = 0, to = 0;      ///< the range in which results are right
  double error = 0;             ///< the greatest relative error there; 0: every bit follows the law
  std::string beyond;           ///< the behaviour outside
  bool noisy = false;           ///< the error comes on top of the estimate's standard error
};

inline std::string limits_path() { return std::string(PHOS_SOURCE) + "/docs/reference/measured-limits.md"; }

/// 1.5 times the measured error, rounded up to 1, 2 or 5 times a power of ten: the same on other machines.
inline double stated_error(double measured) {
  if (!(measured > 0)) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(1.5 * measured)));
  for (const double step : {1.0, 2.0, 5.0})
    if (1.5 * measured <= step * unit * (1 + 1e-9)) return step * unit;
  return 10 * unit;
}

inline std::string figure_text(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", v);
  return text;
}

inline std::string error_text(double stated, bool noisy) {
  if (!noisy) return stated > 0 ? figure_text(stated) : "exact";
  return stated > 0 ? "noise + " + figure_text(stated) : "noise";
}

inline std::string line_of(const Limit& l) {
  return "| " + l.quantity + " | " + l.along + " | " + figure_text(l.from) + " | " + figure_text(l.to) +
         " | " + error_text(stated_error(l.error), l.noisy) + " | " + l.beyond + " |";
}

inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t from = line.find("| "); from != std::string::npos;) {
    const std::size_t to = line.find(" |", from + 2);
    if (to == std::string::npos) break;
    cells.push_back(line.substr(from + 2, to - from - 2));
    from = line.find("| ", to + 1);
  }
  return cells;
}

inline const char* limits_head() {
  return "# Measured limits\n\n"
         "For each quantity, the table gives the range in which results are right, their error in that "
         "range, and\n"
         "the behaviour beyond. The tests of `tests/extremes` sweep until a result fails, and write these "
         "lines\n"
         "(`--update`). On every run each test compares its own lines with its results. Sizes, powers and "
         "offsets\n"
         "are swept one at a time, by powers of two, about a room of 2 x 1 x 1.5 m and lamps of some lumens. "
         "Both\n"
         "ends of the demanded range, 1e-6 to 1e6 m and 1e-12 to 1e12 lm, are tested together, too.\n\n"
         "A number under \"within\" is the greatest relative error, rounded up. \"exact\" means that every "
         "bit follows\n"
         "the law of dimensions: at equal lumens and the size s, lux go as 1/s2, gradients as 1/s3, "
         "distances as s.\n"
         "\"noise\" means that the result is off by no more than 4.5 of the standard errors that the "
         "estimate states.\n"
         "Lines on \"powers of ten\" show the effect of rounding, because no such factor is exact in binary "
         "numbers.\n"
         "Where rounding takes photons or rays over a border, estimates change within their \"noise\".\n\n"
         "Scenes far from the world's origin are counted from an origin near the scene, at most sixteen "
         "diagonals\n"
         "away; glTF nodes and OBJ vertices are read in double precision. Lines on \"offset of the "
         "coordinates\" show\n"
         "the offset that results would bear without such an origin.\n\n"
         "| quantity | along | right from | to | within | beyond |\n"
         "|---|---|---|---|---|---|\n";
}

inline void write_limit(const Limit& limit) {
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(slurp(limits_path()))) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != 6 || cells[0] == "quantity") continue;
    if (cells[0] == limit.quantity && cells[1] == limit.along) continue;
    lines.push_back(line);
  }
  lines.push_back(line_of(limit));
  std::sort(lines.begin(), lines.end());
  std::string page = limits_head();
  for (const std::string& line : lines) page += line + "\n";
  spill(limits_path(), page);
  std::printf("%s\n", line_of(limit).c_str());
}

/// The page has this line. Errors may differ between machines: the error on the page must hold, and must not
/// be more than twenty times the error found.
inline void expect_limit(const Limit& limit) {
  EXPECT_TRUE(std::isfinite(limit.error) && limit.from <= limit.to) << line_of(limit);
  if (updating_golden()) return write_limit(limit);
  for (const std::string& line : lines_of(slurp(limits_path()))) {
    const std::vector<std::string> page = cells_of(line), own = cells_of(line_of(limit));
    if (page.size() != 6 || page[0] != own[0] || page[1] != own[1]) continue;
    const std::string& error = page[4];
    const double stated = std::atof(error.c_str() + (error.starts_with("noise + ") ? 8 : 0));
    const bool same = page[2] == own[2] && page[3] == own[3] && page[5] == own[5] &&
                      error.starts_with("noise") == limit.noisy && limit.error <= stated &&
                      stated <= 20 * limit.error;
    EXPECT_TRUE(same) << "measured-limits.md says\n"
                      << line << "\nand this run found\n"
                      << line_of(limit) << "\n(run with --update if that is meant)";
    return;
  }
  ADD_FAILURE() << "measured-limits.md has no line for " << limit.quantity << " along " << limit.along
                << ": run this program with --update";
}

}  // namespace phos::test
