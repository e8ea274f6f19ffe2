// The estimator that the options ask for, and everything that it refers to.
#pragma once

#include <memory>

#include "estimate/registry.h"
#include "place/radiance_placement.h"
#include "place/two_level.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "stage/record_inputs.h"

namespace phos::stage {

/// Throws Error(usage) if the estimate needs photons that are not there, Error(mismatch) for radiance records
/// that no lobe can read. Holds references to rays and inputs.
class ChosenEstimator {
 public:
  ChosenEstimator(const RayScene& rays, const RecordInputs& inputs, const RecordOptions& resolved,
                  std::uint64_t seed);
  ~ChosenEstimator();
  const Estimator& operator*() const { return *estimator_; }
  /// Of the coarse cache that rays read; 0 for estimates from photons.
  std::size_t coarse_records() const { return coarse_.records(); }

 private:
  Luminaires lights_;
  CoarseLevel coarse_;
  std::unique_ptr<Estimator> estimator_;
};

/// The same for radiance records, one estimator for each order.
class ChosenRadianceEstimators {
 public:
  ChosenRadianceEstimators(const RayScene& rays, const RecordInputs& inputs, const RadianceOptions& resolved,
                           std::uint64_t seed);
  /// Refers to this object.
  std::unique_ptr<Estimator> operator()(int order) const;
  std::size_t coarse_records() const { return coarse_.records(); }

 private:
  const RayScene& rays_;
  const RecordInputs& inputs_;
  RadianceOptions options_;
  std::uint64_t seed_;
  Luminaires lights_;
  CoarseLevel coarse_;
};

}  // namespace phos::stage
