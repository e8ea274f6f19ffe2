// Golden files in data/golden: the output of a stage when it was last checked. A test program takes --update,
// which writes them anew and prints the changes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "file/json_parse.h"
#include "image/image.h"
#include "support/run.h"
#include "support/update.h"

namespace phos::test {

inline std::string golden_path(const std::string& name) {
  return std::string(PHOS_SOURCE) + "/data/golden/" + name;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Lines that are only in one of two texts, with "- " before lines of `old` and "+ " before lines of `fresh`.
inline std::string changes(const std::string& old, const std::string& fresh) {
  const std::vector<std::string> a = lines_of(old), b = lines_of(fresh);
  // Longest common subsequence; the texts have tens of lines.
  std::vector<std::vector<int>> common(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
  std::string out;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i, ++j;
    } else if (j == b.size() || (i < a.size() && common[i + 1][j] >= common[i][j + 1])) {
      out.append("- ").append(a[i++]).append("\n");
    } else {
      out.append("+ ").append(b[j++]).append("\n");
    }
  }
  return out;
}

inline void update_text(const std::string& name, const std::string& fresh) {
  const std::string old = slurp(golden_path(name));
  if (old == fresh) {
    std::printf("%s: as it was\n", name.c_str());
    return;
  }
  std::printf("%s: written\n%s", name.c_str(), changes(old, fresh).c_str());
  spill(golden_path(name), fresh);
}

/// Exactly the golden text.
inline void expect_golden_text(const std::string& name, const std::string& fresh) {
  if (updating_golden()) return update_text(name, fresh);
  ASSERT_TRUE(std::filesystem::exists(golden_path(name))) << name << ": run this program with --update";
  const std::string golden = slurp(golden_path(name));
  EXPECT_TRUE(fresh == golden) << name << " differs (run with --update if that is meant):\n"
                               << changes(golden, fresh);
}

using Numbers = std::map<std::string, double>;

inline std::string to_json_lines(const Numbers& numbers) {
  std::string s = "{\n";
  std::size_t left = numbers.size();
  for (const auto& [name, value] : numbers) {
    char line[64];
    std::snprintf(line, sizeof line, "%.9g%s\n", value, --left > 0 ? "," : "");
    s.append("  \"").append(name).append("\": ").append(line);
  }
  return s + "}\n";
}

/// Reads the text that to_json_lines wrote.
inline Numbers from_json_lines(const std::string& text) {
  Numbers numbers;
  for (const std::string& line : lines_of(text)) {
    const std::size_t from = line.find('"'), to = line.find("\": ");
    if (from == std::string::npos || to == std::string::npos) continue;
    numbers[line.substr(from + 1, to - from - 1)] = std::stod(line.substr(to + 3));
  }
  return numbers;
}

/// Largest magnitude among the numbers that share the name up to its last dot ("flux.0.mean": "flux.0.max").
inline double size_of_kin(const Numbers& numbers, const std::string& name) {
  const std::string kin = name.substr(0, name.rfind('.') + 1);
  double size = 0;
  for (const auto& [other, value] : numbers)
    if (other.rfind(kin, 0) == 0) size = std::max(size, std::fabs(value));
  return size;
}

/// Each number within `tolerance` of the size of its kin. A name that is missing or new fails.
inline void expect_golden_numbers(const std::string& name, const Numbers& fresh, double tolerance) {
  for (const auto& [what, value] : fresh) EXPECT_TRUE(std::isfinite(value)) << what;
  if (updating_golden()) return update_text(name, to_json_lines(fresh));
  ASSERT_TRUE(std::filesystem::exists(golden_path(name))) << name << ": run this program with --update";
  const Numbers golden = from_json_lines(slurp(golden_path(name)));
  for (const auto& [what, value] : golden) {
    const auto found = fresh.find(what);
    if (found == fresh.end()) {
      ADD_FAILURE() << name << ": " << what << " is gone";
      continue;
    }
    EXPECT_NEAR(found->second, value, tolerance * size_of_kin(golden, what)) << name << ": " << what;
  }
  for (const auto& [what, value] : fresh) EXPECT_TRUE(golden.contains(what)) << name << ": new: " << what;
}

/// Mean, least and greatest value of each column of a phos file, as phos-info says them: "flux.0.mean".
inline Numbers ranges_of(const std::string& file) {
  const test::Run run = run_tool({"info", file, "--json"});
  EXPECT_EQ(run.code, 0) << run.err;
  Numbers numbers;
  const Json described = parse_json(run.out, file);
  for (const auto& [tensor, about] : described.find("tensors")->as_object()) {
    for (const char* what : {"mean", "min", "max"}) {
      const Json* values = about.find(what);
      if (values == nullptr) continue;
      const Json::Array columns = values->is_array() ? values->as_array() : Json::Array{*values};
      for (std::size_t c = 0; c < columns.size(); ++c)
        numbers[tensor + "." + std::to_string(c) + "." + what] = columns[c].as_number();
    }
  }
  return numbers;
}

/// How far an image may differ: at most the share `fraction` of a channel's values by more than `relative`
/// times the channel's mean magnitude, and no value by more than `hard` times that magnitude.
struct ImageTolerance {
  double relative = 1e-3, fraction = 0.01, hard = 1;
};

struct ChannelDifference {
  double mean_magnitude = 0, worst = 0;  ///< worst difference, in units of mean_magnitude
  double beyond = 0;                     ///< share of the values that differ by more than `relative`
};

inline ChannelDifference difference(std::span<const float> fresh, std::span<const float> golden,
                                    double relative) {
  ChannelDifference d;
  for (const float v : golden) d.mean_magnitude += std::fabs(static_cast<double>(v));
  d.mean_magnitude /= static_cast<double>(golden.size());
  const double unit = d.mean_magnitude > 0 ? d.mean_magnitude : 1;
  for (std::size_t i = 0; i < golden.size(); ++i) {
    const double off = std::fabs(static_cast<double>(fresh[i]) - static_cast<double>(golden[i])) / unit;
    d.worst = std::isfinite(off) ? std::max(d.worst, off) : HUGE_VAL;
    d.beyond += !(off <= relative);
  }
  d.beyond /= static_cast<double>(golden.size());
  return d;
}

/// The image in the file `fresh` against the golden one, channel by channel.
inline void expect_golden_image(const std::string& name, const std::string& fresh,
                                const ImageTolerance& tolerance) {
  const Image image = read_image(fresh);
  const bool there = std::filesystem::exists(golden_path(name));
  ASSERT_TRUE(there || updating_golden()) << name << ": run this program with --update";
  Image golden = there ? read_image(golden_path(name)) : Image(image.width(), image.height());
  const bool same_size = golden.width() == image.width() && golden.height() == image.height();
  if (updating_golden()) {
    std::printf("%s: %s\n", name.c_str(), slurp(fresh) == slurp(golden_path(name)) ? "as it was" : "written");
    for (const auto& [channel, values] : image.channels()) {
      if (!same_size || !golden.has(channel)) {
        std::printf("+ %s\n", channel.c_str());
        continue;
      }
      const ChannelDifference d = difference(values, golden.channel(channel), tolerance.relative);
      if (d.worst > 0)
        std::printf("  %s: worst difference %.3g of the mean, %.3g %% of the values beyond tolerance\n",
                    channel.c_str(), d.worst, 100 * d.beyond);
    }
    std::filesystem::copy_file(fresh, golden_path(name), std::filesystem::copy_options::overwrite_existing);
    return;
  }
  ASSERT_TRUE(same_size) << name;
  ASSERT_EQ(image.channels().size(), golden.channels().size()) << name;
  for (const auto& [channel, values] : golden.channels()) {
    ASSERT_TRUE(image.has(channel)) << name << ": " << channel << " is gone";
    const ChannelDifference d = difference(image.channel(channel), values, tolerance.relative);
    EXPECT_LE(d.beyond, tolerance.fraction) << name << ": " << channel;
    EXPECT_LE(d.worst, tolerance.hard) << name << ": " << channel;
  }
}

}  // namespace phos::test
