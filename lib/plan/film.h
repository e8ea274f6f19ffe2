// Plans of films: the pilot measures one frame, and the film's pipeline has records that live through frames.
#pragma once

#include "plan/model.h"
#include "plan/task.h"

namespace phos::inline plan {

/// The picture of a film's first frame; the task itself where there is no film.
PlanTask still_of(const PlanTask& task);

/// Turns the seconds of a still into the seconds of its film: pictures of all frames, and light that is
/// computed at kFilmLight of the frames (plan/calibration.h), once at least. Without a film nothing changes.
void stretch_to_film(PlanModel& time, const PlanTask& task);

}  // namespace phos::inline plan
