// What the paths of photons tell of their noise.
#include <gtest/gtest.h>

#include "photon/photon_noise.h"

namespace phos {
namespace {

/// `paths` paths that leave `each` photons, the first of them direct.
PhotonMap paths_of(int paths, int each, float flux_lm, bool families = false) {
  Photons p;
  PhotonTotals totals;
  totals.emitted = static_cast<std::uint64_t>(paths);
  for (int i = 0; i < paths; ++i) {
    for (int b = 0; b < each; ++b) {
      p.position.emplace_back(static_cast<float>(i), static_cast<float>(b), 0.f);
      p.flux.emplace_back(flux_lm);
      p.direction.push_back(0), p.normal.push_back(0), p.source_normal.push_back(0);
      p.distance.push_back(1);
      p.path.push_back(static_cast<std::uint8_t>(b == 0 ? PhotonPath::direct : PhotonPath::indirect));
      p.bounce.push_back(static_cast<std::uint8_t>(b));
      if (families) p.family.push_back(static_cast<std::uint32_t>(i));
    }
  }
  totals.stored = p.size();
  return PhotonMap::build(std::move(p), totals);
}

/// Of N photons on each of n paths there are n N (N - 1) pairs; their number is certain but for the -1 / (n
/// N) that one photon's own noise brings.
TEST(PhotonNoise, CountsPairsOfAPath) {
  constexpr int kPaths = 50, kEach = 8;
  const PhotonMap map = paths_of(kPaths, kEach, 0.25f);
  const PhotonNoise all = photon_noise(map, true), indirect = photon_noise(map, false);
  EXPECT_EQ(all.photons, kPaths * kEach);
  EXPECT_NEAR(all.photon_lm, 0.25, 1e-6);
  EXPECT_NEAR(all.pairs, double(kEach - 1) / (kPaths * kEach), 1e-12);
  EXPECT_NEAR(all.common, -1.0 / (kPaths * kEach), 1e-12);
  EXPECT_EQ(indirect.photons, kPaths * (kEach - 1));
  EXPECT_NEAR(indirect.pairs, double(kEach - 2) / (kPaths * (kEach - 1)), 1e-12);
  EXPECT_EQ(all.spread(400), 1);  // each path leaves as many, each time
}

/// Photons that carry alike: the same, whether their bounces or their families tell of their paths.
TEST(PhotonNoise, CountsPairsOfAFamily) {
  for (const bool direct : {true, false}) {
    const PhotonNoise bounces = photon_noise(paths_of(50, 8, 0.25f), direct),
                      families = photon_noise(paths_of(50, 8, 0.25f, true), direct);
    EXPECT_NEAR(families.pairs, bounces.pairs, 1e-12);
    EXPECT_NEAR(families.common, bounces.common, 1e-12);
    EXPECT_EQ(families.photon_lm, bounces.photon_lm);
  }
  EXPECT_EQ(photon_noise(paths_of(50, 1, 0.25f, true), true).pairs, 0);
  EXPECT_EQ(photon_noise(paths_of(50, 8, 0, true), true).pairs, 0);
}

TEST(PhotonNoise, SpreadIsWhatPathsOfUnlikeLengthsAdd) {
  PhotonNoise noise;
  noise.pairs = 0.03, noise.common = 0.02;  // of 100 paths
  EXPECT_EQ(noise.spread(0), 1);
  EXPECT_DOUBLE_EQ(noise.spread(50), 2);
}

TEST(PhotonNoise, OfNoPhotonsThereIsNone) {
  const PhotonNoise none = photon_noise(PhotonMap::build({}, {}), true);
  EXPECT_EQ(none.photons, 0);
  EXPECT_EQ(none.photon_lm, 0);
  EXPECT_EQ(none.common, 0);
  EXPECT_EQ(none.spread(10), 1);
  EXPECT_EQ(photon_noise(paths_of(3, 1, 0), true).photon_lm, 0);
}

}  // namespace
}  // namespace phos
