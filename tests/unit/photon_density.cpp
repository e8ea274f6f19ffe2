#include "core/float_traps.h"
#include "photon/density.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/golden_table.h"

namespace phos {
namespace {

std::vector<Vec2> disc(std::size_t n, std::uint64_t item, float radius = 1) {
  RandomStream random(7, Stage::test, item);
  std::vector<Vec2> points(n);
  for (Vec2& p : points) p = radius * sample_disc(random.uniform2());
  return points;
}

ZoneEstimate estimate(const std::vector<Vec2>& points, float radius, const OnSurface& on = {},
                      float flux = 1) {
  DensityScratch scratch;
  return zone_irradiance(points, std::vector<Rgb>(points.size(), Rgb(flux)), radius, on, {}, scratch);
}

TEST(Density, CapFractions) {
  EXPECT_DOUBLE_EQ(cap_fraction(0), 0.5);
  EXPECT_DOUBLE_EQ(cap_fraction(1), 0);
  EXPECT_DOUBLE_EQ(cap_fraction(2), 0);
  EXPECT_DOUBLE_EQ(cap_fraction(-1), 1);
  EXPECT_NEAR(cap_fraction(0.5), (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / std::numbers::pi, 1e-15);
}

TEST(Density, NoPhotonOneTwoThreeAndALine) {
  for (const std::vector<Vec2>& points :
       {std::vector<Vec2>{}, {{0.1f, 0}}, {{0.1f, 0}, {0, 0.2f}}, {{0.1f, 0}, {0, 0.2f}, {0.3f, 0.3f}}}) {
    const ZoneEstimate e = estimate(points, 2);
    EXPECT_EQ(e.kind, ZoneKind::few);
    EXPECT_NEAR(e.irradiance.x, static_cast<float>(points.size()) / (kPi * 4), 1e-6f);
    EXPECT_NEAR(e.stderr_lx.x, std::sqrt(static_cast<float>(points.size())) / (kPi * 4), 1e-6f);
  }
  std::vector<Vec2> line;
  for (int i = 0; i < 40; ++i) line.push_back({-0.9f + 0.045f * static_cast<float>(i), 0});
  const ZoneEstimate e = estimate(line, 1);
  EXPECT_EQ(e.kind, ZoneKind::few);
  EXPECT_TRUE(e.degenerate);
  EXPECT_NEAR(e.irradiance.x, 40 / kPi, 1e-4f);
  const ZoneEstimate same = estimate(std::vector<Vec2>(50, Vec2(0.2f, 0.1f)), 1);
  EXPECT_TRUE(same.degenerate);
  EXPECT_NEAR(same.irradiance.x, 50 / kPi, 1e-4f);
}

TEST(Density, ScaleChangesNothingButTheUnit) {
  const ZoneEstimate one = estimate(disc(300, 1), 1);
  for (const float s : {1e-9f, 1e-6f, 1e6f}) {
    const ZoneEstimate e = estimate(disc(300, 1, s), s, {}, s * s);
    EXPECT_EQ(e.kind, one.kind);
    EXPECT_NEAR(e.irradiance.x / one.irradiance.x, 1, 1e-5f);
    EXPECT_NEAR(e.stderr_lx.x / one.stderr_lx.x, 1, 1e-5f);
  }
}

TEST(Density, ShadowEdgeEndsTheReach) {
  std::vector<Vec2> lit;
  for (const Vec2& p : disc(2000, 2)) {
    if (p.x > -0.4f) lit.push_back(p);
  }
  const ZoneEstimate shadow = estimate(lit, 1);
  EXPECT_EQ(shadow.kind, ZoneKind::hull);
  EXPECT_NEAR(shadow.edge_m, 0.4f, 0.03f);
  // The same photons where the surface itself ends there: a border is no reason for a smaller radius.
  const ZoneEstimate border = estimate(lit, 1, [](const Vec2& q) { return q.x > -0.4f; });
  EXPECT_EQ(border.kind, ZoneKind::hull);
  EXPECT_EQ(border.edge_m, kInfinity);
  EXPECT_GT(border.centroid_m.x, 0.1f);
}

TEST(Density, DarkCentreIsZeroWithItsDistanceToTheLight) {
  std::vector<Vec2> lit;
  for (const Vec2& p : disc(2000, 3)) {
    if (p.x > 0.3f) lit.push_back(p);
  }
  const ZoneEstimate e = estimate(lit, 1);
  EXPECT_EQ(e.kind, ZoneKind::dark);
  EXPECT_EQ(e.irradiance, Rgb(0));
  EXPECT_NEAR(e.edge_m, 0.3f, 0.03f);
}

TEST(Density, AClusterIsFoundAndAGradientIsNot) {
  std::vector<Vec2> cluster = disc(200, 4), gradient;
  for (const Vec2& p : disc(800, 5, 0.1f)) cluster.push_back(p + Vec2(0.3f, 0.2f));
  EXPECT_TRUE(estimate(cluster, 1).clustered);
  std::vector<Vec2> centred = disc(200, 4);
  for (const Vec2& p : disc(800, 5, 0.1f)) centred.push_back(p);
  EXPECT_TRUE(estimate(centred, 1).clustered);
  RandomStream random(8, Stage::test, 0);
  for (const Vec2& p : disc(2000, 6)) {
    if (random.uniform() * 1.5f < 1 + 0.5f * p.x) gradient.push_back(p);
  }
  EXPECT_FALSE(estimate(gradient, 1).clustered);
  EXPECT_FALSE(estimate(disc(1000, 7), 1).clustered);
}

TEST(Density, AHoleInTheSurfaceIsProbed) {
  std::vector<Vec2> ring;
  for (const Vec2& p : disc(1000, 8)) {
    if (glm::length(p) > 0.5f) ring.push_back(p);
  }
  const ZoneEstimate e = estimate(ring, 1, [](const Vec2& q) { return glm::length(q) > 0.5f; });
  EXPECT_TRUE(e.probed);
  EXPECT_NEAR(e.irradiance.x, 1000 / kPi, 4 * e.stderr_lx.x);
}

TEST(MeanDistance, LimitsAndAPlaneAtOneDistance) {
  EXPECT_EQ(mean_distance_m({}, {}, {}), kInfinity);
  std::vector<Vec3> directions;
  std::vector<float> weights, distances;
  for (std::size_t i = 0; i < 200; ++i) {
    RandomStream random(9, Stage::test, i);
    directions.push_back(sample_cosine_hemisphere(random.uniform2()));
    weights.push_back(1), distances.push_back(3);
  }
  EXPECT_NEAR(mean_distance_m(directions, weights, distances), 3, 1e-5f);
  distances.assign(200, kInfinity);
  EXPECT_EQ(mean_distance_m(directions, weights, distances), kInfinity);
  EXPECT_EQ(mean_distance_m(std::span(directions).first(10), std::span(weights).first(10),
                            std::span(distances).first(10)),
            kInfinity);
}

/// The box of the table: walls at x = -1.2, 0.8, y = -1, 1, ceiling at 2 with luminances .5, .2, .8, .1, 1,
/// seen from the origin of a black floor. A photon's direction is drawn from L cos: by rejection.
TEST(MeanDistance, BoxAgreesWithTheTable) {
  std::map<std::string, std::map<std::string, std::pair<double, double>>> table;
  for (auto& row : test::golden("C4_harmonic.csv")) {
    table[row["n"]][row["estimator"]] = {std::stod(row["mean"]), std::stod(row["sd"])};
  }
  const auto hit = [](const Vec3& w, float& luminance) {
    const NoFloatTraps traps;  // along an axis the walls beside it are infinitely far
    const float tx = w.x > 0 ? 0.8f / w.x : -1.2f / w.x, ty = 1 / std::fabs(w.y), tz = 2 / w.z;
    const float t = std::min({tx, ty, tz});
    luminance = t == tz ? 1 : t == tx ? (w.x > 0 ? 0.2f : 0.5f) : (w.y > 0 ? 0.1f : 0.8f);
    return t;
  };
  for (const int n : {30, 300, 3000}) {
    double sum = 0;
    const int reps = 300;
    RandomStream random(10, Stage::test, static_cast<std::uint64_t>(n));
    for (int r = 0; r < reps; ++r) {
      random.start_bounce(static_cast<std::uint32_t>(r));
      std::vector<Vec3> directions;
      std::vector<float> weights(static_cast<std::size_t>(n), 1.f), distances;
      while (static_cast<int>(directions.size()) < n) {
        const Vec3 w = sample_cosine_hemisphere(random.uniform2());
        float luminance = 0;
        const float t = hit(w, luminance);
        if (random.uniform() >= luminance) continue;
        directions.push_back(w), distances.push_back(t);
      }
      sum += static_cast<double>(mean_distance_m(directions, weights, distances));
    }
    const auto [mean, sd] = table[std::to_string(n)][n < 50 ? "flux_harm" : "grid4_solid"];
    EXPECT_NEAR(sum / reps, mean, 4 * sd * std::sqrt(2.0 / reps) + 0.003 * mean) << n;
  }
}

}  // namespace
}  // namespace phos
