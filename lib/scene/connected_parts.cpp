#include "scene/connected_parts.h"

#include <bit>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace phos::inline scene {
namespace {

struct PlaceHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t h = 0;
    for (int c = 0; c < 3; ++c) {
      h = (h ^ std::bit_cast<std::uint32_t>(p[c])) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return h;
  }
};

}  // namespace

ConnectedParts find_connected_parts(const std::vector<Vec3>& corner) {
  const std::size_t triangles = corner.size() / 3;
  ConnectedParts found;
  std::unordered_map<Vec3, std::size_t, PlaceHash> places;
  found.place.resize(3 * triangles);
  for (std::size_t i = 0; i < found.place.size(); ++i)
    found.place[i] = places.try_emplace(corner[i] + 0.0f, places.size()).first->second;  // -0 is 0
  std::vector<std::size_t> parent(places.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 1; k < 3; ++k) parent[root(found.place[3 * t])] = root(found.place[3 * t + k]);
  constexpr std::size_t kNew = ~std::size_t{0};
  std::vector<std::size_t> number(places.size(), kNew);
  for (std::size_t t = 0; t < triangles; ++t) {
    std::size_t& own = number[root(found.place[3 * t])];
    if (own == kNew) own = found.parts++;
    found.part.push_back(own);
  }
  return found;
}

}  // namespace phos::inline scene
