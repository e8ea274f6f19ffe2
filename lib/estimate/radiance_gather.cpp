#include "estimate/radiance_gather.h"

#include "core/error.h"
#include "estimate/gather.h"
#include "estimate/hemisphere/hemisphere_radiance.h"
#include "estimate/hemisphere/seen_pass.h"

namespace phos::inline estimate {
namespace {

struct RadianceWorker : Estimator::Worker {
  explicit RadianceWorker(int order) : projector(order) {}
  std::unique_ptr<Estimator::Worker> gather;
  RadianceProjector projector;
  Hemisphere hemisphere;
};

}  // namespace

struct RadianceEstimator::Impl {
  GatherEstimator gather;
  HemisphereRadiance radiance;
  int order;
};

RadianceEstimator::RadianceEstimator(const RayScene& rays, const Luminaires& lights,
                                     const GatherSource& source, const RecordOptions& resolved, int order,
                                     RadianceGradient gradient, std::uint64_t seed)
    : impl_(new Impl{{rays, lights, source, resolved, seed ^ kRadianceStreams},
                     {rays, resolved, gradient, source},
                     order}) {
  require_radiance_order(order);
}
RadianceEstimator::~RadianceEstimator() = default;

std::unique_ptr<Estimator::Worker> RadianceEstimator::make_worker() const {
  auto worker = std::make_unique<RadianceWorker>(impl_->order);
  worker->gather = impl_->gather.make_worker();
  return worker;
}

Made RadianceEstimator::make(const RecordSite& site, Estimator::Worker& worker) const {
  auto& w = static_cast<RadianceWorker&>(worker);
  impl_->gather.sample(site, impl_->radiance.options.rays, 0, w.hemisphere, *w.gather, Measure::solid);
  w.counters.merge(w.gather->counters);
  w.gather->counters = Counters();
  return record_from(site, {&w.hemisphere, 1}, worker);
}

std::vector<SeenPass> RadianceEstimator::last_seen(const Estimator::Worker& worker) const {
  const auto& w = static_cast<const RadianceWorker&>(worker);
  return {GatherEstimator::seen(*w.gather, 0, w.hemisphere)};
}

Made RadianceEstimator::record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                                    Estimator::Worker& worker) const {
  auto& w = static_cast<RadianceWorker&>(worker);
  PHOS_CHECK(passes.size() == 1, passes.size(), " passes");
  return impl_->radiance.record(site, passes.front(), {}, w.projector, w.counters);
}

const Hemisphere& RadianceEstimator::seen(const Estimator::Worker& worker) {
  return static_cast<const RadianceWorker&>(worker).hemisphere;
}

}  // namespace phos::inline estimate
