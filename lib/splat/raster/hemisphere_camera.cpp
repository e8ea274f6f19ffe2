#include "splat/raster/hemisphere_camera.h"

#include <optional>
#include <thread>

#include "core/error.h"
#include "direct/direct_light.h"
#include "estimate/hemisphere/hemisphere_record.h"
#include "splat/gl/raster.h"
#include "splat/raster/lamp_maps.h"
#include "splat/sight_range.h"

namespace phos::inline splat {
namespace {

/// Depth of the near plane, in roundings of positions: a wall at that distance is still seen where it meets
/// the edge of the plane.
constexpr float kNear = 0.1f;

}  // namespace

struct HemisphereCamera::Impl {
  const RayScene& rays;
  RasterPlane plane;
  std::thread::id owner = std::this_thread::get_id();
  GlContext context;  // outlives everything below
  GlMesh mesh;
  GlRasterTarget target;

  std::optional<LampMaps> lamps;

  Impl(const RayScene& r, const RecordOptions& resolved)
      : rays(r),
        plane(raster_plane(static_cast<int>(resolved.raster_side), resolved.raster_border)),
        mesh(context.gl(), r.scene()),
        target(make_raster_target(context, plane.side, plane.side)) {
    if (resolved.raster_light == RasterLight::shadow_map && !r.has_panes())
      lamps.emplace(context, mesh, r.scene());
  }
  ~Impl() { context.make_current(); }

  GlView view(const Vec3& eye, const Frame& frame, float near_m) const;
};

/// Column and row of a pixel grow along the frame's x and y.
GlView HemisphereCamera::Impl::view(const Vec3& eye, const Frame& frame, float near_m) const {
  const double scale = 1 / farthest_m(rays.scene(), eye);
  GlView view;
  view.eye = eye;
  view.axes = Mat3(glm::transpose(glm::dmat3(DVec3(frame.x), DVec3(frame.y), -DVec3(frame.z))) * scale);
  view.lens = Vec4(Vec2(static_cast<float>(1 / kPlaneHalfSide)), 0, 0);
  view.depth = Vec2(static_cast<float>(static_cast<double>(near_m) * scale), 0);
  return view;
}

HemisphereCamera::HemisphereCamera(const RayScene& rays, const RecordOptions& resolved)
    : impl_(std::make_unique<Impl>(rays, resolved)) {
  impl_->context.check("loading the scene");
}
HemisphereCamera::~HemisphereCamera() = default;

const LampLight* HemisphereCamera::lamps() const { return impl_->lamps ? &*impl_->lamps : nullptr; }

void HemisphereCamera::sample(const RecordSite& site, const HitLight& light, Hemisphere& h, Pixels& pixels,
                              HitLight::Worker& worker) const {
  PHOS_CHECK(std::this_thread::get_id() == impl_->owner, "OpenGL is called from another thread");
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
                 impl_->target, pixels.triangle);
  pixels.hits.assign(h.size(), Hit());
  for (std::size_t i = 0; i < h.size(); ++i) {
    h.direction[i] = h.frame.to_world(plane.direction[i]);
    if (pixels.triangle[i] != kNothingDrawn)
      pixels.hits[i] = hit_triangle(scene, {eye, h.direction[i]}, pixels.triangle[i]);
  }
  light.shade(eye, pixels.hits, site.item, 0, h, worker);
  clear_own_surface(from.error_m, h);
}

}  // namespace phos::inline splat
