#include "plan/film.h"

#include <algorithm>

#include "plan/calibration.h"

namespace phos::inline plan {

PlanTask still_of(const PlanTask& task) {
  PlanTask still = task;
  if (!task.frames) return still;
  still.frames.reset();
  still.scene_words.insert(still.scene_words.end(), {"--frame", std::to_string(task.frames->first)});
  return still;
}

void stretch_to_film(PlanModel& time, const PlanTask& task) {
  if (!task.frames) return;
  const auto frames = static_cast<double>(task.frames->count());
  const double of_light = std::max(1.0, calibration::kFilmLight * frames);
  for (auto& [name, p] : time.part) {
    if (name == "lobes") continue;
    for (std::size_t guess = 0; guess <= Posynomial::kBest; ++guess)
      p.scale(guess, name == "picture" ? frames : of_light);
  }
}

}  // namespace phos::inline plan
