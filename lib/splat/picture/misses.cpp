#include "splat/picture/misses.h"

#include <algorithm>
#include <utility>

#include "core/json.h"
#include "core/origin.h"
#include "core/random.h"
#include "file/atomic_file.h"

namespace phos::inline splat {

void spread_misses(std::vector<Miss>& misses, std::uint64_t seed, std::size_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order(misses.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = {RandomStream(seed, Stage::camera, i).bits(), static_cast<std::uint32_t>(i)};
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), most));
  std::vector<Miss> kept;
  kept.reserve(order.size());
  for (const auto& [key, i] : order) kept.push_back(misses[i]);
  misses = std::move(kept);
}

void write_misses(const std::string& path, const std::vector<Miss>& misses, const DVec3& origin_m) {
  std::string csv = "x,y,z,nx,ny,nz\n";
  for (const Miss& m : misses) {
    for (int c = 0; c < 3; ++c) csv += world_text(origin_m[c], m.position[c]) + ",";
    for (int c = 0; c < 3; ++c) csv += shortest(m.normal[c]) + (c < 2 ? "," : "\n");
  }
  AtomicFile file(path);
  file.write(csv);
  file.commit();
}

}  // namespace phos::inline splat
