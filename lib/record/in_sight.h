// The records about a place that serve it where a leak test is asked for: a ray each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace phos::inline record {

/// So many records that pass the test serve a place; with this many, noise has averaged out, and a ray to
/// each of thousands, as where a cache has a record at every point of a dense grid, would cost more than the
/// light.
inline constexpr std::size_t kMostInSight = 64;

/// A record that is valid at a place, but for the leak test.
struct Candidate {
  float weight;
  std::uint32_t record;
};

/// serve(candidate), which says whether the record passes the test, for all candidates in their order, or, of
/// more than kMostInSight, for the heaviest first (of equal ones, for the first record), until kMostInSight
/// have passed. Reorders the candidates.
template <class Serve>
void serve_in_sight(std::vector<Candidate>& candidates, const Serve& serve) {
  const bool many = candidates.size() > kMostInSight;
  const auto heavier = [](const Candidate& a, const Candidate& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.record < b.record;
  };
  std::size_t passed = 0;
  for (auto begin = candidates.begin(); begin != candidates.end() && passed < kMostInSight;) {
    auto end = candidates.end();
    if (many) {
      end = begin + std::min(static_cast<std::ptrdiff_t>(kMostInSight), end - begin);
      std::partial_sort(begin, end, candidates.end(), heavier);
    }
    for (; begin != end && passed < kMostInSight; ++begin) passed += serve(*begin);
  }
}

}  // namespace phos::inline record
