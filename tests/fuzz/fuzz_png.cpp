// Pictures to look at: PNG.
#include "image/png.h"
#include "reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  return fuzz::answers([&] {
    const Picture picture = decode_png(fuzz::characters(data, size), "input");
    const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    PHOS_CHECK(picture.rgb.size() == 3 * pixels, picture.width, " x ", picture.height);
  });
}
