// Irradiance records, with their index where they have one, and parts of a run.
#include "place/parts.h"
#include "reading.h"
#include "record/index.h"

namespace {

using namespace phos;

void read_cache(const Container& file) {
  const RecordLookup lookup(file);
  for (const Vec3& p : {Vec3(0), Vec3(0.5f), Vec3(-1e20f, 1, 1e9f)})
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(1, 0, 0)}) {
      fuzz::use(lookup.interpolate(p, n));
      fuzz::use(lookup.covered(p, n));
    }
  const IrradianceCache cache = lookup.records().cache();
  for (std::size_t i = 0; i < std::min<std::size_t>(cache.records.size(), 3); ++i) {
    const IrradianceRecord& r = cache.records[i];
    const Interpolated there = lookup.interpolate(r.position, r.normal);
    PHOS_CHECK(!std::isnan(there.weight), "record ", i);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "input.irradiance");
  return fuzz::answers([&] {
    const Container file = Container::open(path);
    if (file.form() == FileForm::part) {
      fuzz::use(read_parts({path}));
    } else {
      read_cache(file);
    }
  });
}
