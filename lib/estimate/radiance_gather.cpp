#include "estimate/radiance_gather.h"

#include <algorithm>

#include "core/error.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "estimate/hemisphere/seen_pass.h"
#include "estimate/next_surface.h"

namespace phos::inline estimate {
namespace {

/// Sets the random numbers of radiance records apart from the numbers of irradiance records at the same
/// places.
constexpr std::uint64_t kOwnStreams = 0x72616469616e6365;

struct RadianceWorker : Estimator::Worker {
  explicit RadianceWorker(int order) : projector(order) {}
  std::unique_ptr<Estimator::Worker> gather;
  RadianceProjector projector;
  Hemisphere hemisphere;
};

}  // namespace

struct RadianceEstimator::Impl {
  const RayScene& rays;
  GatherEstimator gather;
  RecordOptions options;
  int order;
  RadianceGradient gradient;
  GatherSource source;
};

RadianceEstimator::RadianceEstimator(const RayScene& rays, const Luminaires& lights,
                                     const GatherSource& source, const RecordOptions& resolved, int order,
                                     RadianceGradient gradient, std::uint64_t seed)
    : impl_(new Impl{
          rays, {rays, lights, source, resolved, seed ^ kOwnStreams}, resolved, order, gradient, source}) {
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
  impl_->gather.sample(site, impl_->options.rays, 0, w.hemisphere, *w.gather, Measure::solid);
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
  const RecordOptions& options = impl_->options;
  PHOS_CHECK(passes.size() == 1, passes.size(), " passes");
  const Hemisphere& h = passes.front();
  // The radius asks for gradients even where the record is to have none.
  const bool without = impl_->gradient == RadianceGradient::none;
  const RadianceGradient gradient = without ? RadianceGradient::hybrid : impl_->gradient;
  RadianceRecord record = w.projector.project(h, gradient, static_cast<float>(*options.min_radius_m));
  record.position = site.position;
  require_finite(impl_->rays.scene().origin_m, record);
  const float reach = reach_m(record, h, options);
  if (without) record.gradient_x.clear(), record.gradient_y.clear();
  const float rounding_m = receiver(impl_->rays.scene(), site.position, site.normal).error_m;
  const float next_m = height_over_next_m(impl_->rays, site.position, site.normal, 2 * rounding_m, reach);
  record.radius_m = std::min(reach, next_m / kNextSurface);
  Made made{irradiance_of(record), 0, site.least_radius_m, site.most_radius_m};
  made.least_share = impl_->source.least_share(site);
  made.radiance = std::make_shared<RadianceRecord>(std::move(record));
  return made;
}

const Hemisphere& RadianceEstimator::seen(const Estimator::Worker& worker) {
  return static_cast<const RadianceWorker&>(worker).hemisphere;
}

}  // namespace phos::inline estimate
