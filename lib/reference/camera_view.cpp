#include "reference/camera_view.h"

#include <cmath>

namespace phos::inline reference {

CameraView::CameraView(const Camera& camera, std::size_t width, std::size_t height, double light_paths)
    : rays_(camera, static_cast<float>(width) / static_cast<float>(height)),
      perspective_(camera.perspective),
      width_(width),
      height_(height),
      light_paths_(light_paths) {
  const Camera::Ray middle = rays_({0.5f, 0.5f}), right = rays_({1, 0.5f}), top = rays_({0.5f, 0});
  origin_ = middle.origin, forward_ = middle.direction;
  const auto across = [&](const Camera::Ray& ray) {
    const Vec3 way = perspective_ ? ray.direction : ray.origin - origin_;
    return normalized_or_zero(way - glm::dot(way, forward_) * forward_);
  };
  right_ = across(right), up_ = across(top);
  half_height_ = static_cast<double>(perspective_ ? std::tan(0.5f * camera.yfov_rad) : camera.ymag_m);
  half_width_ = half_height_ * static_cast<double>(width) / static_cast<double>(height);
}

Ray CameraView::ray(std::size_t pixel, const Vec2& subpixel) const {
  const Vec2 corner(static_cast<float>(pixel % width_), static_cast<float>(pixel / width_));
  const Vec2 size(static_cast<float>(width_), static_cast<float>(height_));
  const Camera::Ray ray = rays_((corner + subpixel) / size);
  return {ray.origin, ray.direction, 0, kInfinity};
}

EyeStart CameraView::start(const Vec3& direction) const {
  const double pixels = static_cast<double>(width_) * static_cast<double>(height_);
  EyeStart start{pixels / (4 * half_width_ * half_height_), !perspective_, light_paths_};
  const auto cosine = static_cast<double>(glm::dot(direction, forward_));
  // Of a plane at distance 1, per sr.
  if (perspective_) start.density /= cosine * cosine * cosine;
  return start;
}

bool CameraView::see(const Vec3& point, PixelSight& sight) const {
  const DVec3 way = DVec3(point) - DVec3(origin_);
  const double depth = glm::dot(way, DVec3(forward_));
  if (!(depth > 0)) return false;
  const double scale = perspective_ ? depth : 1;
  const double x =
      0.5 * (1 + glm::dot(way, DVec3(right_)) / (scale * half_width_)) * static_cast<double>(width_);
  const double y =
      0.5 * (1 - glm::dot(way, DVec3(up_)) / (scale * half_height_)) * static_cast<double>(height_);
  if (!(x >= 0 && y >= 0 && x < static_cast<double>(width_) && y < static_cast<double>(height_)))
    return false;
  sight.pixel = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  const double distance = perspective_ ? glm::length(way) : depth;
  sight.distance_m = static_cast<float>(distance);
  sight.towards = perspective_ ? Vec3(-way / distance) : -forward_;
  sight.start = start(-sight.towards);
  return true;
}

}  // namespace phos::inline reference
