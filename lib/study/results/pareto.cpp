#include "study/results/pareto.h"

#include <algorithm>
#include <cmath>

namespace phos::inline study {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a].cost != points[b].cost) return points[a].cost < points[b].cost;
    return points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (!front.empty()) {
      const CostAndError& best = points[front.back()];
      const bool same = points[i].cost == best.cost && points[i].error == best.error;
      if (points[i].error >= best.error && !same) continue;
    }
    front.push_back(i);
  }
  return front;
}

}  // namespace phos::inline study
