// Rays of a camera and its projection agree.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "scene/scene.h"

using namespace phos;

namespace {

Camera placed(bool perspective) {
  Camera camera;
  camera.perspective = perspective;
  camera.yfov_rad = 0.7f;
  camera.ymag_m = 3;
  const Vec3 eye(3, 2, 5), target(-1, 0.5f, 0);
  camera.to_world = glm::inverse(glm::lookAt(eye, target, Vec3(0, 1, 0))) * glm::scale(Mat4(1), Vec3(2.5f));
  return camera;
}

}  // namespace

TEST(Camera, ProjectsItsRaysBack) {
  for (const bool perspective : {true, false}) {
    const Camera camera = placed(perspective);
    for (const float aspect : {0.5f, 1.f, 1.9f}) {
      const Mat4 clip = camera.view_projection(aspect, 0.1f, 100);
      for (int k = 0; k < 100; ++k) {
        RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
        const Vec2 st = random.uniform2();
        const Camera::Ray ray = camera.ray(st, aspect);
        EXPECT_NEAR(glm::length(ray.direction), 1.f, 1e-6f);
        const Vec4 p = clip * Vec4(ray.origin + 7.f * ray.direction, 1);
        EXPECT_NEAR(0.5f + 0.5f * p.x / p.w, st.x, 2e-5f);
        EXPECT_NEAR(0.5f - 0.5f * p.y / p.w, st.y, 2e-5f);
        EXPECT_LT(std::fabs(p.z / p.w), 1.f);
      }
    }
  }
}

TEST(Camera, SpansItsFieldOfView) {
  Camera camera;
  camera.yfov_rad = 1.2f;
  const Camera::Ray top = camera.ray({0.5f, 0}, 2), bottom = camera.ray({0.5f, 1}, 2);
  EXPECT_NEAR(std::acos(glm::dot(top.direction, bottom.direction)), 1.2f, 1e-5f);
  EXPECT_GT(top.direction.y, 0);
  EXPECT_EQ(camera.ray({0.5f, 0.5f}, 2).direction, Vec3(0, 0, -1));
  EXPECT_NEAR(camera.ray({1, 0.5f}, 2).direction.x / -camera.ray({1, 0.5f}, 2).direction.z,
              2 * std::tan(0.6f), 1e-5f);
}

TEST(Camera, DepthRunsFromNearToFar) {
  for (const bool perspective : {true, false}) {
    Camera camera;
    camera.perspective = perspective;
    const Mat4 clip = camera.view_projection(1, 0.5f, 20);
    const Vec4 near = clip * Vec4(0, 0, -0.5f, 1), far = clip * Vec4(0, 0, -20, 1);
    EXPECT_NEAR(near.z / near.w, -1, 1e-5f);
    EXPECT_NEAR(far.z / far.w, 1, 1e-5f);
  }
}

TEST(Camera, OrthographicIgnoresScaleAndKeepsDirections) {
  const Camera camera = placed(false);
  const Camera::Ray a = camera.ray({0, 0}, 1.5f), b = camera.ray({1, 1}, 1.5f);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_NEAR(glm::length(a.origin - b.origin), 2 * std::sqrt(3.f * 3 + 4.5f * 4.5f), 1e-4f);
}
