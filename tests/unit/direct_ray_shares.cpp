// Rays for a stated error: the fewest in all, checked against other ways to share them.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "direct/ray_shares.h"

namespace phos {
namespace {

double variance_of(const PilotNoise& lamp, double rays) {
  return lamp.variance_lx2 * std::pow(lamp.rays / rays, kNoiseFall);
}

double variance_of(const std::vector<PilotNoise>& lamps, const std::vector<double>& rays) {
  double sum = 0;
  for (std::size_t i = 0; i < lamps.size(); ++i) sum += variance_of(lamps[i], rays[i]);
  return sum;
}

TEST(RayShares, MeetTheErrorWithTheFewestRays) {
  const std::vector<PilotNoise> lamps{{400, 64, 1, false}, {1, 16, 1, false}, {25, 64, 1, false}};
  for (const double stderr_lx : {2.0, 0.5, 0.1}) {
    const std::vector<int> rays = share_rays(lamps, stderr_lx, 1 << 30);
    const std::vector<double> found(rays.begin(), rays.end());
    const double variance = variance_of(lamps, found), n = std::accumulate(found.begin(), found.end(), 0.0);
    EXPECT_LE(variance, stderr_lx * stderr_lx);
    EXPECT_GT(variance, 0.8 * stderr_lx * stderr_lx);
    // As many rays, some of them moved from one lamp to another, leave more error.
    for (std::size_t from = 0; from < 3; ++from)
      for (std::size_t to = 0; to < 3; ++to) {
        std::vector<double> other = found;
        const double moved = 0.3 * found[from] + 1;
        other[from] -= moved, other[to] += moved;
        if (from == to || other[from] < 1) continue;
        EXPECT_GT(variance_of(lamps, other), variance) << n;
      }
  }
}

TEST(RayShares, KeepToTheirLimits) {
  const std::vector<PilotNoise> lamps{{0, 64, 16, true}, {100, 64, 16, true}, {1e-9, 64, 16, false}};
  EXPECT_EQ(share_rays(lamps, 0, 4096), (std::vector<int>{16, 4096, 4096}));
  EXPECT_EQ(share_rays(lamps, 1e9, 4096), (std::vector<int>{16, 16, 16}));
  EXPECT_EQ(share_rays({}, 1, 4096), std::vector<int>());
}

/// Sets of 4^k for what they are to leave; between them more points than the power law says.
TEST(RayShares, SobolPointsComeInSets) {
  EXPECT_EQ(sobol_set(64), 64);
  EXPECT_EQ(sobol_set(65), 96);
  EXPECT_EQ(sobol_set(100), 128);
  EXPECT_EQ(sobol_set(150), 192);
  EXPECT_EQ(sobol_set(192), 256);
  EXPECT_EQ(sobol_set(1), 2);
  for (double n = 1; n < 4096; n *= 1.07) EXPECT_GE(sobol_set(n), n);
  for (double n = 16; n < 4096; n *= 1.07) EXPECT_LE(sobol_set(n), 1.8 * n) << n;
}

}  // namespace
}  // namespace phos
