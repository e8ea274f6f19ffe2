// The noise that all photons have in common, against repeats.
#include <gtest/gtest.h>

#include <cmath>

#include "photon/photon_noise.h"
#include "photon/trace.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr int kSeeds = 200;

PhotonMap traced(const RayScene& rays, std::uint64_t seed) {
  PhotonOptions options;
  options.paths = 400;
  PhotonTotals totals;
  Counters counters;
  return PhotonMap::build(trace_photons(rays, options, seed, totals, counters), totals);
}

/// Of a closed room, where each path leaves a number of photons that only roulette decides: how far the flux
/// of all of them varies.
TEST(PhotonNoise, IsThatOfAllFluxTogether) {
  for (const float albedo : {0.5f, 0.9f, 0.99f}) {
    const AnalyticScene s = furnace(albedo);
    const RayScene rays(s.scene);
    double mean = 0, squares = 0, stated = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const PhotonMap map = traced(rays, seed);
      double flux = 0;
      for (std::size_t i = 0; i < map.size(); ++i)
        if (map.path[i] != static_cast<std::uint8_t>(PhotonPath::direct))
          flux += static_cast<double>(map.flux[i].y);
      mean += flux / kSeeds, squares += flux * flux / kSeeds;
      const PhotonNoise noise = photon_noise(map, false);
      // One photon's own noise is apart from what paths make of it.
      stated += (noise.common + 1 / noise.photons) / kSeeds;
    }
    const double relative = std::sqrt(squares - mean * mean) / mean;
    EXPECT_NEAR(relative / std::sqrt(stated), 1, 3.5 / std::sqrt(2.0 * kSeeds)) << albedo;
  }
}

/// Of half of that room: what a zone's own photons, their number and its common noise make of it.
TEST(PhotonNoise, IsThatOfTheLightOfAZone) {
  for (const float albedo : {0.9f, 0.99f}) {
    const AnalyticScene s = furnace(albedo);
    const RayScene rays(s.scene);
    const float middle = s.scene.bounds.centre().x;
    double mean = 0, squares = 0, stated = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const PhotonMap map = traced(rays, seed);
      double flux = 0, own = 0, photons = 0;
      for (std::size_t i = 0; i < map.size(); ++i) {
        if (map.path[i] == static_cast<std::uint8_t>(PhotonPath::direct) || map.position[i].x > middle)
          continue;
        const auto one = static_cast<double>(map.flux[i].y);
        flux += one, own += one * one, photons += 1;
      }
      mean += flux / kSeeds, squares += flux * flux / kSeeds;
      stated += own * photon_noise(map, false).spread(photons) / kSeeds;
    }
    EXPECT_NEAR(std::sqrt((squares - mean * mean) / stated), 1, 3.5 / std::sqrt(2.0 * kSeeds)) << albedo;
  }
}

}  // namespace
}  // namespace phos::test
