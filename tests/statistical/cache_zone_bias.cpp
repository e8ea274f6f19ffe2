// Biases of zones of photons far below the error of one record.
#include <gtest/gtest.h>

#include "core/octahedral.h"
#include "core/random.h"
#include "core/sampling.h"
#include "support/hand_photons.h"
#include "support/records.h"
#include "support/zone_borders.h"

namespace phos {
namespace {

class ZoneBias : public ::testing::Test {
 protected:
  ZoneBias() : scene_(test::point_light_over_plane()), rays_(scene_.scene) {
    options_.paths = Quantity::indirect;
  }
  double irradiance(const PhotonMap& photons, const Vec3& p, std::uint64_t seed) {
    return static_cast<double>(
        test::record_at(RecordMaker(photons, rays_, options_, seed), p, {0, 1, 0}).irradiance.y);
  }

  test::AnalyticScene scene_;
  RayScene rays_;
  RecordOptions options_;
};

/// The 32nd photon decides how wide a zone for 100 is, and lies in it for certain: if it counted, even light
/// would be 1 % too bright. 4.5 standard errors are 0.5 to 0.6 %; by chance they fail once in 1e5.
TEST_F(ZoneBias, ThePhotonThatDecidesTheRadiusDoesNotCount) {
  constexpr int kZones = 8000;
  constexpr double kDensity = 100 / (std::numbers::pi * 0.25);
  constexpr float kReach_m = 0.9f;
  options_.near_photons = 32, options_.min_photons = 16, options_.max_photons = 100;
  options_.resolve(scene_.scene.bounds.diagonal_m());
  for (const Estimate estimate : {Estimate::hull, Estimate::kernel}) {
    options_.estimate = estimate;
    double sum = 0, squares = 0;
    for (std::uint64_t zone = 0; zone < kZones; ++zone) {
      RandomStream random(31, Stage::test, zone);
      std::vector<Vec3> places;
      const double reach2_m2 = static_cast<double>(kReach_m) * static_cast<double>(kReach_m);
      for (int i = test::poisson(random, kDensity * std::numbers::pi * reach2_m2); i > 0; --i) {
        const Vec2 p = kReach_m * sample_disc(random.uniform2());
        places.push_back({p.x, 0, p.y});
      }
      const double e = irradiance(test::photons_on_floor(places, {0, 1, 0}, 1000), Vec3(0), zone) / kDensity;
      sum += e, squares += e * e;
    }
    const double mean = sum / kZones, error = std::sqrt((squares / kZones - mean * mean) / kZones);
    EXPECT_NEAR(mean, 1, 4.5 * error) << static_cast<int>(estimate);
    EXPECT_LT(error, 1.4e-3) << "cannot tell";
  }
}

/// A lamp 2 m above the floor, photons of equal area each and of the flux that lands there: what is found is
/// the light in the middle, to the fourth order of the zone's radius. Without curvature's own curvature it
/// would be 0.12 to 0.19 % off. Even light tells how much area the photons have.
TEST_F(ZoneBias, CurvatureIsRightToTheFourthOrder) {
  options_.resolve(scene_.scene.bounds.diagonal_m());
  const Vec3 lamp(0, 2, 0);
  for (const auto& [x_m, radius_m] : {std::pair{0.f, 0.4f}, {1.5f, 0.56f}, {2.5f, 0.8f}, {2.8f, 0.9f}}) {
    const Vec3 p(x_m, 0, 0);
    std::vector<Vec3> places;
    for (int i = 0; i < 1500; ++i) {
      const float r = radius_m * std::sqrt((static_cast<float>(i) + 0.5f) / 1000),
                  t = 2.3999632f * static_cast<float>(i);
      places.push_back(p + Vec3(r * std::cos(t), 0, r * std::sin(t)));
    }
    Photons photons;
    for (const Vec3& place : places) {
      const Vec3 way = lamp - place;
      const float d = glm::length(way);
      photons.position.push_back(place), photons.distance.push_back(d);
      photons.flux.push_back(Rgb(way.y / (d * d * d)));
      photons.direction.push_back(encode_octahedral(way / d));
      photons.source_normal.push_back(encode_octahedral(-way / d));
      photons.normal.push_back(encode_octahedral({0, 1, 0}));
      photons.path.push_back(static_cast<std::uint8_t>(PhotonPath::indirect)), photons.bounce.push_back(1);
    }
    PhotonTotals totals;
    totals.emitted = totals.stored = photons.size();
    const double even = irradiance(test::photons_on_floor(places, {0, 1, 0}, 1000), p, 1);
    const double found = irradiance(PhotonMap::build(std::move(photons), totals), p, 1) / even;
    EXPECT_NEAR(found / test::point_over_plane_lx(1, 2, static_cast<double>(x_m)), 1, 8e-4) << x_m;
  }
}

}  // namespace
}  // namespace phos
