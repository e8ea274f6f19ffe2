// What references say that they cannot tell.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "plan/calibration.h"
#include "scene/report/light_ways.h"

namespace phos::inline plan {

/// Of the --stats of phos-reference: ways of light that it did not sample ("unsampled"), and places whose
/// light rests on too few bright paths ("untrusted").
class ReferenceDoubts {
 public:
  /// Of one more run, over so many places.
  void add(const Json& stats, double places);
  /// Have too many places too few bright paths? More samples may mend that.
  bool too_few_bright() const { return untrusted_share_ > calibration::kFewUntrusted; }
  /// Sentences for people, one for each doubt; none: the references can be trusted.
  std::vector<std::string> lines() const;

 private:
  std::vector<LightWay> unsampled_;
  double untrusted_share_ = 0;
};

}  // namespace phos::inline plan
