// The stated error of photons that one path sends through a portal by the hundred, against repeats.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "estimate/density.h"
#include "photon/trace.h"
#include "record/blend.h"
#include "scene/opening/find_portals.h"
#include "support/daylight.h"
#include "support/records.h"

namespace phos::test {
namespace {

constexpr int kSeeds = 60;

/// A room beside bright ground, which lights its ceiling through the window.
Scene room_beside_ground() {
  Scene scene = room_with_window(0.5f);
  begin_instance(scene, "ground", add_lambert(scene, "bright", 0.8f));
  add_quad(scene, {-2, -0.01f, 4.01f}, {0, 0, 8}, {9, 0, 0});
  surround(scene, sky_of("overcast", "", 10000));
  scene.portal = find_portals(RayScene(scene), "auto");
  return scene;
}

struct Repeated {
  double mean = 0, squares = 0;
  double stated2 = 0;  ///< mean square of the stated error
  double alone2 = 0;   ///< of the part that others do not share: what photons tell one by one
  void add(const IrradianceRecord& r) {
    const auto lux = static_cast<double>(luminance(r.irradiance)),
               error = static_cast<double>(luminance(r.stderr_lx));
    mean += lux / kSeeds, squares += lux * lux / kSeeds, stated2 += error * error / kSeeds;
    alone2 += error * error * static_cast<double>((1 - r.shared) / (1 - kSharedByZones)) / kSeeds;
  }
  double variance() const { return (squares - mean * mean) * kSeeds / (kSeeds - 1); }
};

/// Where the light of the ground falls straight, where it is reflected once more, and where little of it is.
TEST(PortalNoise, IsStatedWherePhotonsAreOfOnePath) {
  const Scene scene = room_beside_ground();
  ASSERT_FALSE(scene.portal.empty());
  const RayScene rays(scene);
  const std::array<Check, 4> places{Check{{2.5f, 3, 3}, {0, -1, 0}}, Check{{2.5f, 3, 1.5f}, {0, -1, 0}},
                                    Check{{0, 2.5f, 2}, {1, 0, 0}}, Check{{2.5f, 0, 1}, {0, 1, 0}}};
  std::array<Repeated, 4> hull, kernel;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PhotonOptions traced;
    traced.paths = 20000;
    PhotonTotals totals;
    Counters counters;
    const PhotonMap map = PhotonMap::build(trace_photons(rays, traced, seed, totals, counters), totals);
    ASSERT_EQ(map.family.size(), map.size());
    RecordOptions options;
    options.resolve(1);
    const DensityEstimator by_hull(map, rays, options, seed);
    options.estimate = Estimate::kernel;
    const DensityEstimator by_kernel(map, rays, options, seed);
    for (std::size_t i = 0; i < places.size(); ++i) {
      hull[i].add(record_at(by_hull, places[i].position, places[i].normal, i));
      kernel[i].add(record_at(by_kernel, places[i].position, places[i].normal, i));
    }
  }
  // A variance that few paths make is known to a quarter.
  for (const auto& [way, found] : {std::pair("hull", hull), std::pair("kernel", kernel)})
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double ratio = std::sqrt(found[i].variance() / found[i].stated2);
      EXPECT_GT(ratio, 0.65) << way << ' ' << i << " of " << found[i].mean << " lx";
      EXPECT_LT(ratio, 1.4) << way << ' ' << i << " of " << found[i].mean << " lx";
      const double alone = std::sqrt(found[i].variance() / found[i].alone2);
      RecordProperty(text(way, "_", i), text(ratio, "; photon by photon ", alone));
    }
  EXPECT_GT(std::sqrt(hull[0].variance() / hull[0].alone2), 1.6) << "else this tests nothing";
}

}  // namespace
}  // namespace phos::test
