// The classical disc of photons, photon by photon.
#include <gtest/gtest.h>

#include <numbers>

#include "reference/map/photon_discs.h"
#include "support/hand_photons.h"

namespace phos::test {
namespace {

SurfacePoint on_floor(const Vec3& p) {
  SurfacePoint point;
  point.position = p;
  point.geometric_normal = point.smooth_normal = point.normal = {0, 1, 0};
  return point;
}

constexpr double kPiExactly = std::numbers::pi;

TEST(PhotonDiscs, CountThePhotonsWithinTheLast) {
  const PhotonMap map =
      photons_on_floor({{0.1f, 0, 0}, {0, 0, 0.2f}, {-0.3f, 0, 0}, {0, 0, 0.5f}, {2, 0, 0}});
  const DiscIrradiance light = PhotonDiscs(map, 4).irradiance(on_floor({0, 0, 0}));
  const double one = 1 / (kPiExactly * 0.25);
  EXPECT_NEAR(double(light.irradiance_lx.x), 3 * one, 1e-5 * one);
  EXPECT_NEAR(double(light.noise_lx.x), std::sqrt(3.0) * one, 1e-5 * one);
  EXPECT_FLOAT_EQ(PhotonDiscs(map, 4).radius_m({0, 0, 0}), 0.5f);
}

TEST(PhotonDiscs, HoldAllPhotonsWhereTheyAreFewer) {
  const PhotonMap map = photons_on_floor({{0.1f, 0, 0}, {0, 0, 0.2f}, {-0.3f, 0, 0}});
  const DiscIrradiance light = PhotonDiscs(map, 100).irradiance(on_floor({0, 0, 0}));
  EXPECT_NEAR(double(light.irradiance_lx.x), 2 / (kPiExactly * 0.09), 1e-4);
}

TEST(PhotonDiscs, AreDarkWithoutPhotons) {
  for (const PhotonMap& map : {photons_on_floor({}), photons_on_floor({{1, 0, 0}})}) {
    const DiscIrradiance light = PhotonDiscs(map, 2).irradiance(on_floor({0, 0, 0}));
    EXPECT_EQ(light.irradiance_lx, Rgb(0));
    EXPECT_EQ(light.noise_lx, Rgb(0));
  }
  EXPECT_EQ(PhotonDiscs(photons_on_floor({}), 2).radius_m({0, 0, 0}), kInfinity);
}

TEST(PhotonDiscs, LeaveOutLightFromBehind) {
  const PhotonMap map = photons_on_floor({{0.1f, 0, 0}, {0, 0, 0.2f}, {0.3f, 0, 0}}, {0, -1, 0});
  EXPECT_EQ(PhotonDiscs(map, 3).irradiance(on_floor({0, 0, 0})).irradiance_lx, Rgb(0));
}

/// Photons that all lie on the point itself are as near as its rounding error tells.
TEST(PhotonDiscs, AreFiniteWhereAllPhotonsCoincide) {
  const PhotonMap map = photons_on_floor({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  SurfacePoint point = on_floor({1, 0, 0});
  point.error_m = 1e-3f;
  const double lux = double(PhotonDiscs(map, 3).irradiance(point).irradiance_lx.x);
  EXPECT_NEAR(lux, 2 / (kPiExactly * 1e-6), 1e-4 * lux);
}

}  // namespace
}  // namespace phos::test
