// Pages in a browser without a screen.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/run.h"

namespace phos::test {

inline bool has_chromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

struct Shown {
  std::string page;     ///< its text at the end
  std::string console;  ///< what it said
};

/// Opens an address in a Chromium of its own, with these words more on its command line.
inline Shown open_page(const std::string& url, const std::string& folder, const std::string& words = "") {
  const std::string command =
      "timeout 180 chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
      "--disable-dev-shm-usage --enable-logging=stderr --virtual-time-budget=60000 --user-data-dir='" +
      folder + "/profile' " + words + " --dump-dom '" + url + "' >'" + folder + "/page' 2>'" + folder +
      "/log'";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(std::system(command.c_str()), 0) << slurp(folder + "/log");
  Shown shown{slurp(folder + "/page"), ""};
  std::istringstream log(slurp(folder + "/log"));
  for (std::string line; std::getline(log, line);) {
    // Chromium's own advice on speed ("GPU stall due to ReadPixels") is none of the page's words.
    const bool advice = line.find("GL Driver Message") != std::string::npos;
    if (!advice && line.find("CONSOLE") != std::string::npos) shown.console += line + "\n";
  }
  return shown;
}

inline std::vector<float> from_base64(const std::string& text) {
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) break;
    value = value << 6 | static_cast<unsigned>(digit);
    if ((bits += 6) >= 8) bits -= 8, bytes += static_cast<char>(value >> bits & 255);
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

/// What the page says in an element: "dump"; "" where there is none.
inline std::string words_of(const Shown& shown, const std::string& id) {
  const std::string begin = "<pre id=\"" + id + "\">";
  const std::size_t at = shown.page.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return shown.page.substr(from, shown.page.find('<', from) - from);
}

/// The values of a quantity that the page says.
inline std::vector<float> values_of(const Shown& shown) { return from_base64(words_of(shown, "dump")); }

}  // namespace phos::test
