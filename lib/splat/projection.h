// Where things of the world fall on the picture.
#pragma once

#include "core/vector.h"
#include "scene/scene.h"

namespace phos::inline splat {

/// Pixels [x0, x1) x [y0, y1), row 0 at the top.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// A camera and picture size, ready to project. Agrees with Camera::ray.
class Projection {
 public:
  Projection(const Camera& camera, int width, int height);

  /// Every pixel in which a point of the sphere can be seen, one pixel of margin included (so that it holds
  /// for any subpixel). The exact bounds of the projected sphere; the whole picture if the camera is inside;
  /// empty if the sphere is behind it.
  PixelRect sphere_bounds(const Vec3& centre, double radius_m) const;

  /// World to camera axes (x right, y up, looking along -z), without the translation to eye().
  const glm::dmat3& axes() const { return axes_; }
  const DVec3& eye() const { return eye_; }
  bool perspective() const { return perspective_; }
  /// Half extents of the picture: tangents at depth 1 (perspective), or lengths in camera units
  /// (orthographic).
  double half_width() const { return half_width_; }
  double half_height() const { return half_height_; }

 private:
  struct Span {
    double lo, hi;
  };
  Span slope_span(double across, double depth, double radius) const;
  int width_, height_;
  bool perspective_;
  DVec3 eye_;
  glm::dmat3 axes_;
  double half_width_, half_height_;
};

}  // namespace phos::inline splat
