#include "splat/gbuffer.h"

#include "core/error.h"
#include "core/parallel.h"
#include "scene/bsdf.h"
#include "splat/gbuffer_pixel.h"

namespace phos {

Ray pixel_ray(const Camera& camera, int width, int height, int x, int y, const Vec2& subpixel) {
  const Vec2 st((static_cast<float>(x) + subpixel.x) / static_cast<float>(width),
                (static_cast<float>(y) + subpixel.y) / static_cast<float>(height));
  const Camera::Ray ray = camera.ray(st, static_cast<float>(width) / static_cast<float>(height));
  return {ray.origin, ray.direction};
}

GBuffer empty_gbuffer(int width, int height) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  GBuffer g;
  g.width = width, g.height = height;
  g.hit.resize(pixels);
  g.position.assign(pixels, Vec4(0)), g.normal.assign(pixels, Vec4(0)), g.albedo.assign(pixels, Vec4(0));
  return g;
}

void set_pixel(GBuffer& g, std::size_t i, const Scene& scene, const Hit& hit, const SurfacePoint& point) {
  g.hit[i] = hit;
  g.position[i] = Vec4(point.position, 1);
  g.normal[i] = Vec4(point.smooth_normal, hit.distance_m);
  g.albedo[i] = Vec4(Bsdf(scene, point).diffuse_reflectance(), static_cast<float>(point.material));
}

GBuffer trace_gbuffer(const RayScene& rays, const Camera& camera, int width, int height,
                      const Vec2& subpixel) {
  GBuffer g = empty_gbuffer(width, height);
  parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t y) {
    for (int x = 0; x < width; ++x) {
      const Ray ray = pixel_ray(camera, width, height, x, static_cast<int>(y), subpixel);
      Hit hit;
      if (!rays.intersect(ray, hit)) continue;
      const std::size_t i = y * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      set_pixel(g, i, rays.scene(), hit, rays.surface(ray, hit));
    }
  });
  return g;
}

}  // namespace phos
