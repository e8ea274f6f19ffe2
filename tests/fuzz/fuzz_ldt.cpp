// Photometry of luminaires, EULUMDAT; and telling formats apart.
#include "photometry_holds.h"

#include "scene/luminaire/eulumdat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string_view bytes = fuzz::characters(data, size);
  fuzz::answers([&] { fuzz::require_sound(parse_eulumdat(bytes, "input")); });
  return fuzz::answers([&] { fuzz::require_sound(parse_photometry(bytes, "input")); });
}
