// Scenes in glTF, binary or text, all of the way to surfaces and lights.
#include "reading.h"
#include "scene/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "scene.gltf");
  return fuzz::answers([&] {
    fuzz::use(scene_files(path));
    SceneOptions options;
    options.time_s = 0.3;
    const Scene scene = load_scene(path, options);
    for (const Vec3& p : scene.position) PHOS_CHECK(is_finite(p), p.x, " ", p.y, " ", p.z);
    for (const Vec3& n : scene.normal) PHOS_CHECK(is_finite(n), n.x, " ", n.y, " ", n.z);
    for (const Triangle& t : scene.triangle)
      for (const std::uint32_t v : t.v) PHOS_CHECK(v < scene.position.size(), v);
  });
}
