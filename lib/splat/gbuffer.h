// The visible surface, per pixel.
#pragma once

#include <vector>

#include "core/vector.h"
#include "scene/camera.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline splat {

/// Row 0 at the top. One sample per pixel; several are made with other `subpixel` offsets and averaged after
/// shading.
struct GBuffer {
  int width = 0, height = 0;
  std::vector<Hit> hit;        ///< distance_m = infinity where nothing is visible
  std::vector<Vec4> position;  ///< xyz m, w = 1; all zero where nothing is visible
  std::vector<Vec4>
      normal;  ///< xyz = SurfacePoint::smooth_normal on the seen side, w = distance to the camera, m
  std::vector<Vec4> albedo;  ///< rgb = diffuse reflectance, w = material index
  bool covered(std::size_t i) const { return position[i].w > 0; }
};

/// Camera ray of a pixel; subpixel in [0,1)^2 ((0.5,0.5) = centre).
Ray pixel_ray(const Camera& camera, int width, int height, int x, int y, const Vec2& subpixel);

/// pixel_ray for many pixels of one picture.
class PixelRays {
 public:
  PixelRays(const Camera& camera, int width, int height)
      : rays_(camera, static_cast<float>(width) / static_cast<float>(height)),
        width_(static_cast<float>(width)),
        height_(static_cast<float>(height)) {}
  Ray operator()(int x, int y, const Vec2& subpixel) const {
    const Camera::Ray ray = rays_(
        Vec2((static_cast<float>(x) + subpixel.x) / width_, (static_cast<float>(y) + subpixel.y) / height_));
    return {ray.origin, ray.direction};
  }

 private:
  CameraRays rays_;
  float width_, height_;
};

/// By rays (Embree): the oracle.
GBuffer trace_gbuffer(const RayScene& rays, const Camera& camera, int width, int height,
                      const Vec2& subpixel);

}  // namespace phos::inline splat
