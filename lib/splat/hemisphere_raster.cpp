#include "splat/hemisphere_raster.h"

#include <algorithm>
#include <thread>

#include "cache/direct_light.h"
#include "cache/record_of.h"
#include "core/error.h"
#include "core/random.h"
#include "splat/gl_raster.h"
#include "splat/raster_plane.h"

namespace phos {
namespace {

/// A surface of this cosine or more with the site's normal, as near as its rounding, is the site's own.
constexpr float kOwnSurface = 0.5f;
/// Of the radius: how far below its place a parallel surface must lie for lookups to tell the two apart
/// (record_in_front allows half of it).
constexpr float kNextSurface = 0.02f;
/// Depth of the near plane, in roundings of positions: a wall at that distance is still seen where it meets
/// the edge of the plane.
constexpr float kNear = 0.1f;

}  // namespace

struct RasterEstimator::Impl {
  const RayScene& rays;
  const Luminaires& lights;
  RecordOptions options;
  std::uint64_t seed;
  HitLight light;
  RasterPlane plane;
  std::thread::id owner = std::this_thread::get_id();
  GlContext context;  // outlives everything below
  GlMesh mesh;
  GlRasterTarget target;

  Impl(const RayScene& r, const Luminaires& l, const GatherSource& source, const RecordOptions& resolved,
       std::uint64_t s)
      : rays(r),
        lights(l),
        options(resolved),
        seed(s),
        light(r, l, source, resolved, s),
        plane(raster_plane(static_cast<int>(resolved.raster_side), resolved.raster_border)),
        mesh(context.gl(), r.scene()),
        target(make_raster_target(context, plane.side, plane.side)) {}
  ~Impl() { context.make_current(); }

  GlView view(const Vec3& eye, const Frame& frame, float near_m) const;
  void clear_own_surface(const RecordSite& site, float lift_m, Hemisphere& h) const;
  float above_next_surface_m(const RecordSite& site, float lift_m, float radius_m) const;
};

namespace {

struct RasterWorker : Estimator::Worker {
  std::unique_ptr<HitLight::Worker> light;
  std::vector<std::uint32_t> triangle;
  std::vector<Hit> hits;
  Hemisphere hemisphere;
  std::vector<LampSample> lamps;
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

/// A site with a normal of its own (a smooth one) looks into its own surface: nothing comes from there.
void RasterEstimator::Impl::clear_own_surface(const RecordSite& site, float lift_m, Hemisphere& h) const {
  for (std::size_t i = 0; i < h.size(); ++i) {
    const float height_m = -glm::dot(h.direction[i], h.hit_normal[i]) * h.distance_m[i];
    if (height_m > 2 * lift_m || glm::dot(h.hit_normal[i], site.normal) < kOwnSurface) continue;
    h.radiance[i] = Rgb(0), h.distance_m[i] = kInfinity, h.hit_normal[i] = -h.direction[i];
  }
}

/// A lookup on a parallel surface not far below must be able to tell that this record lies in front of it.
float RasterEstimator::Impl::above_next_surface_m(const RecordSite& site, float lift_m,
                                                  float radius_m) const {
  Hit hit;
  const Ray ray{site.position, -site.normal, 2 * lift_m, kNextSurface * radius_m};
  return ray.t_max_m > ray.t_min_m && rays.intersect(ray, hit) ? hit.distance_m / kNextSurface : radius_m;
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
    if (w.triangle[i] != kNoTriangle) w.hits[i] = hit_triangle(scene, {eye, h.direction[i]}, w.triangle[i]);
  }
  impl_->light.shade(eye, w.hits, site.item, 0, h, *w.light);
  impl_->clear_own_surface(site, from.error_m, h);
}

Made RasterEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& w = static_cast<RasterWorker&>(worker);
  const RecordOptions& options = impl_->options;
  sample(site, w.hemisphere, w);
  PlaceLight light = light_of(std::span(&w.hemisphere, 1), options);
  const SurfacePoint place = receiver(impl_->rays.scene(), site.position, site.normal);
  if (options.paths == Quantity::all) {
    RandomStream random(impl_->seed, Stage::direct_light, site.item);
    const int samples = static_cast<int>(options.light_samples);
    sample_lamps(impl_->rays, impl_->lights, place, samples, random, w.lamps);
    add_lamps(w.lamps, samples, impl_->lights, site.normal, options, light);
  }
  Made made = record_of(site, light, options);
  float& radius_m = made.record.radius_m;
  radius_m = std::min(radius_m, impl_->above_next_surface_m(site, place.error_m, radius_m));
  w.counters.merge(w.light->counters);
  w.light->counters = Counters();
  return made;
}

}  // namespace phos
