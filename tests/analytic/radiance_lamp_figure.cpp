// Reflection of a lamp through harmonics against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "hsh/rotation.h"
#include "radiance/brdf/harmonic_reflection.h"
#include "support/one_material.h"
#include "support/reflections.h"

namespace phos {
namespace {

using test::view;
constexpr double kPi64 = std::numbers::pi;
constexpr float kKd = 0.6f;

HarmonicReflection reflection(const Material& material, const ReflectionHarmonics& through) {
  Counters counters;
  return {test::scene_of(material), 0, through, counters};
}
HarmonicReflection lambert(const ReflectionHarmonics& through) {
  return reflection(test::make_material(Model::lambert, Rgb(kKd), Rgb(0)), through);
}

/// Towards a viewer in several directions, of each of which Lambert's law knows nothing.
double value(const HarmonicReflection& r, double theta_deg) {
  const auto of = [&](const Vec3& wo) {
    const std::optional<Rgb> v = r(wo, view(static_cast<float>(theta_deg), 40));
    EXPECT_TRUE(v.has_value());
    return static_cast<double>(v.value_or(Rgb(-1)).y);
  };
  const double first = of(view(10, 0));
  for (const Vec3& wo : {view(0), view(37, 111), view(80, -60)}) EXPECT_NEAR(of(wo), first, 1e-5);
  return first;
}

double legendre(int l, double z) { return std::legendre(static_cast<unsigned>(l), z); }
/// P_l(0)
double at_zero(int l) { return legendre(l, 0); }

// cos theta is a sum of the first two bands of HSH; the first band alone has its mean, 1/2.
TEST(LampFigure, LambertThroughHshIsExactFromOrderTwo) {
  for (const int order : {2, 3, 7, 12})
    for (const double theta : {0., 20., 50., 75., 89.})
      EXPECT_NEAR(value(lambert({.order = order}), theta), kKd / kPi64 * std::cos(theta * kPi64 / 180), 2e-6)
          << order << " " << theta;
  for (const double theta : {0., 60.})
    EXPECT_NEAR(value(lambert({.order = 1}), theta), kKd / kPi64 / 2, 2e-6);
}

// The clamped cosine on the whole sphere is 1/4 + z/2 + sum over even l of a_l P_l(z) (Ramamoorthi and
// Hanrahan 2001, Basri and Jacobs 2003).
TEST(LampFigure, LambertThroughShIsTheTruncatedSeries) {
  for (const int order : {1, 2, 3, 5, 7, 10})
    for (const double theta : {0., 20., 50., 75., 89.}) {
      const double z = std::cos(theta * kPi64 / 180);
      double series = 0.25 + (order > 1 ? z / 2 : 0);
      for (int l = 2; l < order; l += 2) {
        const double a = (2 * l + 1) / 2. * (l % 4 == 2 ? 1 : -1) * std::tgamma(l - 1) /
                         (std::ldexp(1, l) * std::tgamma(l / 2.) * std::tgamma(l / 2. + 2));
        series += a * legendre(l, z);
      }
      EXPECT_NEAR(value(lambert({.basis = BasisKind::sh, .order = order}), theta), kKd / kPi64 * series, 2e-5)
          << order << " " << theta;
    }
}

// Without the cosine Lambert's BRDF is constant: the first band of HSH is all of it; on the sphere it is a
// step, 1/2 + sum over odd l of (P_(l-1)(0) - P_(l+1)(0))/2 P_l(z).
TEST(LampFigure, LambertWithoutTheCosine) {
  for (const double theta : {0., 20., 50., 75., 89.}) {
    const double z = std::cos(theta * kPi64 / 180);
    for (const int order : {1, 4, 7}) {
      EXPECT_NEAR(value(lambert({.order = order, .cosine = false}), theta), kKd / kPi64 * z, 1e-5) << order;
      double series = 0.5;
      for (int l = 1; l < order; l += 2) series += (at_zero(l - 1) - at_zero(l + 1)) / 2 * legendre(l, z);
      const ReflectionHarmonics through{.basis = BasisKind::sh, .order = order, .cosine = false};
      EXPECT_NEAR(value(lambert(through), theta), kKd / kPi64 * z * series, 5e-5) << order << " " << theta;
    }
  }
}

// With many bands a lobe is itself, in both bases, with the cosine and without.
TEST(LampFigure, ManyBandsAreTheLobe) {
  Material phong = test::phong(5, "phong");
  phong.kd = Rgb(0.2f);
  const Scene scene = test::scene_of(phong);
  const Bsdf exact(scene, std::uint32_t{0});
  const Vec3 wo = view(30, 20);
  const float most = exact.evaluate(wo, view(30, 200)).y;
  for (const bool cosine : {true, false}) {
    for (const BasisKind basis : {BasisKind::hsh, BasisKind::sh}) {
      // On the sphere the lobe without the cosine ends in a step.
      const float tolerance = basis == BasisKind::sh ? (cosine ? 0.003f : 0.03f) : 0.003f;
      const HarmonicReflection r =
          reflection(phong, {.basis = basis, .order = 24, .cosine = cosine, .resolution = 64});
      for (const Vec3& wi : {view(0), view(30, 200), view(45, 170), view(20, 300), view(55, 60)}) {
        const Rgb wanted = exact.evaluate(wo, wi) * wi.z;
        EXPECT_NEAR(r(wo, wi)->y, wanted.y, tolerance * most) << cosine << " " << static_cast<int>(basis);
      }
    }
  }
}

// A lobe that is the same for all azimuths sees a lamp that is turned with the viewer the same.
TEST(LampFigure, IsotropicLobesTurn) {
  for (const BasisKind basis : {BasisKind::hsh, BasisKind::sh}) {
    const HarmonicReflection r = reflection(test::phong(12, "phong"), {.basis = basis, .order = 9});
    const float first = r(view(40, 0), view(50, 150))->y;
    EXPECT_GT(first, 0.01f);
    for (const float turn : {33.f, 140.f, 271.f})
      EXPECT_NEAR(r(view(40, turn), view(50, 150 + turn))->y, first, 1e-5f * first + 1e-6f);
  }
}

/// Irradiance by a lamp of 1 lx, `beta` from the normal, whose delta is cut to `order` bands of HSH about its
/// own direction: a zonal function of z', the cosine with that direction. What stays above the old horizon,
/// z' > 0, and of what comes from below it: nothing, the value at the horizon, or the mirror image.
double rotated_irradiance(int order, double beta, HshRotation fill) {
  const auto band_limited = [&](double z) {
    double sum = 0;
    for (int l = 0; l < order; ++l) sum += (2 * l + 1) / (2 * kPi64) * legendre(l, 2 * z - 1);
    return sum;
  };
  // Over the azimuth about the lamp: the integral of max(a + b cos phi, 0).
  const auto ring = [&](double z) {
    const double a = std::cos(beta) * z, b = std::sin(beta) * std::sqrt(1 - z * z);
    if (a >= b) return 2 * kPi64 * a;
    if (a <= -b) return 0.;
    const double end = std::acos(-a / b);
    return 2 * (a * end + b * std::sin(end));
  };
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) / kSteps;
    sum += band_limited(z) * ring(z) / kSteps;
    if (fill == HshRotation::constant_fill) sum += band_limited(0) * ring(-z) / kSteps;
    if (fill == HshRotation::even_fill) sum += band_limited(z) * ring(-z) / kSteps;
  }
  return sum;
}

TEST(LampFigure, RotatedLightIsTheIntegralOfEachMethod) {
  for (const int order : {3, 7}) {
    for (const double beta : {5., 30., 60., 88.}) {
      for (const HshRotation fill :
           {HshRotation::zero_fill, HshRotation::constant_fill, HshRotation::even_fill}) {
        const double wanted = rotated_irradiance(order, beta * kPi64 / 180, fill);
        EXPECT_NEAR(value(lambert({.order = order, .rotation = fill}), beta) * kPi64 / kKd, wanted, 3e-5)
            << order << " " << beta << " " << static_cast<int>(fill);
      }
    }
  }
}

// Where the normal points to the lamp nothing is rotated, and every method is the direct one.
TEST(LampFigure, EveryMethodAgreesAtTheNormal) {
  Material phong = test::phong(8, "phong");
  const Vec3 wo = view(25, 70);
  const double direct = reflection(phong, {})(wo, Vec3(0, 0, 1))->y;
  EXPECT_GT(direct, 0.01);
  for (const HshRotationRow& row : kHshRotations)
    EXPECT_NEAR(reflection(phong, {.rotation = row.method})(wo, Vec3(0, 0, 1))->y, direct, 1e-5 * direct)
        << row.name;
}

// By way of SH, nothing comes from below the horizon either; SH of twice the order leave a little out.
TEST(LampFigure, BySphericalHarmonicsIsNearlyZeroFill) {
  for (const double beta : {5., 30., 60.}) {
    const double zero = value(lambert({.rotation = HshRotation::zero_fill}), beta);
    EXPECT_NEAR(value(lambert({.rotation = HshRotation::via_sh}), beta), zero, 0.02 * kKd / kPi64) << beta;
  }
}

// SH rotate without error: the lamp's SH, turned from its own frame, are the SH of its direction.
TEST(LampFigure, SphericalHarmonicsRotateExactly) {
  constexpr int kOrder = 9;
  const HarmonicBasis<float> basis(kOrder);
  std::vector<float> pole(kOrder * kOrder), turned(pole.size()), direct(pole.size());
  basis.evaluate(BasisKind::sh, 0, 0, 1, pole.data());
  for (const Vec3& wi : {view(0), view(17, 33), view(60, -140), view(89, 5)}) {
    ShRotation(kOrder, rotation_angles(make_frame(wi), Frame())).rotate(pole, turned);
    basis.evaluate(BasisKind::sh, wi.x, wi.y, wi.z, direct.data());
    for (std::size_t i = 0; i < pole.size(); ++i) EXPECT_NEAR(turned[i], direct[i], 1e-5) << i;
  }
}

TEST(LampFigure, RefusesOrdersThatItHasNot) {
  for (const int order : {0, 31}) EXPECT_THROW(lambert({.order = order}), Error) << order;
}

}  // namespace
}  // namespace phos
