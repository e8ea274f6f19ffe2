// The visible surface by rasterising: OpenGL finds the triangle of each pixel; the place where the pixel's
// ray meets it, and the surface there, are worked out as for traced rays. Nothing but edges can then differ.
#include "splat/gl/raster.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/offset.h"
#include "scene/shading_frame.h"
#include "splat/gbuffer_pixel.h"
#include "splat/gl/renderer.h"
#include "splat/gl/renderer_impl.h"
#include "splat/projection.h"
#include "splat/sight_range.h"

namespace phos::inline splat {
namespace {

GlView camera_view(const Scene& scene, const Camera& camera, int width, int height, const Vec2& subpixel) {
  const Projection projection(camera, width, height);
  const Vec3 eye(projection.eye());
  const double far = farthest_m(scene, eye), scale = 1 / far;
  GlView view;
  view.eye = eye;
  view.axes = Mat3(projection.axes() * scale);
  view.perspective = projection.perspective();
  const double unit = view.perspective ? 1 : scale;
  // Row 0 is the top. A pixel's sample lies at its centre for OpenGL: shift the picture by the offset of the
  // subpixel.
  view.lens = Vec4(1 / (projection.half_width() * unit), -1 / (projection.half_height() * unit),
                   (1 - 2 * subpixel.x) / static_cast<float>(width),
                   (1 - 2 * subpixel.y) / static_cast<float>(height));
  if (view.perspective) {
    // Nothing that can be seen lies before the near plane: not at the corners of the picture either.
    const double w = projection.half_width(), h = projection.half_height();
    view.depth = Vec2(0.999 * nearest_m(scene, eye, -1) * scale / std::sqrt(1 + w * w + h * h), 0);
  } else {
    view.depth = Vec2(1, -1 / 1.001);  // from the camera's plane to the farthest corner
  }
  return view;
}

/// As RayScene::surface.
SurfacePoint surface_at(const Scene& scene, const Reads& reads, const Ray& ray, const Hit& hit) {
  const auto& corner = scene.triangle[hit.triangle].v;
  const Vec3 &a = scene.position[corner[0]], &b = scene.position[corner[1]], &c = scene.position[corner[2]];
  const Vec3 normal = normal_of(a, b, c);
  const float weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};
  const double u = static_cast<double>(hit.u), v = static_cast<double>(hit.v);
  SurfacePoint point;
  point.triangle = hit.triangle;
  point.instance = scene.triangle_instance[hit.triangle];
  point.material = scene.instance[point.instance].material;
  point.distance_m = hit.distance_m;
  point.error_m = offset_m(a, b, c);
  point.position = Vec3((1 - u - v) * DVec3(a) + u * DVec3(b) + v * DVec3(c));
  point.front = glm::dot(ray.direction, normal) <= 0;
  point.geometric_normal = point.front ? normal : -normal;
  shade(scene, reads, weight, -ray.direction, point);
  return point;
}

}  // namespace

GlRasterTarget make_raster_target(const GlContext& context, int width, int height) {
  require_size(context, width, height);
  const Gl& gl = context.gl();
  GlRasterTarget target;
  target.triangle = make_texture(gl, GL_R32UI, width, height);
  target.depth = make_texture(gl, GL_DEPTH_COMPONENT32F, width, height);
  target.framebuffer = make_framebuffer(gl, {target.triangle.id()}, target.depth.id());
  target.width = width, target.height = height;
  return target;
}

void draw_triangles(const Gl& gl, const GlMesh& mesh, const GlView& view, const GlRasterTarget& target,
                    std::vector<std::uint32_t>& triangle) {
  const float far = 0;
  gl.DepthMask(GL_TRUE);
  gl.ClearNamedFramebufferuiv(target.framebuffer.id(), GL_COLOR, 0, &kNothingDrawn);
  gl.ClearNamedFramebufferfv(target.framebuffer.id(), GL_DEPTH, 0, &far);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.id());
  gl.Viewport(0, 0, target.width, target.height);
  mesh.draw(view);
  triangle.resize(static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height));
  gl.GetTextureImage(target.triangle.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                     static_cast<GLsizei>(triangle.size() * sizeof(triangle[0])), triangle.data());
}

Hit hit_triangle(const Scene& scene, const Ray& ray, std::uint32_t triangle) {
  const auto& corner = scene.triangle[triangle].v;
  const DVec3 origin(ray.origin), direction(ray.direction), a(scene.position[corner[0]]);
  const DVec3 e1 = DVec3(scene.position[corner[1]]) - a, e2 = DVec3(scene.position[corner[2]]) - a;
  const DVec3 across = glm::cross(direction, e2), from = origin - a, side = glm::cross(from, e1);
  const double determinant = glm::dot(e1, across);
  double u = 1.0 / 3, v = 1.0 / 3;
  if (determinant != 0) {
    u = glm::dot(from, across) / determinant, v = glm::dot(direction, side) / determinant;
    if (!std::isfinite(u) || !std::isfinite(v)) u = v = 1.0 / 3;
    u = std::clamp(u, 0.0, 1.0), v = std::clamp(v, 0.0, 1.0);
    if (u + v > 1) u /= u + v, v = 1 - u;
  }
  Hit hit;
  hit.triangle = triangle;
  hit.u = static_cast<float>(u), hit.v = static_cast<float>(v);
  hit.distance_m = static_cast<float>(std::max(0.0, glm::dot(a + u * e1 + v * e2 - origin, direction)));
  return hit;
}

GBuffer GlRenderer::rasterise(const Camera& camera, int width, int height, const Vec2& subpixel) {
  impl_->context.make_current();
  std::vector<std::uint32_t> triangle;
  draw_triangles(impl_->context.gl(), impl_->mesh, camera_view(impl_->scene, camera, width, height, subpixel),
                 impl_->raster_target(width, height), triangle);
  impl_->context.check("rasterising");

  GBuffer g = empty_gbuffer(width, height);
  const Scene& scene = impl_->scene;
  std::vector<Reads> reads;
  for (const Material& material : scene.material) reads.push_back(reads_of(scene, material));
  const PixelRays pixel_rays(camera, width, height);
  parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = y * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (triangle[i] == kNothingDrawn) continue;
      const Ray ray = pixel_rays(x, static_cast<int>(y), subpixel);
      const Hit hit = hit_triangle(scene, ray, triangle[i]);
      const std::uint32_t material = scene.instance[scene.triangle_instance[triangle[i]]].material;
      set_pixel(g, i, scene, hit, surface_at(scene, reads[material], ray, hit));
    }
  });
  return g;
}

}  // namespace phos::inline splat
