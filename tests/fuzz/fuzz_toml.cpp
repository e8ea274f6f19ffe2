// Files of studies: their TOML, and what a study says of itself before it asks the programs for their
// options.
#include "reading.h"
#include "study/spec/study_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string_view bytes = fuzz::characters(data, size);
  fuzz::answers([&] { fuzz::use(parse_toml(bytes, "input.toml").root.dump()); });
  fuzz::spilled("", "room.glb"), fuzz::spilled("", "points.csv");
  const std::string path = fuzz::spilled(bytes, "input.toml");
  return fuzz::answers([&] {
    try {
      // No program is there: a study that comes so far is asked of one, and refused.
      fuzz::use(read_study(path, CommandRunner({}, fuzz::scratch())));
    } catch (const Error& e) {
      if (e.code() != ExitCode::usage) throw;  // what a study asks for may make no sense
    }
  });
}
