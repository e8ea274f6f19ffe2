// Pictures on surfaces: PNG, JPEG, BMP and TGA.
#include "reading.h"
#include "scene/texture/load_textures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  return fuzz::answers([&] {
    Scene scene;
    TexturePool pool;
    pool.add("input", "input", std::string(fuzz::characters(data, size)), "", {}, size % 2 == 0);
    pool.decode(scene);
    PHOS_CHECK(scene.texture.size() + scene.warnings.size() == 1, "neither read nor refused");
    if (!scene.texture.empty()) fuzz::use(scene.texture.front());
  });
}
