// The numerical events that projecting lobes counts.
#pragma once

#include "core/events.h"

namespace phos::inline radiance {

inline const Event kNonFiniteValueEvent{"non-finite BRDF value", "values", kRare,
                                        "check the exponents, roughness and tables of the glossy materials"};
inline const Event kIntricateLobeEvent{"BRDF lobe not resolved by quadrature", "directions"};
inline const Event kGainsEnergyEvent{"BRDF with an albedo above 1", "directions"};

}  // namespace phos::inline radiance
