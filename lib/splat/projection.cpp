#include "splat/projection.h"

#include <algorithm>

#include "core/error.h"

namespace phos::inline splat {
namespace {

/// Cuts [lo, hi] given in pixels, with a margin of one, to a picture of `size` pixels.
void to_pixels(double lo, double hi, int size, int& first, int& end) {
  const double last = static_cast<double>(size);
  first = static_cast<int>(std::clamp(std::floor(lo) - 1, 0.0, last));
  end = static_cast<int>(std::clamp(std::ceil(hi) + 1, 0.0, last));
}

}  // namespace

Projection::Projection(const Camera& camera, int width, int height)
    : width_(width), height_(height), perspective_(camera.perspective), eye_(Vec3(camera.to_world[3])) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  // From the camera's own matrix, so that scales and mirrors in its node hold here too.
  const glm::dmat4 rows = glm::transpose(glm::dmat4(camera.view_projection(1, 1, 2)));
  const DVec3 right = glm::normalize(DVec3(rows[0])), up = glm::normalize(DVec3(rows[1]));
  axes_ = glm::transpose(glm::dmat3(right, up, glm::cross(right, up)));
  half_height_ = perspective_ ? std::tan(0.5 * static_cast<double>(camera.yfov_rad))
                              : static_cast<double>(camera.ymag_m);
  half_width_ = half_height_ * width / height;
}

/// Slopes across/depth of the two tangents from the eye to a circle, in the half plane before the eye;
/// infinite where the circle reaches beside or behind the eye. lo > hi if it is wholly behind.
Projection::Span Projection::slope_span(double across, double depth, double radius) const {
  const double infinity = std::numeric_limits<double>::infinity(), right = 0.5 * std::numbers::pi;
  const double distance = std::hypot(across, depth);
  if (distance <= radius) return {-infinity, infinity};
  const double middle = std::atan2(across, depth), half = std::asin(radius / distance);
  if (middle - half >= right || middle + half <= -right) return {infinity, -infinity};
  return {middle - half <= -right ? -infinity : std::tan(middle - half),
          middle + half >= right ? infinity : std::tan(middle + half)};
}

PixelRect Projection::sphere_bounds(const Vec3& centre, double radius_m) const {
  if (!std::isfinite(radius_m)) return {0, 0, width_, height_};
  const DVec3 c = axes_ * (DVec3(centre) - eye_);
  const double depth = -c.z;
  // Slightly larger: positions are rounded to float.
  const double slack = 1e-6 * static_cast<double>(max_component(glm::abs(centre)));
  const double radius = radius_m * (1 + 1e-5) + slack;
  if (depth + radius <= 0) return {};
  Span x{c.x - radius, c.x + radius}, y{c.y - radius, c.y + radius};
  if (perspective_) x = slope_span(c.x, depth, radius), y = slope_span(c.y, depth, radius);
  if (x.lo > x.hi || y.lo > y.hi) return {};
  const double w = 0.5 * width_, h = 0.5 * height_;
  PixelRect rect;
  to_pixels(w * (x.lo / half_width_ + 1), w * (x.hi / half_width_ + 1), width_, rect.x0, rect.x1);
  to_pixels(h * (1 - y.hi / half_height_), h * (1 - y.lo / half_height_), height_, rect.y0, rect.y1);
  return rect.empty() ? PixelRect{} : rect;
}

}  // namespace phos::inline splat
