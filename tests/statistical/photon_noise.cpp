// The noise that all photons have in common, against repeats.
#include <gtest/gtest.h>

#include <cmath>

#include "photon/photon_noise.h"
#include "photon/trace.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// Of a closed room, where each path leaves a number of photons that only roulette decides: how far the flux
/// of all of them varies.
TEST(PhotonNoise, IsThatOfAllFluxTogether) {
  constexpr int kSeeds = 200;
  for (const float albedo : {0.5f, 0.9f, 0.99f}) {
    const AnalyticScene s = furnace(albedo);
    const RayScene rays(s.scene);
    PhotonOptions options;
    options.paths = 400;
    double mean = 0, squares = 0, stated = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      PhotonTotals totals;
      Counters counters;
      const PhotonMap map = PhotonMap::build(trace_photons(rays, options, seed, totals, counters), totals);
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

}  // namespace
}  // namespace phos::test
