#include "splat/gl/hemisphere_raster.h"

#include <algorithm>
#include <thread>

#include "core/error.h"
#include "core/random.h"
#include "estimate/hemisphere/hemisphere_record.h"
#include "estimate/registry.h"
#include "splat/gl/raster.h"
#include "splat/gl/raster_plane.h"
#include "splat/sight_range.h"

namespace phos::inline splat {
namespace {

/// Depth of the near plane, in roundings of positions: a wall at that distance is still seen where it meets
/// the edge of the plane.
constexpr float kNear = 0.1f;

}  // namespace

struct RasterEstimator::Impl : HemisphereRecords {
  RasterPlane plane;
  std::thread::id owner = std::this_thread::get_id();
  GlContext context;  // outlives everything below
  GlMesh mesh;
  GlRasterTarget target;

  Impl(const RayScene& r, const Luminaires& l, const GatherSource& source, const RecordOptions& resolved,
       std::uint64_t s)
      : HemisphereRecords(r, l, source, resolved, s),
        plane(raster_plane(static_cast<int>(resolved.raster_side), resolved.raster_border)),
        mesh(context.gl(), r.scene()),
        target(make_raster_target(context, plane.side, plane.side)) {}
  ~Impl() { context.make_current(); }

  GlView view(const Vec3& eye, const Frame& frame, float near_m) const;
};

namespace {

struct RasterWorker : HemisphereWorker {
  std::vector<std::uint32_t> triangle;
  std::vector<Hit> hits;
  Hemisphere hemisphere;
};

}  // namespace

/// Column and row of a pixel grow along the frame's x and y.
GlView RasterEstimator::Impl::view(const Vec3& eye, const Frame& frame, float near_m) const {
  const double scale = 1 / farthest_m(rays.scene(), eye);
  GlView view;
  view.eye = eye;
  view.axes = Mat3(glm::transpose(glm::dmat3(DVec3(frame.x), DVec3(frame.y), -DVec3(frame.z))) * scale);
  view.lens = Vec4(Vec2(static_cast<float>(1 / kPlaneHalfSide)), 0, 0);
  view.depth = Vec2(static_cast<float>(static_cast<double>(near_m) * scale), 0);
  return view;
}

RasterEstimator::RasterEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                                 const RecordOptions& resolved, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(rays, lights, source, resolved, seed)) {
  impl_->context.check("loading the scene");
}
RasterEstimator::~RasterEstimator() = default;

std::unique_ptr<Estimator::Worker> RasterEstimator::make_worker() const {
  auto worker = std::make_unique<RasterWorker>();
  worker->light = impl_->light.make_worker();
  return worker;
}

void RasterEstimator::sample(const RecordSite& site, Hemisphere& h, Worker& worker) const {
  PHOS_CHECK(std::this_thread::get_id() == impl_->owner, "OpenGL is called from another thread");
  auto& w = static_cast<RasterWorker&>(worker);
  const Scene& scene = impl_->rays.scene();
  const RasterPlane& plane = impl_->plane;
  const SurfacePoint from = receiver(scene, site.position, site.normal);
  const Vec3 eye = from.leave(site.normal);

  h.frame = make_frame(site.normal);
  h.rings = h.slices = 0;
  h.resize(plane.direction.size());
  h.projected_sr = plane.projected_sr;
  impl_->context.make_current();
  draw_triangles(impl_->context.gl(), impl_->mesh, impl_->view(eye, h.frame, kNear * from.error_m),
                 impl_->target, w.triangle);
  w.hits.assign(h.size(), Hit());
  for (std::size_t i = 0; i < h.size(); ++i) {
    h.direction[i] = h.frame.to_world(plane.direction[i]);
    if (w.triangle[i] != kNothingDrawn) w.hits[i] = hit_triangle(scene, {eye, h.direction[i]}, w.triangle[i]);
  }
  impl_->light.shade(eye, w.hits, site.item, 0, h, *w.light);
  clear_own_surface(from.error_m, h);
}

Made RasterEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& w = static_cast<RasterWorker&>(worker);
  sample(site, w.hemisphere, w);
  const std::span<const Hemisphere> passes(&w.hemisphere, 1);
  return impl_->record(site, light_of(passes, impl_->options), passes, w);
}

void register_raster_estimator() {
  register_estimator({Estimate::raster, [](const EstimatorParts& p) -> std::unique_ptr<Estimator> {
                        return std::make_unique<RasterEstimator>(p.rays, p.lights, p.source(), p.options,
                                                                 p.seed);
                      }});
}

}  // namespace phos::inline splat
