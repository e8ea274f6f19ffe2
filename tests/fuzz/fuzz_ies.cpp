// Photometry of luminaires, LM-63; the file that TILT= names is the input again.
#include "photometry_holds.h"

#include "scene/luminaire/ies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string_view bytes = fuzz::characters(data, size);
  return fuzz::answers([&] {
    fuzz::require_sound(parse_ies(bytes, "input", [&](const std::string&) { return std::string(bytes); }));
  });
}
