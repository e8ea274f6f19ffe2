#include "scene/named_files.h"

#include "core/error.h"

namespace phos {

std::vector<NamedFile> named_files(const std::vector<std::string>& words, const std::string& option) {
  std::vector<NamedFile> out;
  for (const std::string& word : words) {
    const std::size_t at = word.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == word.size())
      throw Error(ExitCode::usage, option, text("\"", word, "\" is not of the form NAME=FILE"));
    out.push_back({word.substr(0, at), word.substr(at + 1)});
  }
  return out;
}

}  // namespace phos
