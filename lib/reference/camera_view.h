// The pixels of a camera: their rays, and which of them sees a point.
#pragma once

#include <cstddef>

#include "reference/bidirectional.h"
#include "scene/camera.h"

namespace phos::inline reference {

/// Which way a point is seen.
struct PixelSight {
  std::size_t pixel = 0;
  Vec3 towards{0};  ///< the eye, unit
  float distance_m = 0;
  EyeStart start;  ///< of that pixel's rays there
};

class CameraView {
 public:
  /// `light_paths`: connected to the camera for each ray of a pixel.
  CameraView(const Camera& camera, std::size_t width, std::size_t height, double light_paths);

  /// `subpixel` in [0,1)^2 from the top left.
  Ray ray(std::size_t pixel, const Vec2& subpixel) const;
  /// Of the pixel's rays (uniform over it), along this one.
  EyeStart start(const Vec3& direction) const;
  /// False where no pixel sees the point, with nothing in the way.
  bool see(const Vec3& point, PixelSight& sight) const;

 private:
  CameraRays rays_;
  bool perspective_;
  Vec3 origin_, right_, up_, forward_;
  double half_width_, half_height_;  // tangents, or m
  std::size_t width_, height_;
  double light_paths_;
};

}  // namespace phos::inline reference
