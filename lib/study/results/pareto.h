// The settings that nothing beats.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace phos::inline study {

/// What a setting costs (time, memory, bytes) and the error that it leaves; of both, less is better.
struct CostAndError {
  double cost = 0, error = 0;
};

/// Indices of the points that no other beats in one of the two without being worse in the other, by ascending
/// cost. Of equal points, all; points that are not finite, none. O(n log n).
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace phos::inline study
