// The references that judge a scene's small runs, whatever the way of its plan.
#pragma once

#include <vector>

#include "image/image.h"
#include "plan/pilot/models.h"
#include "plan/reference_doubts.h"

namespace phos::inline plan {

/// The pair of one quantity.
struct JudgingPair {
  bool chosen = false;  ///< made as good as they will be
  double mean = 0;      ///< of both; cd/m2 or lx
  ReferenceCost cost;
  ReferenceDoubts doubts;
};

/// Made by the first pilot, and read by the pilots of the same scene, size and sensors after it.
struct PilotReferences {
  JudgingPair image, lux;
  Image picture[2];
  std::vector<double> illuminance_lx[2];  ///< of each sensor

  JudgingPair& of(bool of_lux) { return of_lux ? lux : image; }
};

}  // namespace phos::inline plan
