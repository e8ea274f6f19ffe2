// A map of photons, with its kd-tree, or a shard of one: what a stage that gathers photons reads.
#include "photon/photon_map.h"
#include "photon/photon_shards.h"
#include "reading.h"

namespace {

using namespace phos;

void look_up(const PhotonMap& map) {
  std::vector<std::uint32_t> rows;
  std::vector<float> distance2_m2;
  const auto check = [&] {
    for (const std::uint32_t row : rows) PHOS_CHECK(row < map.size(), row, " of ", map.size());
  };
  for (const Vec3& p : {Vec3(0), Vec3(0.5f, 0.2f, 0.7f), Vec3(-1e10f, 1e18f, 0)}) {
    map.in_sphere(p, 0.3f, rows), check();
    map.in_sphere(p, 1e18f, rows), check();
    map.nearest(p, 5, rows, distance2_m2), check();
  }
  // The tree leaves nobody out.
  map.in_sphere(Vec3(0), kInfinity, rows);
  PHOS_CHECK(rows.size() == map.size(), rows.size(), " of ", map.size(), " photons are found");
  if (map.size() == 0) return;
  map.nearest(map.position.front(), 1, rows, distance2_m2);
  PHOS_CHECK(rows.size() == 1 && distance2_m2[0] == 0, "a photon does not find itself");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "input.photons");
  return fuzz::answers([&] {
    bool shard = false;
    try {
      shard = Container::open(path).provenance().extra.find("shard") != nullptr;
    } catch (const Error&) {
    }
    if (shard) {
      const MergedShards merged = read_shards({path});
      look_up(PhotonMap::build(merged.photons, merged.totals));
    } else {
      look_up(PhotonMap::open(path));
    }
  });
}
