// A browser without a screen.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/from_base64.h"
#include "support/run.h"

namespace phos::test {

inline bool has_chromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

struct Shown {
  std::string page;     ///< its text at the end
  std::string console;  ///< what it said
};

/// Opens an address in a Chromium of its own.
inline Shown open_page(const std::string& url, const std::string& folder) {
  const std::string command =
      "timeout 180 chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
      "--disable-dev-shm-usage --enable-logging=stderr --virtual-time-budget=60000 --user-data-dir='" +
      folder + "/profile' --dump-dom '" + url + "' >'" + folder + "/page' 2>'" + folder + "/log'";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(std::system(command.c_str()), 0) << slurp(folder + "/log");
  Shown shown{slurp(folder + "/page"), ""};
  std::istringstream log(slurp(folder + "/log"));
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos) shown.console += line + "\n";
  return shown;
}

/// The values of a quantity that the page says.
inline std::vector<float> values_of(const Shown& shown) {
  const std::string begin = "<pre id=\"dump\">";
  const std::size_t at = shown.page.find(begin);
  if (at == std::string::npos) return {};
  const std::string bytes = from_base64(std::string_view(shown.page).substr(at + begin.size()));
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

}  // namespace phos::test
