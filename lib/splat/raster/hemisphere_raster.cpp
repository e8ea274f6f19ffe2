#include "splat/raster/hemisphere_raster.h"

#include "estimate/hemisphere/hemisphere_record.h"
#include "estimate/registry.h"
#include "file/tool.h"
#include "splat/raster/hemisphere_camera.h"
#include "splat/raster/radiance_raster.h"

namespace phos::inline splat {

struct RasterEstimator::Impl : HemisphereRecords {
  HemisphereCamera camera;

  Impl(const RayScene& r, const Luminaires& l, const GatherSource& source, const RecordOptions& resolved,
       std::uint64_t s)
      : HemisphereRecords(r, l, source, resolved, s), camera(r, resolved) {
    light.lamps_from(camera.lamps());
  }
};

namespace {

struct RasterWorker : HemisphereWorker {
  HemisphereCamera::Pixels pixels;
  Hemisphere hemisphere;
};

}  // namespace

RasterEstimator::RasterEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                                 const RecordOptions& resolved, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(rays, lights, source, resolved, seed)) {}
RasterEstimator::~RasterEstimator() = default;

std::unique_ptr<Estimator::Worker> RasterEstimator::make_worker() const {
  auto worker = std::make_unique<RasterWorker>();
  worker->light = impl_->light.make_worker();
  return worker;
}

void RasterEstimator::sample(const RecordSite& site, Hemisphere& h, Worker& worker) const {
  auto& w = static_cast<RasterWorker&>(worker);
  impl_->camera.sample(site, impl_->light, h, w.pixels, *w.light);
}

Made RasterEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& w = static_cast<RasterWorker&>(worker);
  sample(site, w.hemisphere, w);
  const std::span<const Hemisphere> passes(&w.hemisphere, 1);
  return impl_->record(site, light_of(passes, impl_->options), passes, w);
}

void tell_raster_light(const Tool& tool, const RayScene& rays, const RecordOptions& records) {
  const bool maps = records.estimate == Estimate::raster && records.raster_light == RasterLight::shadow_map;
  if (maps && rays.has_panes())
    tool.say("light comes through panes, which shadow maps do not show: shadow rays stand in for them");
}

void register_raster_estimator() {
  register_estimator(
      {Estimate::raster,
       [](const EstimatorParts& p) -> std::unique_ptr<Estimator> {
         return std::make_unique<RasterEstimator>(p.rays, p.lights, p.source(), p.options, p.seed);
       },
       [](const EstimatorParts& p, int order, RadianceGradient gradient) -> std::unique_ptr<Estimator> {
         return std::make_unique<RadianceRasterEstimator>(p.rays, p.lights, p.source(), p.options, order,
                                                          gradient, p.seed);
       }});
}

}  // namespace phos::inline splat
