// The numerical events that making records counts.
#pragma once

#include "core/events.h"

namespace phos::inline estimate {

// By rays.
inline const Event kPathsCutEvent{"gathered paths cut", "rays"};
inline const Event kSpecularPathsCutEvent{"specular paths cut", "samples"};
/// Few rays that meet gloss under a coat, which is signed, can add up to less than nothing: that is dark.
inline const Event kBelowZeroEvent{"gathered irradiance below zero", "records"};
inline const Event kWithoutRecordEvent{"gathered places without a record", "rays"};
inline const Event kBeyondReachEvent{"gathered places beyond the reach of records", "rays"};
inline const Event kWithoutRadianceEvent{"gathered glossy places without a radiance record", "rays"};
inline const Event kAboveErrorEvent{"records above the asked error", "records"};
/// docs/methods.md#e6: a footprint's axis that is as short as --min-radius allows, and along which light is
/// still no parabola.
inline const Event kUnresolvedEvent{"axes of footprints left unresolved", "axes"};
// By photons.
inline const Event kOcclusionEvent{"records at an occlusion gradient", "records"};
inline const Event kShadowEdgeEvent{"records at a shadow edge", "records"};
inline const Event kBesideWallEvent{"records beside a wall", "records"};
inline const Event kFromKernelEvent{"records from a kernel", "records"};
inline const Event kFromHullEvent{"records from the hull", "records"};
inline const Event kFullyLitEvent{"records fully lit", "records"};
inline const Event kInDarkEvent{"records in the dark", "records"};
inline const Event kProbedEvent{"records probed", "records"};
inline const Event kDegenerateHullEvent{"records with degenerate hull", "records"};
inline const Event kShrunkZoneEvent{"records with shrunk zone", "records"};
inline const Event kTooFewPhotonsEvent{"records with too few photons", "records"};
inline const Event kWithoutPhotonsEvent{"records without photons", "records"};

}  // namespace phos::inline estimate
