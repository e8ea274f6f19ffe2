#include "plan/choose.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline plan {
namespace {

bool in(const KnobGroup& group, Knob knob) {
  return std::find(group.knobs.begin(), group.knobs.end(), knob) != group.knobs.end() ||
         std::find(group.derived.begin(), group.derived.end(), knob) != group.derived.end();
}

/// The group whose knobs a term has; null: none's, it is the same everywhere.
const KnobGroup* group_of(const Monomial& term, const std::vector<KnobGroup>& groups) {
  const KnobGroup* found = nullptr;
  for (const KnobGroup& group : groups) {
    const bool has = std::any_of(term.powers.begin(), term.powers.end(),
                                 [&](const auto& p) { return p.second != 0 && in(group, p.first); });
    if (!has) continue;
    PHOS_CHECK(!found, term.what, " has knobs of two groups");
    found = &group;
  }
  return found;
}

/// What the terms of one group (null: of none) add up to.
double share(const PlanModel& model, const Knobs& knobs, const KnobGroup* group,
             const std::vector<KnobGroup>& groups) {
  double sum = 0;
  for (const auto& [name, p] : model.part) {
    const std::vector<double> values = p.parts(knobs);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (group_of(p.terms()[i], groups) == group) sum += values[i];
  }
  return sum;
}

bool beats(const PlanPoint& a, const PlanPoint& b) {
  if (a.cost > b.cost) return false;
  for (std::size_t i = 0; i < a.error.size(); ++i)
    if (a.error[i] > b.error[i]) return false;
  return true;
}

/// Cheapest first; of equals the first stays.
std::vector<PlanPoint> best_of(std::vector<PlanPoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const PlanPoint& a, const PlanPoint& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.error < b.error;
  });
  std::vector<PlanPoint> front;
  for (const PlanPoint& p : points) {
    // With one quantity the last of the front is its best.
    const auto first = p.error.size() == 1 && !front.empty() ? front.end() - 1 : front.begin();
    if (std::none_of(first, front.end(), [&](const PlanPoint& q) { return beats(q, p); })) front.push_back(p);
  }
  if (points.empty() || points[0].error.size() < 2 || front.size() <= kMostPoints) return front;
  std::vector<PlanPoint> thinned;
  for (std::size_t i = 0; i < kMostPoints; ++i)
    thinned.push_back(front[i * (front.size() - 1) / (kMostPoints - 1)]);
  return thinned;
}

/// Every choice of a group's levels, with its own share of cost and errors.
std::vector<PlanPoint> points_of(const KnobGroup& group, const std::vector<KnobGroup>& groups,
                                 const Knobs& fixed, const PlanModel& cost,
                                 const std::vector<const PlanModel*>& errors) {
  std::vector<PlanPoint> points;
  std::vector<std::size_t> index(group.knobs.size(), 0);
  for (bool more = true; more;) {
    PlanPoint point;
    point.knobs = fixed;
    for (std::size_t k = 0; k < index.size(); ++k)
      point.knobs[at(group.knobs[k])] = group.levels[k][index[k]];
    if (group.derive) group.derive(point.knobs);
    if (!group.allowed || group.allowed(point.knobs)) {
      point.cost = share(cost, point.knobs, &group, groups);
      for (const PlanModel* model : errors) point.error.push_back(share(*model, point.knobs, &group, groups));
      points.push_back(point);
    }
    more = false;
    for (std::size_t k = 0; k < index.size() && !more; ++k) {
      more = ++index[k] < group.levels[k].size();
      if (!more) index[k] = 0;
    }
  }
  return best_of(std::move(points));
}

}  // namespace

std::vector<PlanPoint> plan_front(const std::vector<KnobGroup>& groups, const Knobs& fixed,
                                  const PlanModel& cost, const std::vector<const PlanModel*>& errors) {
  PlanPoint start;
  start.knobs = fixed;
  start.cost = share(cost, fixed, nullptr, groups);
  for (const PlanModel* model : errors) start.error.push_back(share(*model, fixed, nullptr, groups));
  std::vector<PlanPoint> front{start};
  for (const KnobGroup& group : groups) {
    std::vector<PlanPoint> joined;
    for (const PlanPoint& one : points_of(group, groups, fixed, cost, errors)) {
      for (const PlanPoint& before : front) {
        PlanPoint both = before;
        for (const auto& list : {group.knobs, group.derived})
          for (const Knob knob : list) both.knobs[at(knob)] = one.knobs[at(knob)];
        both.cost += one.cost;
        for (std::size_t i = 0; i < both.error.size(); ++i) both.error[i] += one.error[i];
        joined.push_back(both);
      }
    }
    front = best_of(std::move(joined));
  }
  return front;
}

}  // namespace phos::inline plan
