// Radiance records.
#include "radiance/cache.h"
#include "radiance/tree.h"
#include "reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "input.radiance");
  return fuzz::answers([&] {
    const RadianceCache cache = read_radiance(Container::open(path));
    fuzz::use(irradiance_of(cache));
    if (cache.records.empty()) return;
    Bounds bounds;
    for (const RadianceRecord& r : cache.records) bounds.include(r.position);
    const int order = cache.records.front().order();
    RadianceTree tree(bounds, reading_accuracy(cache), order);
    for (const RadianceRecord& r : cache.records)
      if (r.order() == order) tree.insert(r);
    PHOS_CHECK(tree.size() > 0, "of ", cache.records.size());
  });
}
