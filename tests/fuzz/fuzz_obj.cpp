// Scenes in OBJ with their materials and lights: one input, cut where a line says which file begins.
#include "reading.h"
#include "scene/load.h"
#include "scene/obj/lights.h"

namespace {

/// What comes before the mark, which is cut off with it.
std::string_view take_until(std::string_view& bytes, std::string_view mark) {
  const std::size_t at = std::min(bytes.find(mark), bytes.size());
  const std::string_view part = bytes.substr(0, at);
  bytes.remove_prefix(std::min(at + mark.size(), bytes.size()));
  return part;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  std::string_view rest = fuzz::characters(data, size);
  const std::string path = fuzz::spilled(take_until(rest, "#=mtl\n"), "scene.obj");
  fuzz::spilled(take_until(rest, "#=lights\n"), "scene.mtl");
  if (rest.empty()) {
    std::filesystem::remove(obj_lights_path(path));
  } else {
    fuzz::spilled(rest, std::filesystem::path(obj_lights_path(path)).filename().string());
  }
  return fuzz::answers([&] {
    fuzz::use(scene_files(path));
    const Scene scene = load_scene(path);
    for (const Vec3& p : scene.position) PHOS_CHECK(is_finite(p), p.x, " ", p.y, " ", p.z);
    for (const Vec3& n : scene.normal) PHOS_CHECK(is_finite(n), n.x, " ", n.y, " ", n.z);
  });
}
