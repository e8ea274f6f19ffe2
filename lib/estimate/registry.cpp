#include "estimate/registry.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "estimate/density.h"
#include "estimate/gather.h"
#include "estimate/radiance_density.h"
#include "estimate/radiance_gather.h"

namespace phos::inline estimate {
namespace {

std::unique_ptr<Estimator> density(const EstimatorParts& p) {
  return std::make_unique<DensityEstimator>(p.photons(), p.rays, p.options, p.seed);
}

std::unique_ptr<Estimator> gather(const EstimatorParts& p) {
  return std::make_unique<GatherEstimator>(p.rays, p.lights, p.source(), p.options, p.seed);
}

std::unique_ptr<Estimator> radiance_density(const EstimatorParts& p, int order, RadianceGradient gradient) {
  return std::make_unique<RadianceDensityEstimator>(p.photons(), p.rays, p.options, order, gradient, p.seed);
}

std::unique_ptr<Estimator> radiance_gather(const EstimatorParts& p, int order, RadianceGradient gradient) {
  return std::make_unique<RadianceEstimator>(p.rays, p.lights, p.source(), p.options, order, gradient,
                                             p.seed);
}

/// Rows are added by any thread.
struct Registry {
  std::mutex mutex;
  std::vector<EstimatorKind> kinds{{Estimate::hull, density, radiance_density},
                                   {Estimate::kernel, density, radiance_gather},
                                   {Estimate::gather, gather, radiance_gather}};
  auto find(Estimate estimate) {
    return std::find_if(kinds.begin(), kinds.end(),
                        [&](const EstimatorKind& k) { return k.estimate == estimate; });
  }
};

Registry& registry() {
  static Registry all;
  return all;
}

EstimatorKind kind_of(Estimate estimate) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  const auto found = all.find(estimate);
  PHOS_CHECK(found != all.kinds.end(), "estimator without a row");
  return *found;
}

}  // namespace

void register_estimator(const EstimatorKind& kind) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  if (all.find(kind.estimate) == all.kinds.end()) all.kinds.push_back(kind);
}

std::unique_ptr<Estimator> make_estimator(const EstimatorParts& parts) {
  return kind_of(parts.options.estimate).irradiance(parts);
}

std::unique_ptr<Estimator> make_radiance_estimator(const EstimatorParts& parts, int order,
                                                   RadianceGradient gradient) {
  const EstimatorKind kind = kind_of(parts.options.estimate);
  PHOS_CHECK(kind.radiance != nullptr, "estimator without radiance");
  return kind.radiance(parts, order, gradient);
}

}  // namespace phos::inline estimate
