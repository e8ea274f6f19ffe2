#include "splat/gbuffer.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/material/bsdf.h"
#include "splat/gbuffer_pixel.h"

namespace phos::inline splat {

Ray pixel_ray(const Camera& camera, int width, int height, int x, int y, const Vec2& subpixel) {
  return PixelRays(camera, width, height)(x, y, subpixel);
}

GBuffer empty_gbuffer(int width, int height) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  GBuffer g;
  g.width = width, g.height = height;
  // Clearing so much memory takes a while: at once.
  std::vector<Vec4>* const cleared[] = {&g.position, &g.normal, &g.albedo};
  parallel_for(4, 1, [&](std::size_t k) {
    if (k == 0)
      g.hit.resize(pixels);
    else
      cleared[k - 1]->assign(pixels, Vec4(0));
  });
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
  const PixelRays pixel_ray_of(camera, width, height);
  // Blocks of 4 x 4: rays of a packet run side by side.
  constexpr int kBlock = 4;
  const auto blocks = static_cast<std::size_t>((height + kBlock - 1) / kBlock);
  parallel_for(blocks, 1, [&](std::size_t block) {
    const int y0 = static_cast<int>(block) * kBlock, y1 = std::min(y0 + kBlock, height);
    std::vector<Ray> ray;
    std::vector<Hit> hit;
    std::vector<std::size_t> pixel;
    for (int x0 = 0; x0 < width; x0 += kBlock) {
      ray.clear(), pixel.clear();
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, width); ++x) {
          ray.push_back(pixel_ray_of(x, y, subpixel));
          pixel.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x));
        }
      }
      hit.assign(ray.size(), Hit());
      rays.intersect(ray, hit);
      for (std::size_t i = 0; i < ray.size(); ++i) {
        if (std::isfinite(hit[i].distance_m))
          set_pixel(g, pixel[i], rays.scene(), hit[i], rays.surface(ray[i], hit[i]));
      }
    }
  });
  return g;
}

}  // namespace phos::inline splat
