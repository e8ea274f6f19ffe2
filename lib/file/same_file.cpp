#include "file/same_file.h"

#include <sys/stat.h>

#include "core/error.h"

namespace phos::inline file {

int standard_stream(const std::string& path) {
  if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1") return 1;
  if (path == "/dev/stderr" || path == "/dev/fd/2" || path == "/proc/self/fd/2") return 2;
  return -1;
}

std::string file_key(const std::string& path) {
  const auto place = [](const struct stat& info) { return text(info.st_dev, ":", info.st_ino); };
  if (const int stream = standard_stream(path); stream >= 0) return stream == 1 ? "standard output" : "";
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) return S_ISREG(info.st_mode) ? place(info) : "";
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  if (::stat(folder.c_str(), &info) != 0) return "";
  return text(place(info), "/", path.substr(slash + 1));  // npos + 1 is 0
}

}  // namespace phos::inline file
