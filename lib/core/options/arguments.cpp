#include "core/options/arguments.h"

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/facts/limit.h"

namespace phos {
namespace {

/// Any file, or a pipe; not without end.
std::string options_text(const std::string& path) {
  constexpr auto kMost = kMostOptionsFileBytes.as<std::size_t>();
  std::ifstream in(path, std::ios::binary);
  std::string text(kMost + 1, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (!in && !in.eof()))
    throw Error(ExitCode::bad_input, path, "the options file cannot be read; check the path");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMost)
    throw Error(ExitCode::bad_input, path, "the options file is larger than 1 MiB; give one option a line");
  return text;
}

}  // namespace

std::vector<std::string> expand_files(int argc, const char* const* argv, std::vector<std::string>& files) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.size() < 2 || argument[0] != '@') {
      arguments.push_back(argument);
      continue;
    }
    files.push_back(argument.substr(1));
    std::istringstream in(options_text(files.back()));
    for (std::string line; std::getline(in, line);) {
      line = line.substr(0, line.find('#'));
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string::npos) continue;
      line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
      if (!line.starts_with("--")) line = "--" + line;
      const std::size_t split = line.find_first_of("= \t");
      arguments.push_back(line.substr(0, split));
      if (split == std::string::npos) continue;
      const std::size_t value = line.find_first_not_of("= \t", split);
      arguments.push_back(value == std::string::npos ? "" : line.substr(value));  // "name =": of nothing
    }
  }
  return arguments;
}

}  // namespace phos
