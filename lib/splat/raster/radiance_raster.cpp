#include "splat/raster/radiance_raster.h"

#include "estimate/hemisphere/hemisphere_radiance.h"
#include "splat/raster/hemisphere_camera.h"
#include "splat/raster/plane_pieces.h"

namespace phos::inline splat {
namespace {

struct RadianceRasterWorker : Estimator::Worker {
  explicit RadianceRasterWorker(int order) : projector(order) {}
  std::unique_ptr<HitLight::Worker> light;
  HemisphereCamera::Pixels pixels;
  Hemisphere seen, whole;
  RadianceProjector projector;
};

}  // namespace

struct RadianceRasterEstimator::Impl {
  int order;
  HemisphereRadiance radiance;
  HitLight light;
  PlanePieces pieces;
  HemisphereCamera camera;
};

RadianceRasterEstimator::RadianceRasterEstimator(const RayScene& rays, const Luminaires& lights,
                                                 const GatherSource& source, const RecordOptions& resolved,
                                                 int order, RadianceGradient gradient, std::uint64_t seed) {
  impl_.reset(new Impl{require_radiance_order(order),
                       {rays, resolved, gradient, source},
                       {rays, lights, source, resolved, seed ^ kRadianceStreams},
                       plane_pieces(static_cast<int>(resolved.raster_side), resolved.raster_border, order),
                       {rays, resolved}});
  impl_->light.lamps_from(impl_->camera.lamps());
}
RadianceRasterEstimator::~RadianceRasterEstimator() = default;

std::unique_ptr<Estimator::Worker> RadianceRasterEstimator::make_worker() const {
  auto worker = std::make_unique<RadianceRasterWorker>(impl_->order);
  worker->light = impl_->light.make_worker();
  return worker;
}

Made RadianceRasterEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& w = static_cast<RadianceRasterWorker&>(worker);
  impl_->camera.sample(site, impl_->light, w.seen, w.pixels, *w.light);
  w.counters.merge(w.light->counters);
  w.light->counters = Counters();
  impl_->pieces.spread(w.seen, w.whole);
  return impl_->radiance.record(site, w.whole, impl_->pieces.borders, w.projector, w.counters);
}

}  // namespace phos::inline splat
