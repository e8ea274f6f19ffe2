// Files of options (@FILE): what a command line may say, of every kind of option.
#include "reading.h"
#include "support/every_option.h"

namespace {

using namespace phos;

void parse(const std::string& path) {
  test::EveryOption all(false);
  const std::string argument = "@" + path;
  const char* const words[] = {"phos-x", argument.c_str()};
  if (!all.options.parse(2, words)) return;
  PHOS_CHECK(all.number > 0 && all.count >= 0 && all.count <= 100, all.number, " ", all.count);
  fuzz::use(all.options.recorded().dump());
  fuzz::use(all.options.command());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool silent = std::freopen("/dev/null", "w", stdout) != nullptr;  // --help is printed
  static_cast<void>(silent);
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "options");
  try {
    parse(path);
  } catch (const Error& e) {
    // Of the words in it, not of the file.
    if (e.code() != ExitCode::usage || std::string(e.what()).find('\n') != std::string::npos)
      fuzz::require_answer(e);
  }
  return 0;
}
