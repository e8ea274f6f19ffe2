// Records of films, and the cache that they are at a frame.
#include "reading.h"
#include "temporal/film/file.h"

namespace {

using namespace phos;

Scene one_triangle() {
  Scene scene;
  scene.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.triangle.push_back({{0, 1, 2}});
  return scene;
}

void read_all(const Container& file) {
  const Scene scene = one_triangle();
  const FrameRange frames = read_film_info(file).frames;
  const bool radiance = file.kind() == FileKind::radiance;
  for (const std::int64_t frame : {frames.first, (frames.first + frames.last) / 2, frames.last}) {
    if (radiance) {
      fuzz::use(read_radiance_film_at(file, frame, scene));
    } else {
      fuzz::use(read_film_at(file, frame, scene));
    }
  }
  if (radiance) {
    fuzz::use(read_radiance_film(file));
  } else {
    fuzz::use(read_film(file));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "input.irradiance");
  return fuzz::answers([&] { read_all(Container::open(path)); });
}
