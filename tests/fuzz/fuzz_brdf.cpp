// Lobes of materials.
#include "radiance/brdf/file.h"
#include "radiance/brdf/table.h"
#include "reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "input.brdf");
  return fuzz::answers([&] {
    for (const BrdfTable& table : read_brdf(Container::open(path))) {
      fuzz::use(summarize(table));
      const BrdfLookup lookup(table);
      for (const Vec3& wo : {Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f), Vec3(-0.9f, 0.43588989f, 1e-4f)}) {
        fuzz::use(lookup.order(wo));
        if (table.order > 0) fuzz::use(lookup.coefficients(wo));
      }
    }
  });
}
