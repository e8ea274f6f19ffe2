#include "scene/camera.h"

#include <cmath>

namespace phos::inline scene {

namespace {

/// Position and axes of a camera, freed of any scale in its node: glTF gives a camera's scale no meaning.
struct Pose {
  Vec3 origin;
  Frame axes;  // right, up, backward
};

Pose pose_of(const Camera& camera) {
  Pose pose;
  pose.origin = Vec3(camera.to_world[3]);
  pose.axes.z = normalized_or_zero(Vec3(camera.to_world[2]));
  if (pose.axes.z == Vec3(0)) pose.axes.z = Vec3(0, 0, 1);
  const Vec3 right(camera.to_world[0]);
  pose.axes.x = normalized_or_zero(right - glm::dot(right, pose.axes.z) * pose.axes.z);
  if (pose.axes.x == Vec3(0)) pose.axes.x = make_frame(pose.axes.z).x;
  pose.axes.y = glm::cross(pose.axes.z, pose.axes.x);
  return pose;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, float image_aspect)
    : perspective_(camera.perspective),
      half_height_(camera.perspective ? std::tan(0.5f * camera.yfov_rad) : camera.ymag_m),
      image_aspect_(image_aspect) {
  const Pose pose = pose_of(camera);
  origin_ = pose.origin, axes_ = pose.axes;
}

Camera::Ray CameraRays::operator()(const Vec2& st) const {
  const Vec2 ndc(2 * st.x - 1, 1 - 2 * st.y);
  if (perspective_) {
    const Vec3 local(ndc.x * half_height_ * image_aspect_, ndc.y * half_height_, -1);
    return {origin_, glm::normalize(axes_.to_world(local))};
  }
  return {origin_ + ndc.x * half_height_ * image_aspect_ * axes_.x + ndc.y * half_height_ * axes_.y,
          -axes_.z};
}

Camera::Ray Camera::ray(const Vec2& st, float image_aspect) const {
  return CameraRays(*this, image_aspect)(st);
}

Mat4 Camera::view_projection(float image_aspect, float near_m, float far_m) const {
  const Pose pose = pose_of(*this);
  Mat4 view(1);
  for (int i = 0; i < 3; ++i) {
    view[i] = Vec4(pose.axes.x[i], pose.axes.y[i], pose.axes.z[i], 0);
  }
  view[3] = Vec4(-pose.axes.to_local(pose.origin), 1);

  Mat4 projection(0);
  const float depth = far_m - near_m;
  if (perspective) {
    const float half_height = std::tan(0.5f * yfov_rad);
    projection[0][0] = 1 / (half_height * image_aspect);
    projection[1][1] = 1 / half_height;
    projection[2][2] = -(far_m + near_m) / depth;
    projection[2][3] = -1;
    projection[3][2] = -2 * far_m * near_m / depth;
  } else {
    projection[0][0] = 1 / (ymag_m * image_aspect);
    projection[1][1] = 1 / ymag_m;
    projection[2][2] = -2 / depth;
    projection[3][2] = -(far_m + near_m) / depth;
    projection[3][3] = 1;
  }
  return projection * view;
}

}  // namespace phos::inline scene
