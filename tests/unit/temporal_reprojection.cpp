#include "core/float_traps.h"
#include "temporal/reprojection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/golden_table.h"
#include "support/moving_cloud.h"

namespace phos {
namespace {

/// First hit of a ray from the origin on a sphere.
std::optional<Vec3> on_sphere(const Vec3& w, const Vec3& centre, double radius) {
  const DVec3 d(w), c(centre);
  const double b = glm::dot(d, c), disc = b * b - (glm::dot(c, c) - radius * radius);
  if (disc <= 0 || b <= 0) return {};
  return Vec3((b - std::sqrt(disc)) * d);
}

/// A sphere that shines, radius 0.35 m, before a patterned ceiling at 3 m; it moves along x by v.
std::optional<test::CloudPoint> golden_scene(const Vec3& w, float v) {
  const Vec3 centre(0.4f, 0.2f, 1.2f);
  if (const auto p = on_sphere(w, centre, 0.35)) {
    const Vec3 normal = glm::normalize(*p - centre);
    return {{*p, Rgb(5), *p + Vec3(v, 0, 0), normal, normal}};
  }
  const Vec3 p = w * (3 / w.z);
  return {{p, Rgb(0.2f * (1 + std::sin(3 * p.x))), {}, Vec3(0, 0, -1)}};
}

/// The table of an independent program: rays through the middles of cells, of which each takes the nearest
/// hit whole, and empty ones are flooded. Hits that take along what they cover come nearer to the truth.
TEST(Reprojection, IsNearerToTheTruthThanTheTable) {
  const auto rows = test::golden("F_reprojection.csv");
  ASSERT_EQ(rows.size(), 9u);
  double ours = 0, theirs = 0, still = 0;
  for (const auto& row : rows) {
    const auto number = [&](const char* column) { return std::stod(row.at(column)); };
    const auto v = static_cast<float>(number("v"));
    const test::MovingCloud cloud(std::stoi(row.at("M")), std::stoi(row.at("N")), Measure::projected, false,
                                  0, [&](const Vec3& w) { return golden_scene(w, v); });
    Hemisphere ahead;
    const ReprojectionCounts counts = cloud.reproject(ahead);
    const auto cells = static_cast<double>(counts.cells);
    EXPECT_NEAR(irradiance_of(cloud.hemisphere).y, number("E_t"), 1e-4) << row.at("M") << " " << v;
    // Cells that nothing moves to, but for those on whose border a direction lies by rounding.
    EXPECT_NEAR(static_cast<double>(counts.empty) / cells, number("hole_fraction"), 1.5 / cells);
    EXPECT_LE(counts.holes, static_cast<double>(counts.empty));
    const double truth = number("E_t1_true");
    ours += std::pow(static_cast<double>(irradiance_of(ahead).y) / truth - 1, 2);
    theirs += std::pow(number("E_t1_filled") / truth - 1, 2);
    still += std::pow(number("E_t") / truth - 1, 2);
  }
  EXPECT_LT(ours, 0.3 * theirs);
  EXPECT_LT(ours, 0.1 * still);
}

void expect_same(const Hemisphere& a, const Hemisphere& b) {
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.radiance, b.radiance);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.hit_normal, b.hit_normal);
  EXPECT_EQ(a.projected_sr, b.projected_sr);
  EXPECT_EQ(a.rings, b.rings);
  EXPECT_EQ(a.slices, b.slices);
  EXPECT_EQ(a.measure, b.measure);
}

TEST(Reprojection, LeavesWhatDoesNotMoveBitForBit) {
  for (const Measure measure : {Measure::projected, Measure::solid}) {
    const test::MovingCloud cloud(16, 50, measure, true, 1,
                                  [](const Vec3& w) -> std::optional<test::CloudPoint> {
                                    if (w.x > 0.8f) return {};
                                    auto seen = golden_scene(w, 0);
                                    seen->next.reset();
                                    return seen;
                                  });
    Hemisphere ahead;
    const ReprojectionCounts counts = cloud.reproject(ahead);
    EXPECT_EQ(counts.empty + counts.hidden, 0u);
    EXPECT_EQ(counts.holes, 0);
    expect_same(cloud.hemisphere, ahead);
  }
}

/// A sphere of luminance L over a black world: E = pi L (a / d)^2 cos. It moves towards the place, aside, and
/// both; jittered rays, mean over many of them.
TEST(Reprojection, FollowsASphereThatShines) {
  const Vec3 centre(0.3f, -0.2f, 2);
  const auto irradiance = [](const Vec3& c) {
    const DVec3 d(c);
    return std::numbers::pi * 10 * 0.25 / glm::dot(d, d) * d.z / glm::length(d);
  };
  for (const Measure measure : {Measure::projected, Measure::solid}) {
    for (const Vec3& step : {Vec3(0.1f, 0, 0), Vec3(0, 0, -0.1f), Vec3(-0.05f, 0.1f, 0.05f)}) {
      double sum = 0, squares = 0, before = 0;
      constexpr int kTimes = 64;
      for (std::uint64_t item = 0; item < kTimes; ++item) {
        const test::MovingCloud cloud(32, 100, measure, true, item,
                                      [&](const Vec3& w) -> std::optional<test::CloudPoint> {
                                        if (const auto p = on_sphere(w, centre, 0.5)) {
                                          const Vec3 normal = glm::normalize(*p - centre);
                                          return {{*p, Rgb(10), *p + step, normal, normal}};
                                        }
                                        return {{w * (4 / w.z), Rgb(0)}};
                                      });
        Hemisphere ahead;
        cloud.reproject(ahead);
        const auto e = static_cast<double>(irradiance_of(ahead).y);
        sum += e / kTimes, squares += e * e / kTimes;
        before += static_cast<double>(irradiance_of(cloud.hemisphere).y) / kTimes;
      }
      const double truth = irradiance(centre + step);
      const double error = std::sqrt((squares - sum * sum) / kTimes);
      EXPECT_NEAR(before, irradiance(centre), 0.01 * truth);
      EXPECT_NEAR(sum, truth, 4 * error + 0.01 * truth);
      EXPECT_LT(std::fabs(sum - truth), 0.4 * std::fabs(irradiance(centre) - truth));
    }
  }
}

/// A record that moves in a room finds other cells empty, but nothing new came to light.
TEST(Reprojection, TellsHolesFromCellsThatJitterLeftEmpty) {
  const auto room = [](const Vec3& w) -> std::optional<test::CloudPoint> {
    const float to_wall = 1 / std::max(std::fabs(w.x), std::fabs(w.y)), to_ceiling = 2 / w.z;
    const Vec3 p = w * std::min(to_wall, to_ceiling);
    const Vec3 normal = to_ceiling < to_wall              ? Vec3(0, 0, -1)
                        : std::fabs(w.x) > std::fabs(w.y) ? Vec3(-std::copysign(1.f, w.x), 0, 0)
                                                          : Vec3(0, -std::copysign(1.f, w.y), 0);
    return {{p, Rgb(1), {}, normal}};
  };
  const test::MovingCloud cloud(16, 50, Measure::projected, true, 3, room);
  Hemisphere ahead;
  const ReprojectionCounts counts = cloud.reproject(ahead, {0.05f, 0.02f, 0});
  EXPECT_GT(counts.empty, counts.cells / 20);
  EXPECT_LE(counts.holes, 0.01 * static_cast<double>(counts.cells));
  EXPECT_NEAR(irradiance_of(ahead).y, kPi, 1e-4f);
}

TEST(Reprojection, OfNothingInSight) {
  const Vec3 below(0, 0, -5);
  const test::MovingCloud cloud(8, 25, Measure::projected, true, 4,
                                [&](const Vec3& w) -> std::optional<test::CloudPoint> {
                                  return {{w, Rgb(1), w + below}};
                                });
  Hemisphere ahead;
  const ReprojectionCounts counts = cloud.reproject(ahead);
  EXPECT_EQ(counts.hidden, counts.cells);
  EXPECT_EQ(counts.holes, static_cast<double>(counts.cells));
  EXPECT_EQ(irradiance_of(ahead), Rgb(0));
  EXPECT_EQ(harmonic_distance_m(ahead), kInfinity);
  for (std::size_t i = 0; i < ahead.size(); ++i) EXPECT_NEAR(glm::length(ahead.direction[i]), 1, 1e-5);
}

/// A sheet seen from its front that turns its back: what that looks like is not known.
TEST(Reprojection, LosesWhatTurnsAway) {
  const test::MovingCloud cloud(16, 50, Measure::projected, true, 6,
                                [](const Vec3& w) -> std::optional<test::CloudPoint> {
                                  if (w.x > 0 && w.y > 0) return {{w, Rgb(9), w, -w, w}};
                                  return {{2.f * w, Rgb(1)}};
                                });
  Hemisphere ahead;
  const ReprojectionCounts counts = cloud.reproject(ahead);
  EXPECT_NEAR(static_cast<double>(counts.hidden), static_cast<double>(counts.cells) / 4,
              0.02 * static_cast<double>(counts.cells));
  EXPECT_EQ(counts.holes, static_cast<double>(counts.hidden));
  EXPECT_NEAR(irradiance_of(ahead).y, kPi, 1e-4f);
}

TEST(Reprojection, HugeMotionsAndSizes) {
  const NoFloatTraps traps;  // larger than any scene may be: differences of positions overflow
  for (const float v : {1e6f, 1e18f, 1e30f, 3e38f}) {
    const test::MovingCloud cloud(16, 50, Measure::projected, true, 7,
                                  [&](const Vec3& w) { return golden_scene(w, v); });
    Hemisphere ahead;
    const ReprojectionCounts counts = cloud.reproject(ahead);
    EXPECT_GT(counts.holes, 0);
    EXPECT_TRUE(is_finite(irradiance_of(ahead)));
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      EXPECT_TRUE(is_finite(ahead.direction[i]) && is_finite(ahead.hit_normal[i]));
      EXPECT_GT(ahead.distance_m[i], 0);
    }
  }
}

/// The same bits but for lengths, in other units.
TEST(Reprojection, KnowsNoScale) {
  const auto seen_at = [](float scale) {
    const test::MovingCloud cloud(16, 50, Measure::projected, true, 8, [&](const Vec3& w) {
      auto p = golden_scene(w, 0.1f);
      p->position *= scale;
      if (p->next) *p->next *= scale;
      return p;
    });
    Hemisphere ahead;
    cloud.reproject(ahead, scale * Vec3(0.03f, 0, 0));
    return ahead;
  };
  const Hemisphere one = seen_at(1);
  for (const float scale : {0x1p-20f, 0x1p20f}) {
    Hemisphere other = seen_at(scale);
    for (float& d : other.distance_m) d /= scale;
    expect_same(one, other);
  }
}

/// Rays that escaped keep their directions in the world where the place turns.
TEST(Reprojection, EnvironmentStays) {
  const Vec3 bright = glm::normalize(Vec3(0.3f, 0.2f, 1));
  const test::MovingCloud cloud(32, 100, Measure::projected, true, 9,
                                [](const Vec3&) -> std::optional<test::CloudPoint> { return {}; });
  std::vector<Rgb> radiance;
  for (const Vec3& w : cloud.hemisphere.direction)
    radiance.push_back(Rgb(glm::dot(w, bright) > 0.95f ? 1.f : 0.f));
  const Frame frame = make_frame(glm::normalize(Vec3(0.1f, 0, 1)));
  Hemisphere ahead;
  const ReprojectionCounts counts = reproject(cloud.hemisphere, cloud.hits, radiance,
                                              {cloud.now, cloud.next, cloud.moved}, Vec3(0), frame, ahead);
  // A cap of half angle s about w seen under cos: pi sin^2(s) cos.
  const double truth = std::numbers::pi * (1 - 0.95 * 0.95) * static_cast<double>(glm::dot(bright, frame.z));
  EXPECT_NEAR(irradiance_of(ahead).y, truth, 0.05 * truth);
  EXPECT_GT(counts.hidden, 0u);
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    if (ahead.radiance[i].y > 0) {
      EXPECT_GT(glm::dot(ahead.direction[i], bright), 0.85f);
    }
  }
}

}  // namespace
}  // namespace phos
