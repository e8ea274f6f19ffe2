// Light from all around, from OpenEXR or Radiance .hdr: any map that is read can be sampled.
#include "reading.h"
#include "scene/sky/environment.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string path = fuzz::spilled(fuzz::characters(data, size));
  return fuzz::answers([&] {
    const Environment map = read_environment(path, 1, 0.5).map;
    for (const Vec2& u : {Vec2(0), Vec2(0.3f, 0.8f), Vec2(1)}) {
      for (const Environment::Sample& s : {map.sample(u), map.sample_flux(u)}) {
        PHOS_CHECK(is_finite(s.direction) && is_finite(s.luminance), "u ", u.x, " ", u.y);
        PHOS_CHECK(s.density >= 0, s.density);
      }
    }
    fuzz::use(map.irradiance_up_lx());
  });
}
