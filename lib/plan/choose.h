// Settings that buy the least error for the time: the front of them all.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "plan/model.h"

namespace phos::inline plan {

/// Knobs that are chosen together, each from a list of levels. `derive` fills in knobs that follow from them;
/// settings that it does not allow are not tried.
struct KnobGroup {
  std::vector<Knob> knobs;
  std::vector<std::vector<double>> levels;      ///< of each
  std::function<void(Knobs&)> derive{};         ///< null: none do
  std::function<bool(const Knobs&)> allowed{};  ///< null: all
  std::vector<Knob> derived{};                  ///< the knobs that `derive` writes
};

struct PlanPoint {
  Knobs knobs{};
  double cost = 0;            ///< s
  std::vector<double> error;  ///< of each quantity, mean square
};

/// Every choice of levels that no other beats in cost and every error at once, cheapest first. No monomial of
/// a model may have knobs of two groups: then the front of the sum is found group by group, exactly. Knobs of
/// no group keep the value they have in `fixed`. Beyond kMostPoints, points of more than one quantity are
/// thinned evenly in cost.
std::vector<PlanPoint> plan_front(const std::vector<KnobGroup>& groups, const Knobs& fixed,
                                  const PlanModel& cost, const std::vector<const PlanModel*>& errors);
inline constexpr std::size_t kMostPoints = 4000;

}  // namespace phos::inline plan
