// Pictures of light: Radiance .hdr.
#include "image/hdr.h"
#include "reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  return fuzz::answers([&] {
    const Image image = decode_hdr(fuzz::characters(data, size), "input");
    for (const auto& [name, values] : image.channels()) PHOS_CHECK(values.size() == image.pixels(), name);
  });
}
