// Blinds: which ones are found, and which part of the sky a place sees between their slats.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/opening/find_blinds.h"
#include "support/blinds.h"
#include "support/environment.h"

using namespace phos;
using namespace phos::test;

namespace {

std::vector<Blind> found_in(const BlindRoom& room, bool window = true) {
  Scene scene = room.scene(window);
  surround(scene, constant_map(8, Rgb(1000)));
  return find_blinds(RayScene(scene));
}

}  // namespace

TEST(Blinds, AreFoundBeforeTheSky) {
  for (const float tilt_rad : {0.f, 0.5f, -0.5f}) {
    const std::vector<Blind> blinds = found_in({.tilt_rad = tilt_rad});
    ASSERT_EQ(blinds.size(), 1u) << tilt_rad;
    EXPECT_EQ(blinds[0].size(), 20u);
    const Blind::Slats& slats = blinds[0].slats();
    EXPECT_NEAR(slats.to_m - slats.from_m, 2, 1e-6);
    EXPECT_TRUE(slats.frame.z.z > 0 ? slats.sky_against_z : slats.sky_towards_z);
    EXPECT_FALSE(slats.frame.z.z > 0 ? slats.sky_towards_z : slats.sky_against_z) << "into the room";
  }
  EXPECT_TRUE(found_in({}, false).empty()) << "no sky";
  EXPECT_TRUE(found_in({.slats = 2}).empty());
  EXPECT_TRUE(found_in({.slats = 4}).empty()) << "too far from each other";
}

/// In a gap is what no slat hides, exactly.
TEST(Blinds, GapsAreWhatSlatsDoNotHide) {
  for (const float tilt_rad : {0.f, 0.5f, -0.5f}) {
    const BlindRoom room{.tilt_rad = tilt_rad};
    const std::vector<Blind> blinds = found_in(room);
    ASSERT_EQ(blinds.size(), 1u);
    int seen = 0;
    for (const Vec3& place : {Vec3(2, 0.8f, 1.5f), Vec3(0.5f, 1.7f, 4), Vec3(2, 2.5f, 0.3f)}) {
      std::vector<Blind::Gap> gaps;
      blinds[0].gaps_from(place, gaps);
      RandomStream random(1, Stage::pilot, 0);
      for (int k = 0; k < 4000; ++k) {
        const Vec2 u = random.uniform2();
        // Between the middles of the lowest and the highest slat, so that they are all gaps.
        const Vec3 at(1.02f + 1.96f * u.x, 0.95f + 1.4f * u.y, 0.06f);
        const Vec3 d = glm::normalize(at - place);
        const auto in = std::count_if(gaps.begin(), gaps.end(),
                                      [&](const Blind::Gap& g) { return blinds[0].density(g, d) > 0; });
        EXPECT_LE(in, 1);
        seen += in > 0;
        // Slats shade the window's edge; a line by the ends of the slats is no gap's.
        const DVec3 p(place), w(d);
        const auto x_at = [&](double z_m) { return p.x + (z_m - p.z) / w.z * w.x; };
        if (std::min(x_at(0.02), x_at(0.1)) < 1.001 || std::max(x_at(0.02), x_at(0.1)) > 2.999) continue;
        bool hidden = false;
        for (int s = 0; s < room.slats && !hidden; ++s) {
          const BlindRoom::Edges e = room.slat(s);
          const auto side = [&](const DVec3& q) { return w.z * (q.y - p.y) - w.y * (q.z - p.z); };
          hidden = side(e.outer) * side(e.inner) < 0;
        }
        EXPECT_EQ(in > 0, !hidden) << tilt_rad << " " << k;
      }
    }
    EXPECT_GT(seen, 500);
  }
}

/// The mean of 1 / density is the solid angle; directions lie within.
TEST(Blinds, DirectionsFillTheGapEvenly) {
  const std::vector<Blind> blinds = found_in({});
  ASSERT_EQ(blinds.size(), 1u);
  const Blind& blind = blinds[0];
  std::vector<Blind::Gap> gaps;
  blind.gaps_from({0.5f, 1.2f, 0.8f}, gaps);
  ASSERT_GT(gaps.size(), 10u);
  for (const Blind::Gap& gap : gaps) {
    // By Gauss: the angle of the box u, v is a sum of arc tangents at its corners.
    const auto corner = [](double u, double v) { return std::atan2(u * v, std::sqrt(1 + u * u + v * v)); };
    const double truth_sr = corner(gap.u[1], gap.v[1]) - corner(gap.u[0], gap.v[1]) -
                            corner(gap.u[1], gap.v[0]) + corner(gap.u[0], gap.v[0]);
    EXPECT_NEAR(gap.solid_angle_sr(), truth_sr, 0.01 * truth_sr);
    double sum = 0, least = 1e30, most = 0;
    constexpr int kDirections = 1000;
    for (int k = 0; k < kDirections; ++k) {
      const Vec3 d = blind.sample(gap, r2_point(k, Vec2(0.5f)));
      EXPECT_NEAR(glm::length(d), 1, 1e-6);
      const double density = blind.density(gap, d, true);
      ASSERT_GT(density, 0);
      sum += 1 / density, least = std::min(least, density), most = std::max(most, density);
    }
    EXPECT_NEAR(sum / kDirections, truth_sr, 1e-3 * truth_sr);
    EXPECT_LT(most, 1.2 * least);
  }
}
