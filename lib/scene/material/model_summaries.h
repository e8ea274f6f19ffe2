// Materials of each model in figures, for descriptions.
#pragma once

#include "scene/material/models.h"

namespace phos::inline scene {

ReflectionSummary summarise_core(const SummaryInput&);
ReflectionSummary summarise_lambert(const SummaryInput&);
ReflectionSummary summarise_kd_and_ks(const SummaryInput&);
ReflectionSummary summarise_plastic(const SummaryInput&);
ReflectionSummary summarise_conductor(const SummaryInput&);
ReflectionSummary summarise_mirror(const SummaryInput&);
ReflectionSummary summarise_glass(const SummaryInput&);
ReflectionSummary summarise_measured(const SummaryInput&);

}  // namespace phos::inline scene
