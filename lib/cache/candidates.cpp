#include "cache/candidates.h"

#include <algorithm>

#include "cache/record_maker.h"
#include "core/random.h"

namespace phos {

Candidates photon_candidates(const PhotonMap& photons, Quantity wanted, std::uint64_t seed,
                             std::int64_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  for (std::uint32_t row = 0; row < photons.size(); ++row) {
    if (is_wanted(photons, row, wanted))
      keyed.emplace_back(RandomStream(seed, Stage::placement, row).bits(), row);
  }
  std::sort(keyed.begin(), keyed.end());
  if (most > 0 && keyed.size() > static_cast<std::size_t>(most)) keyed.resize(static_cast<std::size_t>(most));
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, row] : keyed) order.push_back(row);
  const std::size_t count = order.size();
  return {count, [&photons, order = std::move(order)](std::size_t i, std::vector<RecordSite>& sites) {
            const std::uint32_t row = order[i];
            sites.push_back({photons.position[row], decode_octahedral(photons.normal[row]), row, row});
          }};
}

Candidates point_candidates(std::span<const SurfaceSample> points) {
  return {points.size(), [points](std::size_t i, std::vector<RecordSite>& sites) {
            sites.push_back({points[i].position, points[i].normal, kPointItems + i});
          }};
}

}  // namespace phos
