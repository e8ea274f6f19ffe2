// Rays of a camera and its projection agree; samples of a pixel lie evenly in it.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/inside_solid.h"
#include "scene/picture.h"
#include "scene/scene.h"
#include "support/scenes.h"

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

TEST(Picture, SamplesOfAPixelBalanceAboutItsCentre) {
  EXPECT_EQ(subpixel_offset(0, 1), Vec2(0.5f));
  for (int n = 1; n <= 300; ++n) {
    glm::dvec2 sum(0);
    for (int i = 0; i < n; ++i) {
      const Vec2 p = subpixel_offset(i, n);
      ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << i << " of " << n;
      sum += glm::dvec2(p);
    }
    EXPECT_NEAR(sum.x / n, 0.5, 1e-6) << n;
    EXPECT_NEAR(sum.y / n, 0.5, 1e-6) << n;
    // More of them, at edges: none is there already.
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < n; ++j) EXPECT_NE(further_offset(i, 2, n), subpixel_offset(j, n)) << n;
    EXPECT_EQ(further_offset(0, 2, n) + further_offset(1, 2, n), Vec2(1)) << n;
  }
}

/// Square of the centred L2 discrepancy (Hickernell 1998).
double discrepancy(int n) {
  std::vector<glm::dvec2> p;
  for (int i = 0; i < n; ++i) p.emplace_back(subpixel_offset(i, n));
  double one = 0, two = 0;
  for (const glm::dvec2& a : p) {
    const glm::dvec2 d = glm::abs(a - 0.5);
    one += (1 + 0.5 * d.x - 0.5 * d.x * d.x) * (1 + 0.5 * d.y - 0.5 * d.y * d.y);
    for (const glm::dvec2& b : p) {
      const glm::dvec2 e = glm::abs(b - 0.5), f = glm::abs(a - b);
      two += (1 + 0.5 * (d.x + e.x - f.x)) * (1 + 0.5 * (d.y + e.y - f.y));
    }
  }
  return std::pow(13 / 12., 2) - 2 * one / n + two / n / n;
}

/// The R2 sequence alone has 0.058 for 4 and 0.015 for 16.
TEST(Picture, SamplesOfAPixelAreEven) {
  for (const auto& [n, most] :
       {std::pair{2, 0.065}, {4, 0.035}, {5, 0.017}, {16, 0.0026}, {32, 0.002}, {33, 0.0018}})
    EXPECT_LT(discrepancy(n), most) << n;
}

/// Lamps are sampled by Sobol' points: halves of a pixel and halves of a lamp do not go together.
TEST(Picture, SamplesOfAPixelDoNotGoWithThoseOfLamps) {
  for (const int n : {4, 16, 31, 64}) {
    double square = 0;
    constexpr int kShifts = 1000;
    for (std::uint64_t k = 0; k < kShifts; ++k) {
      phos::RandomStream random(1, Stage::test, k);
      const std::uint32_t shift[2] = {random.bits(), random.bits()};
      int both = 0;
      for (int i = 0; i < n; ++i)
        both += subpixel_offset(i, n).x < 0.5f && sobol_point(i, shift[0], shift[1]).x < 0.5f;
      square += std::pow(both / static_cast<double>(n) - 0.25, 2);
    }
    EXPECT_LT(std::sqrt(square / kShifts), 0.25 / std::sqrt(static_cast<double>(n))) << n;
  }
}

/// In the air of a room, in a block of stone in it, and in a block of glass.
TEST(CameraInside, IsToldOfSolidsAndGlass) {
  Scene scene;
  test::begin_instance(scene, "room", test::add_lambert(scene, "grey", 0.5f));
  test::add_room(scene, {0, 0, 0}, {4, 3, 4});
  const auto add_block = [&](const char* name, std::uint32_t material, const Vec3& lo) {
    test::begin_instance(scene, name, material);
    test::add_room(scene, lo + Vec3(1, 0, 0), lo + Vec3(0, 1, 1));  // mirrored: fronts outwards
  };
  add_block("stone", 0, {0.5f, 0.1f, 0.5f});
  const std::uint32_t glass = test::add_lambert(scene, "glass", 0);
  scene.material[glass].model = Model::dielectric, scene.material[glass].ior = 1.5f;
  add_block("glass", glass, {2.5f, 0.1f, 2.5f});
  test::add_point_light(scene, {2, 2.5f, 2}, 100);
  finalize(scene);
  const RayScene rays(scene);
  const auto told = [&](const Vec3& eye, bool perspective = true) {
    Camera camera;
    camera.name = "eye", camera.perspective = perspective;
    camera.to_world[3] = Vec4(eye, 1);
    return camera_inside_solid(rays, camera).value_or("");
  };
  EXPECT_EQ(told({2, 1.5f, 2}), "");
  EXPECT_NE(told({1, 0.6f, 1}).find("\"eye\""), std::string::npos);
  EXPECT_NE(told({3, 0.6f, 3}), "");
  EXPECT_EQ(told({1, 0.6f, 1}, false), "");
}
