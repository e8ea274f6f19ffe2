// Radiance from photons where there are none, few, or all in one place; scenes of any size, lamps of any
// strength: a right answer or a counted event, and always finite.
#include "estimate/radiance_density.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "support/hand_photons.h"
#include "support/radiance_scenes.h"
#include "support/records.h"

namespace phos {
namespace {

constexpr int kOrder = 10;

/// A floor of 16 m, and photons of 1 lm put on it by hand.
class DensityZones : public ::testing::Test {
 protected:
  DensityZones() : scene_(test::point_light_over_plane()), rays_(scene_.scene) {}

  RadianceRecord record(const PhotonMap& map, const RecordSite& site = {Vec3(0), {0, 1, 0}, 0}) {
    RecordOptions options;
    options.resolve(scene_.scene.bounds.diagonal_m() / 4);
    const RadianceDensityEstimator estimator(map, rays_, options, kOrder, RadianceGradient::analytic, 1);
    const auto worker = estimator.make_worker();
    const Made made = estimator.make(site, *worker);
    counters_.merge(worker->counters);
    const RadianceRecord r = *made.radiance;
    EXPECT_TRUE(is_finite(r));
    EXPECT_EQ(r.order(), kOrder);
    EXPECT_TRUE(r.radius_m > 0 && r.radius_m == made.record.radius_m);
    EXPECT_LE(made.least_radius_m, r.radius_m);
    // Irradiance is that of irradiance records, whatever the zone.
    const DensityEstimator maker(map, rays_, options, 1);
    const auto other = maker.make_worker();
    const IrradianceRecord e = maker.make(site, *other).record;
    EXPECT_NEAR(made.record.irradiance.y, e.irradiance.y, 1e-5f * e.irradiance.y);
    EXPECT_NEAR(made.record.stderr_lx.y, e.stderr_lx.y, 0.3f * e.stderr_lx.y);
    return r;
  }

  test::AnalyticScene scene_;
  RayScene rays_;
  Counters counters_;
};

TEST_F(DensityZones, WithoutPhotonsThereIsDarkThatIsCounted) {
  const RadianceRecord none = record(test::photons_on_floor({}));
  EXPECT_EQ(test::norm(test::channel(none.light)), 0);
  EXPECT_EQ(test::norm(test::channel(none.stderr_light)), 0) << "nothing is known of what a photon carries";
  const RadianceRecord far = record(test::photons_on_floor({{-7, 0, -7}}));
  EXPECT_EQ(test::norm(test::channel(far.light)), 0);
  EXPECT_GT(far.stderr_light[1], 0) << "one photon could have come";
  EXPECT_EQ(counters_["records without photons"], 2u);
}

TEST_F(DensityZones, OnePhotonIsALobeTowardsIt) {
  const RadianceRecord r = record(test::photons_on_floor({{0.1f, 0, 0}}, {1, 2, 0}));
  EXPECT_EQ(counters_["records with too few photons"], 1u);
  const std::vector<double> light = test::channel(r.light);
  const Vec3 w = r.frame.to_local(glm::normalize(Vec3(1, 2, 0)));
  const double there = reconstruct(light, BasisKind::hsh, double(w.x), double(w.y), double(w.z));
  EXPECT_GT(there, 0);
  EXPECT_LT(std::fabs(reconstruct(light, BasisKind::hsh, double(-w.x), double(-w.y), double(w.z))),
            0.1 * there);
  EXPECT_FLOAT_EQ(irradiance_of(r).stderr_lx.y, irradiance_of(r).irradiance.y);
}

TEST_F(DensityZones, CollinearAndCoincident) {
  std::vector<Vec3> line;
  for (int i = -200; i < 200; ++i) line.push_back({0.002f * static_cast<float>(i), 0, 0.1f});
  EXPECT_GT(irradiance_of(record(test::photons_on_floor(line))).irradiance.y, 0);
  EXPECT_GT(counters_["records with degenerate hull"], 0u);
  for (const Vec3& place : {Vec3(0.05f, 0, 0.02f), Vec3(0)})
    EXPECT_GT(irradiance_of(record(test::photons_on_floor(std::vector<Vec3>(500, place)))).irradiance.y, 0);
}

TEST_F(DensityZones, ItsOwnPhotonCountsAsItsCandidatesAreMany) {
  const PhotonMap two = test::photons_on_floor({Vec3(0), Vec3(0)});
  const auto seated = [](float tried) { return RecordSite{Vec3(0), {0, 1, 0}, 0, 1, tried}; };
  const RadianceRecord both = record(two), other = record(two, seated(0)), all = record(two, seated(1e6f));
  EXPECT_NEAR(other.light[1] / both.light[1], 0.5f, 1e-5f);
  EXPECT_NEAR(all.light[1] / both.light[1], 1.f, 1e-5f);
  const RecordSite alone{Vec3(0), {0, 1, 0}, 0, 0, 0};
  const RadianceRecord dark = record(test::photons_on_floor({Vec3(0)}), alone);
  EXPECT_EQ(test::norm(test::channel(dark.light)), 0);
  EXPECT_GT(dark.stderr_light[0], 0);
}

/// Photons along the horizon, whose inverse cosines are beyond bounds.
TEST_F(DensityZones, GrazingPhotonsWeighNoMoreThanOthers) {
  std::vector<Vec3> places;
  RandomStream random(44, Stage::test, 0);
  for (std::uint32_t i = 0; i < 300; ++i) {
    random.start_bounce(i);
    const Vec2 p = 2.f * sample_disc(random.uniform2());
    places.push_back({p.x, 0, p.y});
  }
  // From far away: light of a lamp nearby would not be even.
  const RadianceRecord up = record(test::photons_on_floor(places, {0, 1, 0}, 1000)),
                       along = record(test::photons_on_floor(places, {1, 2e-4f, 0}, 1000));
  EXPECT_NEAR(irradiance_of(along).irradiance.y, irradiance_of(up).irradiance.y,
              0.02f * irradiance_of(up).irradiance.y);
  // 1 / least eigenvalue of the fit, against that of light from above.
  EXPECT_LT(test::norm(test::channel(along.light)), 100 * test::norm(test::channel(up.light)));
}

RadianceRecord in_box(const Scene& scene, const Vec3& p, const Vec3& n) {
  const test::Lit lit = test::light_up(scene, 20'000);
  RecordOptions options;
  options.resolve(scene.bounds.diagonal_m() / 4);
  const RadianceDensityEstimator estimator(lit.photons, *lit.rays, options, kOrder,
                                           RadianceGradient::analytic, 1);
  const auto worker = estimator.make_worker();
  return *estimator.make({p, n, 1}, *worker).radiance;
}

/// A room of a millionth and of a million times the size: the same light, slopes by the inverse.
TEST(RadianceDensity, ScenesOfAnySize) {
  const Scene room = test::uniform_box(0.5f).scene;
  const Vec3 p(0.5f, 0, 0.4f), n(0, 1, 0);
  const RadianceRecord expected = in_box(room, p, n);
  for (const float factor : {1e-6f, 1e6f}) {
    const RadianceRecord r = in_box(test::scaled(room, factor), factor * p, n);
    const auto relative = [&](std::vector<float> a, const std::vector<float>& b, float unit) {
      for (float& x : a) x *= unit;
      return test::distance(test::channel(a), test::channel(b)) / test::norm(test::channel(b));
    };
    EXPECT_LT(relative(r.light, expected.light, 1), 0.02) << factor;
    EXPECT_LT(relative(r.gradient_x, expected.gradient_x, factor), 0.05) << factor;
    EXPECT_LT(relative(r.stderr_light, expected.stderr_light, 1), 0.02) << factor;
    EXPECT_NEAR(r.radius_m / factor, expected.radius_m, 0.02f * expected.radius_m) << factor;
  }
}

/// Lamps of 1e-12 and 1e12 of the power.
TEST(RadianceDensity, LightOfAnyStrength) {
  const test::AnalyticScene room = test::uniform_box(0.5f);
  const Vec3 p(0.5f, 0, 0.4f), n(0, 1, 0);
  const RadianceRecord expected = in_box(room.scene, p, n);
  const auto times = [&](float factor) {
    Scene scene = room.scene;
    for (Light& light : scene.light) light.intensity *= factor;
    finalize(scene);
    return scene;
  };
  for (const float factor : {1e-12f, 1e12f}) {
    const RadianceRecord r = in_box(times(factor), p, n);
    for (std::size_t i = 0; i < r.light.size(); ++i)
      EXPECT_NEAR(r.light[i] / factor, expected.light[i], 1e-4f * expected.light[0]);
    EXPECT_NEAR(r.radius_m, expected.radius_m, 1e-3f * expected.radius_m);
  }
}

/// Depends on the site alone: the same bytes in any order and from any thread.
TEST(RadianceDensity, SameForAnyThreads) {
  const test::Lit lit = test::light_up(test::uniform_box(0.5f).scene, 20'000);
  RecordOptions options;
  options.resolve(lit.scene->bounds.diagonal_m() / 4);
  const RadianceDensityEstimator estimator(lit.photons, *lit.rays, options, 6, RadianceGradient::analytic, 1);
  constexpr std::size_t kSites = 40;
  const auto site = [](std::size_t i) {
    return RecordSite{{0.1f + 0.04f * static_cast<float>(i), 0, 0.7f}, {0, 1, 0}, i};
  };
  std::vector<RadianceRecord> records(kSites);
  parallel_for(kSites, 1, [&](std::size_t i) {
    const auto worker = estimator.make_worker();
    records[i] = *estimator.make(site(i), *worker).radiance;
  });
  const auto worker = estimator.make_worker();
  for (std::size_t i = kSites; i-- > 0;) {
    const RadianceRecord again = *estimator.make(site(i), *worker).radiance;
    EXPECT_EQ(again.light, records[i].light);
    EXPECT_EQ(again.gradient_x, records[i].gradient_x);
    EXPECT_EQ(again.stderr_light, records[i].stderr_light);
    EXPECT_EQ(again.radius_m, records[i].radius_m);
  }
}

TEST(RadianceDensity, OrdersOutOfRangeAreRefused) {
  const test::Lit lit = test::light_up(test::uniform_box(0.5f).scene, 100);
  RecordOptions options;
  options.resolve(lit.scene->bounds.diagonal_m() / 4);
  for (const int order : {0, -1, 31}) {
    EXPECT_THROW(RadianceDensityEstimator(lit.photons, *lit.rays, options, order, RadianceGradient::none, 1),
                 Error);
    EXPECT_THROW(PhotonProjector{order}, Error);
  }
}

}  // namespace
}  // namespace phos
