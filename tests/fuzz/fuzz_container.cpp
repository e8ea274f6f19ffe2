// Any bytes: the container reader answers with its contents or with an Error of one line, and nothing else.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "file/container.h"
#include "file/hash.h"
#include "file/inspect.h"

namespace {

/// Reads all that a tool could read.
void read_everything(const std::string& path) {
  using namespace phos;
  hash_file(path);
  const Container file = Container::open(path);
  describe_text(file);
  canonical_text(file);
  const auto ignore = [](std::string_view) {};
  for (const auto& [name, tensor] : file.tensors()) {
    try {
      dump_csv(file, {name}, true, ignore);
    } catch (const Error& e) {
      if (e.code() != ExitCode::usage) throw;  // a tensor without rows
    }
  }
  if (file.has("position")) write_ply(file, PlyFormat::ascii, ignore);
  file.verify();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int fd = memfd_create("phos", MFD_CLOEXEC);
  if (ftruncate(fd, static_cast<off_t>(size)) != 0) std::abort();
  if (pwrite(fd, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  try {
    read_everything("/proc/self/fd/" + std::to_string(fd));
  } catch (const phos::Error& e) {
    if (e.code() != phos::ExitCode::bad_input || std::string(e.what()).find('\n') != std::string::npos)
      std::abort();
  }
  return 0;
}
