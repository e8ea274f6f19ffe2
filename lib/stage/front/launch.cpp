#include "stage/front/launch.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace phos::stage {
namespace {

bool can_run(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::string path_of(const std::string& name) {
  const char* set = std::getenv("PATH");
  const std::string folders = set == nullptr ? "/usr/local/bin:/usr/bin:/bin" : set;
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t to = std::min(folders.find(':', from), folders.size());
    const std::filesystem::path folder = folders.substr(from, to - from);  // empty: the current folder
    if (const std::filesystem::path path = folder / name; can_run(path))
      return path.has_parent_path() ? path.string() : "./" + path.string();
    from = to + 1;
  }
  return "";
}

std::string path_of_phos(const std::string& name) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (const std::filesystem::path beside = self.parent_path() / name; !self.empty() && can_run(beside))
    return beside.string();
  return path_of(name);
}

void replace_by(const std::string& path, const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(path.c_str(), argv.data());
}

void launch(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string path = path_of_phos(name);
  if (path.empty())
    throw Error(ExitCode::bad_input, name, "is neither beside phos nor on PATH; install phos again");
  replace_by(path, name, arguments);
  throw Error(ExitCode::bad_input, path, text("cannot be started: ", std::strerror(errno)));
}

}  // namespace phos::stage
