// Rays that go straight through panes.
#include "scene/material/passage.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr double kClear = 0.92307692;  // at normal incidence, n = 1.5

Material glass(Model model = Model::thin_dielectric) {
  Material m;
  m.name = "glass";
  m.model = model;
  m.ior = 1.5f;
  m.double_sided = true;
  return m;
}

/// A floor at y = 0, and panes of 4 x 4 m over it, each an instance of its own.
Scene panes_at(const std::vector<float>& heights_m, const Material& material = glass()) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
  add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  scene.material.push_back(material);
  for (const float y : heights_m) {
    begin_instance(scene, "pane", 1);
    add_quad(scene, {-2, y, -2}, {0, 0, 4}, {4, 0, 0});
  }
  finalize(scene);
  return scene;
}

double straight_down(const Scene& scene, float from_m, float length_m, float x = 0.3f) {
  const RayScene rays(scene);
  return static_cast<double>(rays.transmittance({{x, from_m, 0.1f}, {0, -1, 0}, 0, length_m}).x);
}

}  // namespace

TEST(Passage, OnePaneTwoPanesAndWhatIsOpaque) {
  EXPECT_NEAR(straight_down(panes_at({1}), 2, 1.5f), kClear, 1e-5);
  EXPECT_EQ(straight_down(panes_at({1}), 2, 2.5f), 0) << "the floor";
  EXPECT_EQ(straight_down(panes_at({1}), 2, 0.5f), 1) << "it ends before the pane";
  // Next to each other, a pack: (1 - R) / (1 + 3 R). Far from each other each by itself.
  EXPECT_NEAR(straight_down(panes_at({1, 1.1f}), 2, 1.5f), 0.857142857, 1e-5);
  EXPECT_NEAR(straight_down(panes_at({1, 3}), 4, 3.5f), kClear * kClear, 1e-5);
}

/// Along the edge that the two triangles of a pane share a ray hits both: it crosses one pane.
TEST(Passage, ASharedEdgeIsNoSecondPane) {
  const Scene scene = panes_at({1});
  const RayScene rays(scene);
  for (float x = -1.9f; x < 1.9f; x += 0.01f)
    for (const float z : {x, -x})
      EXPECT_NEAR(static_cast<double>(rays.transmittance({{x, 2, z}, {0, -1, 0}, 0, 1.5f}).x), kClear, 1e-5)
          << x << " " << z;
}

/// The pack of 200 panes, (1 - R) / (1 + 399 R); in any order of their instances, two at one place too.
TEST(Passage, TwoHundredPanes) {
  std::vector<float> heights;
  for (int i = 0; i < 200; ++i) heights.push_back(1 + 0.001f * static_cast<float>(i * 67 % 200));
  EXPECT_NEAR(straight_down(panes_at(heights), 2, 1.5f), 0.96 / (1 + 399 * 0.04), 2e-5);
  EXPECT_NEAR(straight_down(panes_at({1, 1}), 2, 1.5f), 0.857142857, 1e-5);
}

TEST(Passage, APaneOnAWallLeavesTheWallOpaque) {
  const Scene scene = panes_at({0});
  const RayScene rays(scene);
  EXPECT_EQ(rays.transmittance({{0.3f, 1, 0.1f}, {0, -1, 0}, 0, 2}), Rgb(0));
  // A walk that passes it comes to the wall, not through it.
  Way way(rays, {{0.3f, 1, 0.1f}, {0, -1, 0}});
  SurfacePoint point;
  int surfaces = 0;
  bool wall = false;
  while (way.next(point)) ++surfaces, wall = point.material == 0;
  EXPECT_LE(surfaces, 2);
  EXPECT_TRUE(wall);
}

TEST(Passage, TintCoverageAndCurve) {
  Material m = glass();
  m.tint = Rgb(1, 0.5f, 0);
  const Scene tinted_scene = panes_at({1}, m);
  const RayScene tinted_rays(tinted_scene);
  const Rgb tinted = tinted_rays.transmittance({{0.3f, 2, 0}, {0, -1, 0}, 0, 1.5f});
  EXPECT_NEAR(tinted.x, kClear, 1e-5);
  EXPECT_NEAR(tinted.y, kClear / 2, 1e-5);
  EXPECT_EQ(tinted.z, 0);

  m = glass();
  m.alpha_mode = Material::Alpha::blend, m.alpha = 0.4f;
  EXPECT_NEAR(straight_down(panes_at({1}, m), 2, 1.5f), 0.6 + 0.4 * kClear, 1e-5);
  m.model = Model::lambert, m.kd = Rgb(0);
  EXPECT_NEAR(straight_down(panes_at({1}, m), 2, 1.5f), 0.6, 1e-5);
  m.alpha = 0;
  EXPECT_EQ(straight_down(panes_at({1}, m), 2, 1.5f), 1);

  m = glass();
  m.curve =
      std::make_shared<const TransmittanceCurve>(std::vector<TransmittanceCurve::Point>{{0, 0.7}, {60, 0.5}});
  EXPECT_NEAR(straight_down(panes_at({1}, m), 2, 1.5f), 0.7, 1e-5);
}

/// A sheet is continuous with clear glass, and honours base colour and transmission: with transmission t it
/// passes t kd ((1 - t) (1 - F) + t T).
TEST(Passage, SheetsByTheirShare) {
  for (const float t : {0.49f, 0.5f, 1.f}) {
    Material m;
    m.model = Model::metallic_roughness, m.kd = Rgb(0.5f), m.metallic = 0, m.roughness = 0,
    m.transmission = t;
    const double share = static_cast<double>(t);
    EXPECT_NEAR(straight_down(panes_at({1}, m), 2, 1.5f), share * 0.5 * ((1 - share) * 0.96 + share * kClear),
                1e-4)
        << t;
    m.metallic = 1;
    EXPECT_EQ(straight_down(panes_at({1}, m), 2, 1.5f), 0) << "a metal";
  }
}

namespace {

/// A box of solid glass, fronts outside; its faces are one instance, or each its own.
Scene plate(float thickness_m, bool apart, const Rgb& absorption_per_m = Rgb(0)) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
  add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  scene.material.push_back(glass(Model::dielectric));
  scene.material[1].absorption_per_m = absorption_per_m;
  const Vec3 c(-2, 1, -2), x(4, 0, 0), y(0, thickness_m, 0), z(0, 0, 4);
  const Vec3 face[6][3] = {{c, x, z}, {c + y, z, x}, {c, z, y}, {c + x, y, z}, {c, y, x}, {c + z, x, y}};
  for (int f = 0; f < 6; ++f) {
    if (apart || f == 0) begin_instance(scene, "plate", 1);
    add_quad(scene, face[f][0], face[f][1], face[f][2]);
  }
  finalize(scene);
  return scene;
}

}  // namespace

/// Sun through a plate is as through a pane, with absorption along the slanted way.
TEST(Passage, ParallelFacesOfSolidGlassAreAPane) {
  for (const bool apart : {false, true})
    for (const double degrees : {0.0, 30.0, 60.0}) {
      const Scene scene = plate(0.1f, apart, Rgb(6.9314718f));  // half of it in 0.1 m
      const RayScene rays(scene);
      const double angle = degrees * std::numbers::pi / 180;
      const Vec3 way(std::sin(angle), std::cos(angle), 0);
      const Rgb t = rays.transmittance({{-0.5f, 0.5f, 0.1f}, way});
      const double truth = static_cast<double>(
          pane_layer(static_cast<float>(std::cos(angle)), 1.5f, Rgb(0.5f)).transmittance().x);
      EXPECT_NEAR(static_cast<double>(t.x), truth, 1e-4 * truth) << degrees << " " << apart;
    }
}

/// A lamp over a plate of 100 mm, in all 1.1 m away: the closed form is 1.0590 of the straight one on the
/// axis (docs/methods.md#g1-7, first passage: I (1-R)^2 / (h + d / n)^2).
TEST(Passage, LampsOverPlatesAreNearer) {
  const Scene scene = plate(0.1f, false);
  const RayScene rays(scene);
  const double t = static_cast<double>(rays.transmittance({{0.3f, 1.6f, 0.1f}, {0, -1, 0}, 0, 1.1f}).x);
  const double lowered = 1.1 - 0.1 * (1 - 1 / 1.5);
  EXPECT_NEAR(t, kClear * 1.1 * 1.1 / (lowered * lowered), 2e-4);
}

TEST(Passage, RoundGlassIsNoPane) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
  add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  scene.material.push_back(glass(Model::dielectric));
  begin_instance(scene, "ball", 1);
  constexpr int kRings = 16, kSlices = 32;
  const auto at = [](int ring, int slice) {
    const double polar = std::numbers::pi * ring / kRings, around = 2 * std::numbers::pi * slice / kSlices;
    return Vec3(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
  };
  const Vec3 centre(0, 1.5f, 0);
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if (glm::length(glm::cross(b - a, c - a)) < 1e-6f) return;
    add_triangle(scene, centre + 0.5f * a, centre + 0.5f * b, centre + 0.5f * c);
    for (std::size_t k = 0; k < 3; ++k)
      scene.normal[scene.normal.size() - 3 + k] = k == 0 ? a : k == 1 ? b : c;
  };
  for (int r = 0; r < kRings; ++r)
    for (int s = 0; s < kSlices; ++s) {
      add(at(r, s), at(r + 1, s + 1), at(r + 1, s));
      add(at(r, s), at(r, s + 1), at(r + 1, s + 1));
    }
  finalize(scene);
  const RayScene rays(scene);
  // Straight through the pole's vertex, along edges, and all about.
  for (float x = -0.3f; x <= 0.3f; x += 0.05f)
    for (float z = -0.3f; z <= 0.3f; z += 0.05f)
      EXPECT_EQ(rays.transmittance({{x, 3, z}, {0, -1, 0}, 0, 2.9f}), Rgb(0)) << x << " " << z;
  EXPECT_EQ(rays.transmittance({{0, 3, 0}, {0, -1, 0}, 0, 2.9f}), Rgb(0));
}

/// Both ways of asking give the same bits.
TEST(Passage, PacketsAreAsSingleRays) {
  const Scene scene = panes_at({1, 1.02f, 2});
  const RayScene rays(scene);
  std::vector<Ray> many;
  for (int i = 0; i < 133; ++i) {
    const float x = -1.5f + 0.02f * static_cast<float>(i);
    many.push_back({{x, 3, 0.3f * x}, glm::normalize(Vec3(-x * 0.4f, -1, 0.1f)), 0, i % 7 == 0 ? 5.f : 2.5f});
  }
  std::vector<Rgb> shares(many.size());
  rays.transmittance(many, shares);
  for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(shares[i], rays.transmittance(many[i])) << i;
}

/// Faces outwards, or inwards.
void add_block(Scene& scene, const Vec3& lo, const Vec3& hi, bool outwards) {
  const Vec3 size = hi - lo;
  for (int a = 0; a < 3; ++a) {
    Vec3 u(0), v(0);
    u[(a + 1) % 3] = size[(a + 1) % 3], v[(a + 2) % 3] = size[(a + 2) % 3];
    Vec3 far_side = lo;
    far_side[a] = hi[a];
    add_quad(scene, lo, outwards ? v : u, outwards ? u : v);
    add_quad(scene, far_side, outwards ? u : v, outwards ? v : u);
  }
}

/// Light passes a cube of glass, and the walls of a glass case, by parallel faces, but no block with a thing
/// in it: bent, it goes elsewhere within.
TEST(Passage, BlocksWithThingsInThemAreNoPlates) {
  enum class Kind { empty, filled, showcase };
  const auto through = [](Kind kind) {
    Scene scene;
    begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
    add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    scene.material.push_back(glass(Model::dielectric));
    scene.material.back().double_sided = false;
    begin_instance(scene, "glass", 1);
    add_block(scene, Vec3(-0.5f, 0.5f, -0.5f), Vec3(0.5f, 1.5f, 0.5f), true);
    if (kind == Kind::showcase) add_block(scene, Vec3(-0.4f, 0.6f, -0.4f), Vec3(0.4f, 1.4f, 0.4f), false);
    if (kind != Kind::empty) {
      begin_instance(scene, "thing", 0);
      add_block(scene, Vec3(-0.3f, 0.5f, -0.3f), Vec3(0, 1.1f, 0), true);  // on the bottom
    }
    finalize(scene);
    const RayScene rays(scene);
    return static_cast<double>(rays.transmittance({{0.3f, 0.1f, 0.1f}, {0, 1, 0}}).x);
  };
  EXPECT_NEAR(through(Kind::empty), kClear, 1e-4);
  EXPECT_EQ(through(Kind::filled), 0);
  EXPECT_NEAR(through(Kind::showcase), kClear * kClear, 0.03);
}

}  // namespace phos::test
