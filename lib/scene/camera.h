// Rays through the pixels of one picture.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Camera::ray for many rays: their common terms are worked out once. Same bits.
class CameraRays {
 public:
  CameraRays(const Camera& camera, float image_aspect);
  Camera::Ray operator()(const Vec2& st) const;

 private:
  Vec3 origin_;
  Frame axes_;  // right, up, backward
  bool perspective_;
  float half_height_, image_aspect_;  // tangent (perspective), or m
};

}  // namespace phos::inline scene
