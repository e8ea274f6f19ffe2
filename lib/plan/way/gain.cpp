#include "plan/way/gain.h"

#include "core/text/quantity.h"

namespace phos::inline plan {

bool pays(const Prediction& other, const Prediction& usual, const PlanGoal& goal, double least) {
  return goal.error ? other.seconds.value < least * usual.seconds.value
                    : other.error() < least * usual.error();
}

std::string figures(const Prediction& p) {
  return text(percent(p.error()), " in ", duration(p.seconds.value));
}

}  // namespace phos::inline plan
