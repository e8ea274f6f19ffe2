// Triangles as seen from a point: solid angles that are known, and directions uniform over them.
#include "core/spherical_triangle.h"

#include <gtest/gtest.h>

#include <numbers>

namespace phos {
namespace {

constexpr double kPi64 = std::numbers::pi;

double seen_sr(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from = Vec3(0)) {
  const Vec3 corner[] = {a, b, c};
  return SphericalTriangle(corner, from).solid_angle_sr();
}

TEST(SphericalTriangle, SolidAngles) {
  EXPECT_NEAR(seen_sr({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), kPi64 / 2, 1e-15);
  EXPECT_NEAR(seen_sr({1, 0, 0}, {0, 7, 0}, {0, 0, 1e-6f}), kPi64 / 2, 1e-15);
  EXPECT_NEAR(seen_sr({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}), kPi64 / 3, 1e-15);  // half of a cube's face
  EXPECT_NEAR(seen_sr({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {0.1f, -0.2f, 0.999999f}), 2 * kPi64, 1e-4);
  // Far away: area over squared distance.
  EXPECT_NEAR(seen_sr({0, 0, 1e4f}, {1, 0, 1e4f}, {0, 1, 1e4f}), 0.5e-8, 1e-15);
  // In its plane, at a corner, and of no area.
  EXPECT_EQ(seen_sr({1, 0, 0}, {2, 0, 0}, {1, 1, 0}), 0);
  EXPECT_EQ(seen_sr({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0);
  EXPECT_EQ(seen_sr({1, 1, 1}, {1, 1, 1}, {0, 1, 1}), 0);
  EXPECT_EQ(seen_sr({1, 0, 1}, {2, 0, 2}, {3, 1, 1}, {0, 0, 0}), seen_sr({1, 0, 1}, {3, 1, 1}, {2, 0, 2}));
}

/// Of even points of the square, as many fall into each quarter of the triangle as its solid angle says.
TEST(SphericalTriangle, SamplesAreUniformInSolidAngle) {
  const Vec3 corner[][3] = {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}},
                            {{-1, -1, 0.01f}, {1, -1, 0.01f}, {0.2f, 2, 0.01f}},
                            {{-3, 0, 1}, {3, 0, 1}, {3, 0.05f, 1}}};
  for (const auto& c : corner) {
    const Vec3 middle[] = {(c[0] + c[1]) / 2.f, (c[1] + c[2]) / 2.f, (c[2] + c[0]) / 2.f};
    const Vec3 quarter[4][3] = {{c[0], middle[0], middle[2]},
                                {middle[0], c[1], middle[1]},
                                {middle[2], middle[1], c[2]},
                                {middle[0], middle[1], middle[2]}};
    const SphericalTriangle seen(c, Vec3(0));
    constexpr int kSide = 256;
    double in[4]{};
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec2 u((static_cast<float>(i % kSide) + 0.5f) / kSide,
                   (static_cast<float>(i / kSide) + 0.5f) / kSide);
      const Vec2 w = seen.sample(u);
      ASSERT_TRUE(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1) << w.x << " " << w.y;
      in[w.x + w.y < 0.5f ? 0 : w.x > 0.5f ? 1 : w.y > 0.5f ? 2 : 3] += 1.0 / (kSide * kSide);
    }
    for (int k = 0; k < 4; ++k) {
      const double share = SphericalTriangle(quarter[k], Vec3(0)).solid_angle_sr() / seen.solid_angle_sr();
      EXPECT_NEAR(in[k], share, 2.0 / kSide) << k;
    }
  }
}

}  // namespace
}  // namespace phos
