// Any bytes: the container reader answers with its contents or with an Error of one line, and nothing else.
#include "file/container.h"
#include "file/hash.h"
#include "file/inspect/inspect.h"
#include "file/inspect/rows.h"
#include "reading.h"

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
  using namespace phos::fuzz;
  return answers([&] { read_everything(spilled(characters(data, size))); });
}
