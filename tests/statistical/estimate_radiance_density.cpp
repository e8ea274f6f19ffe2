// Radiance from random photons: means, slopes and standard errors over many zones.
#include "estimate/radiance_density.h"

#include <gtest/gtest.h>

#include "support/chi2.h"
#include "support/photon_lobes.h"

namespace phos {
namespace {

constexpr int kOrder = 6;

/// Records of zones of Poisson photons about the receiver of a scene.
template <class Use>
void zones(const test::GradientScene& scene, double radius_m, double photons, int times,
           RadianceGradient mode, int order, const Use& use) {
  const test::PhotonSource source(scene, radius_m);
  PhotonProjector projector(order);
  ZonePhotons zone;
  for (int i = 0; i < times; ++i) {
    RandomStream random(43, Stage::test, static_cast<std::uint64_t>(i));
    source.draw_poisson(photons, random, zone);
    const std::vector<std::uint8_t> used(zone.size(), 1);
    use(projector.project(zone, used, source.area_m2(), 0, Vec2(0), Frame(), mode), zone, source.area_m2());
  }
}

/// Walls at 0.8 m to 1.2 m, one five times as bright, seen from a zone that is small beside them: 36 values
/// and 72 slopes are those of the fit of what is seen, none off by more than chance (4 standard errors: once
/// in 150 such tests), though the cosine of sources is bounded.
TEST(RadianceDensity, NoBiasInLightAndSlopes) {
  for (const char* name : {"closed_box_5L", "rect_wall_x1"}) {
    const test::GradientScene scene = test::gradient_scene(name);
    const auto at = [&](const DVec3& p) {
      return test::fitted(test::coefficients(scene, scene.receiver + p, kOrder, true), kOrder);
    };
    const std::vector<double> truth = at(DVec3(0)), slope_x = test::slope_along(0, 0.01, at),
                              slope_y = test::slope_along(1, 0.01, at);
    test::Spreads light, x, y;
    zones(scene, 0.01, 400, 300, RadianceGradient::analytic, kOrder,
          [&](const RadianceRecord& r, auto&, double) {
            light.add(test::channel(r.light));
            x.add(test::channel(r.gradient_x)), y.add(test::channel(r.gradient_y));
          });
    EXPECT_LT(light.worst_z(truth, 1e-4 * test::norm(truth)), 4) << name;
    EXPECT_LT(x.worst_z(slope_x, 4e-3 * test::norm(slope_x)), 4) << name;
    EXPECT_LT(y.worst_z(slope_y, 4e-3 * test::norm(slope_x)), 4) << name;
  }
}

/// The same photons, their slopes by derivatives and by differences.
TEST(RadianceDensity, DerivativesAreDifferences) {
  const test::GradientScene scene = test::gradient_scene("closed_box_5L");
  std::vector<std::vector<double>> slopes[2];
  for (const int which : {0, 1}) {
    const RadianceGradient mode = which ? RadianceGradient::numeric : RadianceGradient::analytic;
    zones(scene, 0.3, 300, 20, mode, kOrder, [&](const RadianceRecord& r, auto&, double) {
      slopes[which].push_back(test::channel(r.gradient_x)),
          slopes[which].push_back(test::channel(r.gradient_y));
    });
  }
  for (std::size_t i = 0; i < slopes[0].size(); ++i)
    EXPECT_LT(test::distance(slopes[0][i], slopes[1][i]), 2e-3 * test::norm(slopes[0][i])) << i;
}

/// Errors stated of irradiance, one by one: chi-squared over zones. And of what leaves through lobes, which
/// see more or less than their share of the light: on the mean over views from four sides.
TEST(RadianceDensity, StatesItsError) {
  constexpr int kTimes = 300;
  for (const char* name : {"closed_box_5L", "rect_ceiling", "white_furnace"}) {
    const test::GradientScene scene = test::gradient_scene(name);
    std::vector<std::vector<double>> lobes;
    for (const float azimuth : {20.f, 110.f, 200.f, 290.f})
      for (const test::NamedLobe& lobe : test::glossy_lobes(azimuth))
        lobes.push_back(test::coefficients(lobe, kOrder));
    const double mean = test::PhotonSource(scene, 0.05).mean_lx();
    double chi2 = 0, stated = 0;
    test::Spreads out;
    zones(scene, 0.05, 200, kTimes, RadianceGradient::none, kOrder,
          [&](const RadianceRecord& r, auto&, double) {
            const IrradianceRecord e = irradiance_of(r);
            chi2 += std::pow(
                (static_cast<double>(e.irradiance.y) - mean) / static_cast<double>(e.stderr_lx.y), 2);
            std::vector<double> through;
            for (const std::vector<double>& lobe : lobes) {
              through.push_back(test::through(lobe, test::channel(r.light)));
              stated += std::pow(test::stated(lobe, r), 2) / kTimes;
            }
            out.add(through);
          });
    // The error itself is an estimate from 200 photons.
    EXPECT_GT(test::chi2_tail(chi2, kTimes), 1e-3) << name << " " << chi2;
    EXPECT_LT(test::chi2_tail(chi2, kTimes), 1 - 1e-3) << name << " " << chi2;
    double actual = 0;
    for (std::size_t i = 0; i < lobes.size(); ++i) actual += out.variance(i);
    EXPECT_GT(stated / actual, 0.5) << name;  // a ceiling that many of the lobes see, and nothing else
    EXPECT_LT(stated / actual, 1.3) << name;
  }
}

/// Through the fit a lobe weighs each photon as it weighs its direction, bands or no bands: more of them add
/// no noise, only a truer lobe. Photons over their cosines err as much where bands are many.
TEST(RadianceDensity, MoreBandsAddNoNoise) {
  const test::GradientScene scene = test::gradient_scene("white_furnace");
  constexpr int kTimes = 200;
  const auto rms = [&](int order, bool plain) {
    std::vector<std::vector<double>> lobes;
    std::vector<double> truth;
    for (const float azimuth : {20.f, 200.f}) {
      for (const test::NamedLobe& lobe : test::glossy_lobes(azimuth)) {
        lobes.push_back(test::coefficients(lobe, order));
        truth.push_back(test::outgoing(scene, lobe, scene.receiver));
      }
    }
    double squares = 0;
    zones(scene, 0.05, 300, kTimes, RadianceGradient::none, order,
          [&](const RadianceRecord& r, const ZonePhotons& zone, double area_m2) {
            const std::vector<double> light =
                plain ? test::by_inverse_cosines(zone, area_m2, order) : test::channel(r.light);
            for (std::size_t i = 0; i < lobes.size(); ++i)
              squares += std::pow(test::through(lobes[i], light) - truth[i], 2);
          });
    return std::sqrt(squares / kTimes / static_cast<double>(lobes.size()));
  };
  const double five = rms(5, false), ten = rms(10, false);
  EXPECT_NEAR(ten / five, 1, 0.05);
  EXPECT_GT(rms(5, true), 0.98 * five);
  EXPECT_NEAR(rms(10, true) / ten, 1, 0.05);
}

/// But where bands are few, one photon along the horizon among 300 is more than all of the light, divided by
/// its cosine; in the fit it counts like any other.
TEST(RadianceDensity, OneGrazingPhotonIsOneOfMany) {
  const test::GradientScene scene = test::gradient_scene("white_furnace");
  for (const int order : {3, 5}) {
    zones(scene, 0.05, 300, 1, RadianceGradient::none, order,
          [&](const RadianceRecord& r, const ZonePhotons& zone, double area_m2) {
            ZonePhotons more = zone;
            more.offset_m.emplace_back(0), more.flux_lm.push_back(zone.flux_lm[0]);
            more.direction.emplace_back(1.f, 0.f, 1e-5f), more.inverse_distance.push_back(1);
            more.source_normal.emplace_back(-1.f, 0.f, 0.f);
            const std::vector<std::uint8_t> used(more.size(), 1);
            const RadianceRecord with = PhotonProjector(order).project(more, used, area_m2, 0, Vec2(0),
                                                                       Frame(), RadianceGradient::none);
            double fit = 0, plain = 0;
            for (const test::NamedLobe& lobe : test::glossy_lobes()) {
              const std::vector<double> c = test::coefficients(lobe, order);
              const auto change = [&](const std::vector<double>& after, const std::vector<double>& before) {
                return std::fabs(test::through(c, after) / test::through(c, before) - 1);
              };
              fit = std::max(fit, change(test::channel(with.light), test::channel(r.light)));
              plain = std::max(plain, change(test::by_inverse_cosines(more, area_m2, order),
                                             test::by_inverse_cosines(zone, area_m2, order)));
            }
            EXPECT_LT(fit, 0.05) << order;
            EXPECT_GT(plain, 1) << order;
          });
  }
}

}  // namespace
}  // namespace phos
