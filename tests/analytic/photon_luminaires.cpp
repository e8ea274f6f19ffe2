// Photons of measured luminaires: all of the lumens, where the intensities send them.
#include <gtest/gtest.h>

#include "photon/emission.h"
#include "photon/trace.h"
#include "support/chi2.h"
#include "support/luminaires.h"

namespace phos::test {
namespace {

using Form = LuminousOpening::Form;

Formula uneven() {
  return {[](double c, double g) {
            return (20 + c * (360 - c) / 324) * (1 + std::cos(g * std::numbers::pi / 90));
          },
          15, 5, 180};
}
std::vector<LuminousOpening> openings() {
  return {{},
          {Form::box, {0.6f, 0.3f, 0.1f}},
          {Form::box, {0.6f, 0.3f, 0}},
          {Form::ellipsoid, {0.3f, 0.2f, 0.3f}},
          {Form::cylinder_y, {0.1f, 0.6f, 0.1f}}};
}

/// A black closed room absorbs each photon where it lands first: the sum is the lumens of the file.
TEST(MeasuredPhotons, ABlackRoomAbsorbsTheLumens) {
  for (const LuminousOpening& opening : openings()) {
    const auto file = luminaire(uneven(), opening);
    const Scene scene = measured_room(file);
    const RayScene rays(scene);
    Counters counters;
    PhotonOptions options;
    options.paths = 50000;
    PhotonTotals totals;
    const Photons photons = trace_photons(rays, options, 1, totals, counters);
    double lm = 0;
    for (const Rgb& flux : photons.flux) lm += static_cast<double>(flux.y);
    EXPECT_NEAR(lm, file->photometry->flux_lm(), 2e-4 * file->photometry->flux_lm()) << opening.describe();
  }
}

/// They leave as the interpolant says, and from the opening's surface.
TEST(MeasuredPhotons, FollowTheIntensities) {
  for (const LuminousOpening& opening : openings()) {
    const auto file = luminaire(uneven(), opening);
    const Scene scene = measured_room(file);
    const Fitting& fitting = scene.fitting[0];
    constexpr int kPaths = 200000;
    const Emitter emitter(scene, 0.1, kPaths, 1);
    const double lm = file->photometry->flux_lm();
    int number = 0;
    const Chi2 result = chi2_directions(
        SphereGrid{20, 24, 8}, 7, kPaths,
        [&](RandomStream&, Vec3& d) {
          RandomStream random(3, Stage::photon_path, static_cast<std::uint64_t>(number));
          random.start_bounce(0);
          const EmittedPhoton photon = emitter.emit(static_cast<std::uint64_t>(number++), random);
          EXPECT_NEAR(static_cast<double>(photon.flux_lm.y) * kPaths, lm, 1e-4 * lm);
          if (opening.form != Form::point) {
            EXPECT_GT(glm::dot(photon.source_normal, photon.ray.direction), 0);
            EXPECT_LE(max_component(glm::abs(photon.ray.origin)), 0.31f);
          }
          d = photon.ray.direction;
          return true;
        },
        [&](const Vec3& d) { return static_cast<double>(fitting.intensity_cd(d).y) / lm; });
    EXPECT_GT(result.p, least_p(1e-3, 5))
        << opening.describe() << ": chi2 " << result.statistic << " of " << result.degrees;
  }
}

/// Light on a patch of the floor is the integral of the closed form over it.
TEST(MeasuredPhotons, LightTheFloorAsTheClosedFormSays) {
  for (const AnalyticScene& s : luminaire_scenes()) {
    const RayScene rays(s.scene);
    Counters counters;
    PhotonOptions options;
    options.paths = 400000;
    PhotonTotals totals;
    const Photons photons = trace_photons(rays, options, 2, totals, counters);
    const double flux = s.scene.light[0].flux_lm.y;
    for (const Check& check : s.checks) {
      constexpr double kHalf = 0.2;  // m
      double lm = 0, truth = 0;
      for (std::size_t i = 0; i < photons.position.size(); ++i) {
        const Vec3 way = photons.position[i] - check.position;
        if (decode_octahedral(photons.normal[i]).y > 0.5f && std::fabs(way.y) < 1e-3f &&
            std::fabs(way.x) < kHalf && std::fabs(way.z) < kHalf)
          lm += static_cast<double>(photons.flux[i].y);
      }
      constexpr int kSide = 40;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec3 at(static_cast<float>(kHalf * (2 * (i % kSide + 0.5) / kSide - 1)), 0,
                      static_cast<float>(kHalf * (2 * (i / kSide + 0.5) / kSide - 1)));
        truth += s.irradiance_lx(check.position + at, {0, 1, 0}) * 4 * kHalf * kHalf / (kSide * kSide);
      }
      // Each photon carries flux / paths: as many land as a binomial says.
      const double error = std::sqrt(truth * flux / static_cast<double>(options.paths));
      EXPECT_NEAR(lm, truth, 4 * error + 1e-3 * truth)
          << s.name << " at " << check.position.x << " " << check.position.z;
    }
  }
}

}  // namespace
}  // namespace phos::test
