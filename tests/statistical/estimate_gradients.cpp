// Gradients from photons against closed forms, and against the tables of independent programs.
#include "estimate/zone/gradients.h"

#include <gtest/gtest.h>

#include <map>

#include "photon/hull.h"
#include "support/golden_table.h"
#include "support/gradient_scenes.h"

namespace phos {
namespace {

using test::DVec2;
using test::gradient_scene;
using test::PhotonSource;
using test::Spread;

DVec2 xy(const Vec3& v) { return {v.x, v.y}; }

RandomStream numbers(std::uint64_t item) { return {13, Stage::test, item}; }

struct Measured {
  int reps = 0;
  double mean_lx = 0;
  std::map<std::string, Spread> of;  // translation, by the tables' names
};

/// Every estimator on the same zones of exactly n photons, as in the tables.
const Measured& measured(const std::string& scene, double radius_m, std::size_t n) {
  static std::map<std::tuple<std::string, double, std::size_t>, Measured> all;
  const auto [at, fresh] = all.try_emplace({scene, radius_m, n});
  Measured& m = at->second;
  if (!fresh) return m;
  const PhotonSource source(gradient_scene(scene), radius_m);
  const std::vector<std::uint8_t> used(n, 1);
  const double area = source.area_m2();
  m.reps = 400, m.mean_lx = source.mean_lx();
  ZonePhotons zone;
  for (int r = 0; r < m.reps; ++r) {
    RandomStream random = numbers(all.size() << 32 | static_cast<std::uint64_t>(r));
    source.draw(n, static_cast<double>(n), random, zone);
    const ComparedGradients g = compare_gradients(zone, used, area, Frame(), disc_shape(radius_m));
    m.of["photon_analytic(n stored)"].add(xy(g.analytic.translation[1]));
    m.of["analytic"].add(xy(g.analytic.translation[1]));
    m.of["centroid"].add(xy(g.positional.translation[1]));
    m.of["blend"].add(xy(g.blend.translation[1]));
    for (const int rings : {4, 8})
      m.of["grid" + std::to_string(rings)].add(
          xy(hemisphere_gradients(zone, used, area, Frame(), rings).translation[1]));
  }
  return m;
}

TEST(Gradients, TranslationAgreesWithTheTable) {
  int rows = 0;
  for (auto& row : test::golden("D_photon_gradients.csv")) {
    const auto n = static_cast<std::size_t>(std::stoi(row["n"]));
    const Measured& m = measured(row["scene"], std::stod(row["R"]), n);
    const Spread& s = m.of.at(row["estimator"]);
    const double e = std::stod(row["E_exact"]), sd = std::stod(row["sd_over_E_per_m"]) * e;
    const std::string what = row["scene"] + " " + row["estimator"] + " R " + row["R"] + " n " + row["n"];
    const double tolerance = 4 * sd * std::sqrt(1.0 / m.reps + 1.0 / (n <= 300 ? 400 : 100));
    EXPECT_NEAR(s.mean().x, std::stod(row["gx_mean"]), tolerance) << what;
    EXPECT_NEAR(s.mean().y, std::stod(row["gy_mean"]), tolerance) << what;
    EXPECT_NEAR(s.sd() / sd, 1, 0.25) << what;
    ++rows;
  }
  EXPECT_EQ(rows, 64);
}

TEST(Gradients, BlendAgreesWithTheTable) {
  int rows = 0;
  for (auto& row : test::golden("D2_blend.csv")) {
    const auto n = static_cast<std::size_t>(std::stoi(row["n"]));
    if (n > 1000) continue;
    const Measured& m = measured(row["scene"], std::stod(row["R"]), n);
    const Spread& s = m.of.at(row["estimator"]);
    const test::GradientScene scene = gradient_scene(row["scene"]);
    const double e = scene.irradiance_lx(scene.receiver), sd = std::stod(row["sd_over_E"]);
    const std::string what = row["scene"] + " " + row["estimator"] + " R " + row["R"] + " n " + row["n"];
    // That table's photons share out the irradiance at the centre, not the mean.
    EXPECT_NEAR(glm::length(s.mean() / m.mean_lx - scene.translation() / e), std::stod(row["bias_over_E"]),
                4 * sd * std::sqrt(1.0 / m.reps + 1.0 / 300))
        << what;
    // The blend is one or the other of two estimators: its spread has a long tail.
    EXPECT_NEAR(s.sd() / m.mean_lx / sd, 1, row["estimator"] == "blend" ? 0.5 : 0.25) << what;
    ++rows;
  }
  EXPECT_EQ(rows, 48);
}

/// Exact values of grad_r from the closed form of E, with the bias that the table measured for 8 ring means.
TEST(Gradients, RotationAgreesWithTheClosedForm) {
  std::uint64_t item = 100;
  for (auto& row : test::golden("B3_rotational.csv")) {
    if (row["M"] != "8" || row["scene"] == "white_furnace") continue;
    const test::GradientScene scene = gradient_scene(row["scene"]);
    const PhotonSource source(scene, 0.005);
    ZonePhotons zone;
    RandomStream random = numbers(item++);
    source.draw(40000, 40000, random, zone);
    const std::vector<std::uint8_t> used(zone.size(), 1);
    const double e = source.mean_lx(), tolerance = (2 * std::stod(row["bias_over_E"]) + 0.04) * e;
    const DVec2 exact = scene.rotation();
    for (const Gradients& g : {photon_gradients(zone, used, source.area_m2(), Frame()),
                               hemisphere_gradients(zone, used, source.area_m2(), Frame(), 8)})
      EXPECT_LT(glm::length(xy(g.rotation[0]) - exact), tolerance) << row["scene"];
  }
}

/// By the places of photons (docs/methods.md#d3), over the hull of Poisson photons, whose vertices are left
/// out: without bias, where the light is even and where it is not.
TEST(Gradients, PositionsInAHullAreUnbiased) {
  for (const char* name : {"rect_ceiling", "rect_wall_x1", "rect_occluded"}) {
    const double radius = 0.4;
    const test::GradientScene scene = gradient_scene(name);
    const PhotonSource source(scene, radius);
    Spread spread;
    ZonePhotons zone;
    Hull hull;
    for (std::uint64_t r = 0; r < 1500; ++r) {
      RandomStream random = numbers(7000000 + r);
      source.draw_poisson(200, random, zone);
      convex_hull(zone.offset_m, hull);
      std::vector<std::uint8_t> used(zone.size(), 1);
      for (const std::uint32_t v : hull.vertices) used[v] = 0;
      const ComparedGradients g =
          compare_gradients(zone, used, hull.area, Frame(), polygon_shape(zone.offset_m, hull.vertices));
      spread.add(xy(g.positional.translation[1]));
    }
    // Curvature of E over the zone leaves what the disc has too (the tables: up to 0.06 E).
    EXPECT_LT(glm::length(spread.mean() - scene.translation()),
              4 * spread.sd() / std::sqrt(1500) + 0.06 * source.mean_lx())
        << name;
    // Theory for a disc: 2 E / (R sqrt n) per axis; the hull is somewhat smaller.
    EXPECT_NEAR(spread.sd() / (std::sqrt(2) * 2 * source.mean_lx() / (radius * std::sqrt(200))), 1.1, 0.15)
        << name;
  }
}

/// z2 is about 1 where the two gradients estimate the same thing, and beyond kOccludedZ2 at an occluder.
TEST(Gradients, OccludersAreFoundByZ2) {
  const auto z2 = [](const char* name, double n) {
    const PhotonSource source(gradient_scene(name), 0.4);
    double sum = 0, beyond = 0;
    const int reps = 100;
    ZonePhotons zone;
    for (int r = 0; r < reps; ++r) {
      RandomStream random = numbers(8000000 + static_cast<std::uint64_t>(r));
      source.draw_poisson(n, random, zone);
      const std::vector<std::uint8_t> used(zone.size(), 1);
      const ComparedGradients g = compare_gradients(zone, used, source.area_m2(), Frame(), disc_shape(0.4));
      sum += g.z2, beyond += g.z2 > kOccludedZ2;
    }
    return DVec2(sum, beyond) / double(reps);
  };
  for (const char* name : {"rect_ceiling", "rect_wall_x1", "closed_box_5L"}) {
    const DVec2 alike = z2(name, 1000);
    EXPECT_NEAR(alike.x, 1, 0.3) << name;
    EXPECT_EQ(alike.y, 0) << name;
  }
  EXPECT_GT(z2("rect_occluded", 10000).y, 0.95);
}

/// Gradients are vectors: turning the frame about its normal changes nothing but the cells.
TEST(Gradients, DoNotDependOnTheFrame) {
  const PhotonSource source(gradient_scene("closed_box_5L"), 0.1);
  ZonePhotons zone;
  RandomStream random = numbers(200);
  source.draw(2000, source.mean_lx() * source.area_m2(), random, zone);  // 1 lm each
  const std::vector<std::uint8_t> used(zone.size(), 1);
  const Frame turned{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}};
  const Gradients a = photon_gradients(zone, used, 1, Frame()), b = photon_gradients(zone, used, 1, turned);
  const Gradients c = hemisphere_gradients(zone, used, 1, Frame(), 16),
                  d = hemisphere_gradients(zone, used, 1, turned, 16);
  EXPECT_LT(glm::length(a.translation[0] - b.translation[0]), 1e-4f * glm::length(a.translation[0]) + 1e-2f);
  EXPECT_LT(glm::length(a.rotation[0] - b.rotation[0]), 1e-4f * glm::length(a.rotation[0]) + 1e-2f);
  EXPECT_LT(glm::length(c.rotation[0] - d.rotation[0]), 0.05f * glm::length(c.rotation[0]));
  // Positions are told in the frame: offsets turn with it.
  ZonePhotons other = zone;
  for (Vec2& x : other.offset_m) x = {0.6f * x.x + 0.8f * x.y, -0.8f * x.x + 0.6f * x.y};
  const ComparedGradients e = compare_gradients(zone, used, 1, Frame(), disc_shape(0.1)),
                          f = compare_gradients(other, used, 1, turned, disc_shape(0.1));
  EXPECT_NEAR(e.z2, f.z2, 1e-4 * e.z2);
  EXPECT_LT(glm::length(e.positional.translation[2] - f.positional.translation[2]),
            1e-4f * glm::length(e.positional.translation[2]) + 1e-2f);
}

TEST(Gradients, LightFromInfinitelyFarHasNoTranslationGradient) {
  ZonePhotons zone;
  zone.offset_m = {{0, 0}}, zone.flux_lm = {Rgb(1)}, zone.direction = {normalized_or_zero({1, 0, 1})};
  zone.inverse_distance = {0}, zone.source_normal = {-zone.direction[0]};
  const std::vector<std::uint8_t> used{1};
  for (const Gradients& g :
       {photon_gradients(zone, used, 1, Frame()), hemisphere_gradients(zone, used, 1, Frame(), 4)}) {
    EXPECT_EQ(g.translation[0], Vec3(0));
    EXPECT_GT(g.rotation[0].y, 0.5f);
  }
}

}  // namespace
}  // namespace phos
