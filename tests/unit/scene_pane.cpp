// Panes against closed forms and tables of other programs (Born and Wolf 1.5; golden values by quadrature).
#include "scene/material/pane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace phos::test {
namespace {

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }
double transmittance(double degrees, float ior, float inside) {
  return static_cast<double>(
      pane_layer(static_cast<float>(cosine(degrees)), ior, Rgb(inside)).transmittance().x);
}

}  // namespace

/// Mean over both polarisations of (1 - R) / (1 + R), n = 1.5; and of panes of transmittance 0.5 and 0.88 at
/// normal incidence, made by another program.
TEST(Pane, PassesByAngleAsFresnelHasIt) {
  const double clear[][2] = {{0, 0.923076923}, {30, 0.920734444}, {60, 0.84812841}, {80, 0.458472796}};
  for (const auto& [degrees, t] : clear) EXPECT_NEAR(transmittance(degrees, 1.5f, 1), t, 2e-6) << degrees;
  EXPECT_NEAR(transmittance(30, 1.5f, 1), 0.920734444, 2e-6);
  const auto a = static_cast<float>(internal_transmittance(0.88, 1.5));
  EXPECT_NEAR(static_cast<double>(a), 0.953472194, 1e-6);
  EXPECT_NEAR(transmittance(0, 1.5f, a), 0.88, 1e-6);
  EXPECT_NEAR(transmittance(30, 1.5f, a), 0.875197012, 2e-6);
  // The sun at elevations 60 and 30 degrees through a pane of 0.5: 41605.5 and 19839.5 of 100,000 lx.
  const auto half = static_cast<float>(internal_transmittance(0.5, 1.5));
  EXPECT_NEAR(1e5 * cosine(30) * transmittance(30, 1.5f, half), 41605.5375, 0.5);
  EXPECT_NEAR(1e5 * cosine(60) * transmittance(60, 1.5f, half), 19839.5035, 0.5);
}

/// Diffuse transmittance 2 int T c dc: 0.850938301 for n = 1.5, 0.846422905 for 1.52; two panes 0.770949645.
TEST(Pane, DiffuseTransmittance) {
  const auto diffuse = [](float ior, int panes) {
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double root = (i + 0.5) / kSteps, c = root * root;  // over the root of the cosine
      const PaneLayer one = pane_layer(static_cast<float>(c), ior, Rgb(1));
      PaneLayer all = one;
      for (int k = 1; k < panes; ++k) all = stack(all, one);
      sum += 2 * static_cast<double>(all.transmittance().x) * c * 2 * root / kSteps;
    }
    return sum;
  };
  EXPECT_NEAR(diffuse(1.5f, 1), 0.850938301, 1e-5);
  EXPECT_NEAR(diffuse(1.52f, 1), 0.846422905, 1e-5);
  EXPECT_NEAR(diffuse(1.5f, 2), 0.770949645, 1e-5);
  EXPECT_NEAR(diffuse(1.5f, 3), 0.713632053, 1e-5);
}

/// T_N = (1 - R) / (1 + (2N - 1) R) for each polarisation; nothing is lost.
TEST(Pane, PacksHaveAllInterreflection) {
  for (const double degrees : {0.0, 50.0, 80.0, 89.0}) {
    const auto c = static_cast<float>(cosine(degrees));
    const FaceReflectance face = face_reflectance(c, 1.5f);
    const PaneLayer one = pane_layer(c, 1.5f, Rgb(1));
    PaneLayer pack = one;
    for (int n = 1; n <= 200; ++n) {
      for (int k = 0; k < 2; ++k) {
        const double r = static_cast<double>(k == 0 ? face.s : face.p);
        EXPECT_NEAR(static_cast<double>(pack.pass[k].x), (1 - r) / (1 + (2 * n - 1) * r), 1e-4) << n;
        EXPECT_NEAR(pack.pass[k].x + pack.back[k].x, 1, 1e-4) << n << " " << degrees;
      }
      pack = stack(pack, one);
    }
  }
}

TEST(Pane, AtTheLimitsNothingIsNotANumber) {
  for (const float c : {0.f, 1e-30f, 1e-4f, 1.f})
    for (const float ior : {1.f, 1.0001f, 1.5f, 100.f})
      for (const float inside : {0.f, 1e-30f, 0.5f, 1.f}) {
        const PaneLayer layer = pane_layer(c, ior, Rgb(inside));
        for (int k = 0; k < 2; ++k) {
          EXPECT_TRUE(layer.pass[k].x >= 0 && layer.pass[k].x <= 1) << c << " " << ior << " " << inside;
          EXPECT_TRUE(layer.back[k].x >= 0 && layer.back[k].x <= 1.000001f) << c << " " << ior;
          EXPECT_LE(layer.pass[k].x + layer.back[k].x, 1.000001f);
        }
        const PaneLayer two = stack(layer, layer);
        EXPECT_TRUE(std::isfinite(two.pass[0].x) && std::isfinite(two.back[1].x));
      }
  EXPECT_EQ(face_reflectance(0.1f, 1 / 1.5f).s, 1);  // total reflection
  EXPECT_GT(internal_transmittance(0.93, 1.5), 1);   // more than a clear pane has
  EXPECT_EQ(internal_transmittance(0, 1.5), 0);
}

/// A table in steps of 10 degrees holds Fresnel's curve to 0.0028 below 75 degrees, and its diffuse
/// transmittance to 0.01 %.
TEST(TransmittanceCurve, FollowsFresnelBetweenItsPoints) {
  std::vector<TransmittanceCurve::Point> points;
  for (int degrees = 0; degrees <= 80; degrees += 10)
    points.push_back({static_cast<double>(degrees), transmittance(degrees, 1.5f, 1)});
  const TransmittanceCurve curve(points);
  double diffuse = 0, exact = 0;
  for (double degrees = 0.05; degrees < 90; degrees += 0.1) {
    const double t = static_cast<double>(curve.at(static_cast<float>(cosine(degrees))));
    const double truth = transmittance(degrees, 1.5f, 1);
    if (degrees < 75) {
      EXPECT_NEAR(t, truth, 0.003) << degrees;
    }
    diffuse += t * std::sin(2 * degrees * std::numbers::pi / 180);
    exact += truth * std::sin(2 * degrees * std::numbers::pi / 180);
  }
  EXPECT_NEAR(diffuse / exact, 1, 3e-4);
  EXPECT_EQ(curve.at(0), 0);
  for (const auto& p : points)
    EXPECT_NEAR(static_cast<double>(curve.at(static_cast<float>(cosine(p.angle_deg)))), p.transmittance,
                2e-4);
}

TEST(TransmittanceCurve, RefusesWhatIsNone) {
  using Points = std::vector<TransmittanceCurve::Point>;
  for (const Points& wrong :
       {Points{}, Points{{10, 0.5}}, Points{{0, 0.5}, {0, 0.4}}, Points{{0, 0.5}, {95, 0.1}},
        Points{{0, 1.5}}, Points{{0, -0.1}}, Points{{0, 0.9}, {40, 0.8}, {30, 0.7}}})
    EXPECT_THROW(TransmittanceCurve{wrong}, std::runtime_error);
  const TransmittanceCurve constant({{0, 0.6}});
  EXPECT_NEAR(constant.at(1), 0.6f, 1e-6f);
  EXPECT_EQ(constant.at(0), 0);
}

}  // namespace phos::test
