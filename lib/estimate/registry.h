// The table of estimators: one row a way of estimating records.
#pragma once

#include <functional>
#include <memory>

#include "estimate/estimator.h"
#include "estimate/gather_source.h"
#include "estimate/record_options.h"

namespace phos::inline scene {
class Luminaires;
class RayScene;
}  // namespace phos::inline scene
namespace phos::inline photon {
class PhotonMap;
}

namespace phos::inline estimate {

enum class RadianceGradient;

/// What estimators are made from. Photons and source are asked for only by the rows that need them.
struct EstimatorParts {
  const RayScene& rays;
  const Luminaires& lights;
  std::function<const PhotonMap&()> photons;
  std::function<GatherSource()> source;  ///< the light that rays read where they land
  const RecordOptions& options;          ///< resolved
  std::uint64_t seed = 0;
};

/// One row. Estimators hold references to the parts that they ask for.
struct EstimatorKind {
  Estimate estimate;
  /// Of irradiance records.
  std::unique_ptr<Estimator> (*irradiance)(const EstimatorParts&);
  /// Of radiance records of an order; null: there is none.
  std::unique_ptr<Estimator> (*radiance)(const EstimatorParts&, int order, RadianceGradient) = nullptr;
};

/// Adds a row of a module that comes after this one; a second time it changes nothing.
void register_estimator(const EstimatorKind& kind);

/// The estimator that parts.options.estimate names. Its row must be there.
std::unique_ptr<Estimator> make_estimator(const EstimatorParts& parts);
std::unique_ptr<Estimator> make_radiance_estimator(const EstimatorParts& parts, int order,
                                                   RadianceGradient gradient);

}  // namespace phos::inline estimate
