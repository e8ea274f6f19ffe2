// Russian roulette keeps the expected flux, whatever the colours, materials and lengths of paths. Batches
// with their own seeds give the standard error (Student's t with 19 degrees of freedom: 6.0 is a probability
// below 1e-5).
#include <gtest/gtest.h>

#include "photon/trace.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr int kBatches = 20;
constexpr double kLimit = 6.0;

struct Estimate {
  DVec3 mean{0}, error{0};
};

template <class Value>
Estimate over_batches(const Scene& scene, std::int64_t paths, const Value& value) {
  const RayScene rays(scene);
  DVec3 sum(0), squares(0);
  for (int seed = 0; seed < kBatches; ++seed) {
    PhotonOptions options;
    options.paths = paths;
    PhotonTotals totals;
    Counters counters;
    const Photons photons = trace_photons(rays, options, static_cast<std::uint64_t>(seed), totals, counters);
    const DVec3 v = value(photons, totals);
    sum += v, squares += v * v;
  }
  const DVec3 mean = sum / double(kBatches);
  const DVec3 variance = glm::max(DVec3(0), squares / double(kBatches) - mean * mean) / double(kBatches - 1);
  return {mean, glm::sqrt(variance)};
}

TEST(Roulette, ColouredBoxKeepsEachChannel) {
  // mean E = P / (A (1 - rho)) holds for each channel by itself.
  test::AnalyticScene s = test::uniform_box(0.5f, 100);
  const Rgb rho(0.9f, 0.5f, 0.1f);
  s.scene.material[0].kd = rho;
  finalize(s.scene);
  const Estimate e = over_batches(s.scene, 5'000, [&](const Photons&, const PhotonTotals& t) {
    return DVec3(t.stored_flux_lm) / s.area_m2;
  });
  for (int c = 0; c < 3; ++c) {
    const double expected = test::closed_room_mean_lx(100, s.area_m2, double(rho[c]));
    EXPECT_NEAR(e.mean[c], expected, kLimit * e.error[c] + 1e-5 * expected) << "channel " << c;
    EXPECT_LT(e.error[c], 0.02 * expected);
  }
}

TEST(Roulette, AbsorbedIsWhatTheSurfacesTake) {
  // Lambert surfaces of reflectance rho take (1 - rho) of what is stored; the rest of the account is noise of
  // the roulette.
  const test::AnalyticScene s = test::uniform_box(0.7f, 100);
  const Estimate e = over_batches(s.scene, 5'000, [&](const Photons&, const PhotonTotals& t) {
    return DVec3(t.absorbed_flux_lm) - 0.3 * DVec3(t.stored_flux_lm);
  });
  EXPECT_NEAR(e.mean.x, 0, kLimit * e.error.x + 1e-3);
  EXPECT_LT(e.error.x, 1);
}

TEST(Roulette, FluxOfStoredPhotonsStaysAboutConstant) {
  const test::AnalyticScene s = test::uniform_box(0.5f, 100);
  const RayScene rays(s.scene);
  PhotonOptions options;
  options.paths = 10'000;
  PhotonTotals totals;
  Counters counters;
  const Photons photons = trace_photons(rays, options, 1, totals, counters);
  for (const Rgb& f : photons.flux) ASSERT_NEAR(double(f.x), 100.0 / 10'000, 1e-5 * 100 / 10'000);
}

TEST(Roulette, GlossyWallsConserveTheirShare) {
  // A Phong wall reflects at most kd + ks; stored flux lies between those of the reflectances kd and kd + ks.
  test::AnalyticScene s = test::uniform_box(0.5f, 100);
  Material& m = s.scene.material[0];
  m.model = Model::phong;
  m.kd = Rgb(0.3f), m.ks = Rgb(0.3f), m.exponent = 20;
  finalize(s.scene);
  const Estimate e = over_batches(s.scene, 2'000, [&](const Photons&, const PhotonTotals& t) {
    return DVec3(t.stored_flux_lm) / s.area_m2;
  });
  EXPECT_GT(e.mean.x + kLimit * e.error.x, test::closed_room_mean_lx(100, s.area_m2, 0.3));
  EXPECT_LT(e.mean.x - kLimit * e.error.x, test::closed_room_mean_lx(100, s.area_m2, 0.6));
  EXPECT_LT(e.error.x, 0.02 * e.mean.x);
}

}  // namespace
}  // namespace phos
