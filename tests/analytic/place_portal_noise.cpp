// A room with a window, beside ground and a house that the sky lights: photons that are not aimed at the
// window carry thousands of times as much, and noise within is none of theirs.
#include <gtest/gtest.h>

#include "photon/photon_noise.h"
#include "photon/trace.h"
#include "place/two_level.h"
#include "record/irradiance_cache.h"
#include "scene/opening/find_portals.h"
#include "support/daylight.h"

namespace phos::test {
namespace {

Scene room_in_a_street() {
  Scene scene = room_with_window(0.5f);
  begin_instance(scene, "ground", 0);
  add_quad(scene, {-40, -0.01f, -40}, {0, 0, 80}, {80, 0, 0});
  begin_instance(scene, "house opposite", 0);
  add_quad(scene, {-40, 0, 30}, {0, 20, 0}, {80, 0, 0});
  surround(scene, sky_of("overcast", "", 10000));
  scene.portal = find_portals(RayScene(scene), "auto");
  return scene;
}

}  // namespace

TEST(PortalNoise, IsOfThePhotonsWithin) {
  const Scene scene = room_in_a_street();
  ASSERT_FALSE(scene.portal.empty());
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = 200000;
  PhotonTotals totals;
  Counters counters;
  const PhotonMap map = PhotonMap::build(trace_photons(rays, options, 1, totals, counters), totals);
  double squares = 0, sum = 0, heaviest = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map.path[i] == static_cast<std::uint8_t>(PhotonPath::direct)) continue;
    const auto lm = static_cast<double>(luminance(map.flux[i]));
    heaviest = std::max(heaviest, lm);
    const Vec3 p = map.position[i], n = decode_octahedral(map.normal[i]);
    const bool on_floor = std::fabs(p.y) < 1e-4f && n.y > 0.5f;
    if (on_floor && p.x > 0 && p.x < 5 && p.z > 0 && p.z < 4) sum += lm, squares += lm * lm;
  }
  const double within_lm = squares / sum;
  const PhotonNoise noise = photon_noise(map, false);
  EXPECT_GT(heaviest, 1e4 * within_lm) << "else this tests nothing";
  // A few that come in from the street carry more than most.
  EXPECT_LT(noise.photon_lm, within_lm);
  EXPECT_GT(noise.photon_lm, within_lm / 10);
}

TEST(PortalNoise, OfRecordsIsThatOfTheUsualOnes) {
  std::vector<IrradianceRecord> records(100);
  for (std::size_t i = 0; i < records.size(); ++i) {
    IrradianceRecord& r = records[i];
    r.radius_m = 1, r.irradiance = Rgb(100 + static_cast<float>(i)), r.stderr_lx = Rgb(5);
  }
  const EquivalentPhotons usual = equivalent_photons(records, 0.5);
  double lux = 0, lux2 = 0;
  for (const IrradianceRecord& r : records)
    lux += static_cast<double>(r.irradiance.x), lux2 += std::pow(static_cast<double>(r.irradiance.x), 2);
  EXPECT_NEAR(usual.photon_lm, 0.25 * std::numbers::pi * 100 * 25 / lux, 1e-6);
  EXPECT_NEAR(usual.of_a_zone, lux2 / (100 * 25), 1e-6 * lux2);
  for (int i = 0; i < 10; ++i) {
    records.emplace_back(records.front());
    records.back().irradiance = Rgb(10000), records.back().stderr_lx = Rgb(5000);
  }
  EXPECT_NEAR(equivalent_photons(records, 0.5).photon_lm, usual.photon_lm, 1e-6);
  EXPECT_EQ(usual.common, 0);
}

/// Errors that are three times as large, for what all have in common: alone, photons tell the same.
TEST(PortalNoise, OfRecordsIsPartlyCommon) {
  std::vector<IrradianceRecord> records(100);
  for (std::size_t i = 0; i < records.size(); ++i) {
    IrradianceRecord& r = records[i];
    r.radius_m = 1 + 0.01f * static_cast<float>(i), r.irradiance = Rgb(100), r.stderr_lx = Rgb(5);
  }
  const EquivalentPhotons alone = equivalent_photons(records, 0.5);
  for (IrradianceRecord& r : records) r.stderr_lx = Rgb(15), r.shared = (kSharedByZones + 8) / 9;
  const EquivalentPhotons common = equivalent_photons(records, 0.5);
  EXPECT_NEAR(common.photon_lm, alone.photon_lm, 1e-5 * alone.photon_lm);
  EXPECT_NEAR(common.of_a_zone, alone.of_a_zone, 1e-5 * alone.of_a_zone);
  EXPECT_EQ(alone.common, 0);
  EXPECT_NEAR(common.common, 8 * 0.05 * 0.05, 1e-6);
}

}  // namespace phos::test
