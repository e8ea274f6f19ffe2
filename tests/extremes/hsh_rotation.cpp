#include "core/float_traps.h"
#include "hsh/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace phos {
namespace {

using Coefficients = std::vector<float>;
constexpr HshRotation kMethods[] = {HshRotation::via_sh, HshRotation::digon, HshRotation::zero_fill,
                                    HshRotation::constant_fill, HshRotation::even_fill};

Coefficients random_coefficients(int order) {
  RandomStream random(1, Stage::test, 0);
  Coefficients c;
  for (int i = 0; i < harmonic_count(order); ++i) c.push_back(random.uniform() - 0.5f);
  return c;
}

double length(const Coefficients& c) {
  double sum = 0;
  for (const float x : c) sum += static_cast<double>(x) * x;
  return std::sqrt(sum);
}

TEST(HshRotationExtremes, RefusesOrdersAndRangesThatItHasNot) {
  const NoFloatTraps traps;  // comparisons with NaN
  for (const int order : {-1, 0, 31, 200}) EXPECT_THROW(HshRotator{order}, Error) << order;
  for (const float max_beta : {-0.1f, 1.6f, NAN, INFINITY})
    EXPECT_THROW(HshRotator(3, HshRotation::zero_fill, max_beta), Error) << max_beta;
  for (const int order : {0, 101, 200}) EXPECT_THROW(ShRotation(order, {}), Error) << order;
  try {
    HshRotator{200};
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_NE(std::string(e.what()).find("200"), std::string::npos);
  }
}

/// Every angle, next to and at the ends of the range too: finite, and no method that fills with nothing or
/// mirrors gains energy beyond what it saw.
TEST(HshRotationExtremes, IsFiniteAtEveryAngle) {
  for (const int order : {1, 2, 5}) {
    const Coefficients c = random_coefficients(order);
    Coefficients out(c.size());
    for (const HshRotation method : kMethods) {
      const HshRotator rotator(order, method);
      for (const float beta : {0.f, 1e-38f, 1e-7f, 0.00174f, 0.00175f, 0.0174532f, 0.0174534f, 0.55f,
                               0.5500001f, 1.5707963f, 3.f, 3.1415925f, kPi}) {
        for (const float turn : {0.f, -1e-30f, 100.f, -1e6f}) {
          rotator.rotate({turn, beta, -turn}, c, out);
          for (const float x : out) ASSERT_TRUE(std::isfinite(x)) << beta;
          const double gain = length(out) / length(c);
          EXPECT_LT(gain,
                    method == HshRotation::even_fill || method == HshRotation::constant_fill ? 3 : 1.00001)
              << order << " " << static_cast<int>(method) << " " << beta;
        }
      }
    }
  }
}

TEST(HshRotationExtremes, TurnsOnlyAboutZBelowATenthOfADegree) {
  const Coefficients c = random_coefficients(6);
  Coefficients out(c.size()), turned = c, beyond(c.size());
  const HshRotator rotator(6);
  rotator.rotate({0.3f, 0.0017f, 0.4f}, c, out);
  rotate_about_z(turned, 0.3f + 0.4f);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_EQ(out[i], turned[i]);
  // And the step to what is rotated is as small as the angle.
  rotator.rotate({0.3f, 0.0018f, 0.4f}, c, beyond);
  for (std::size_t i = 0; i < c.size(); ++i) out[i] -= beyond[i];
  EXPECT_LT(length(out), 0.02 * length(c));
  EXPECT_GT(length(out), 0);
}

/// Upside down nothing of the hemisphere is left.
TEST(HshRotationExtremes, SeesNothingUpsideDown) {
  const Coefficients c = random_coefficients(7);
  Coefficients out(c.size());
  HshRotator(7, HshRotation::zero_fill).rotate({0, kPi, 0}, c, out);
  EXPECT_LT(length(out), 1e-6);
}

/// The result scales with the light: the same digits, whatever the size.
TEST(HshRotationExtremes, ScalesWithTheLight) {
  const Coefficients c = random_coefficients(10);
  const HshRotator rotator(10);
  Coefficients out(c.size()), scaled(c.size()), input(c.size());
  rotator.rotate({1, 0.3f, 2}, c, out);
  for (const float scale : {0x1p-90f, 0x1p-40f, 0x1p40f, 0x1p100f}) {
    for (std::size_t i = 0; i < c.size(); ++i) input[i] = c[i] * scale;
    rotator.rotate({1, 0.3f, 2}, input, scaled);
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_EQ(scaled[i], out[i] * scale) << scale;
  }
}

TEST(HshRotationExtremes, WorksAtTheGreatestOrder) {
  const int order = HshRotator::kMaxOrder;
  Coefficients one(static_cast<std::size_t>(harmonic_count(order)), 0.f), out(one.size());
  one[0] = 1;
  HshRotator(order).rotate({1, 0.0157f, 2}, one, out);  // the first table
  EXPECT_NEAR(out[0], 1, 1e-6);
  out[0] = 0;
  EXPECT_LT(length(out), 1e-6);
}

/// Tables are made by whichever thread comes first.
TEST(HshRotationExtremes, GivesTheSameBitsFromManyThreads) {
  constexpr int kOrder = 4;
  const Coefficients c = random_coefficients(kOrder);
  const HshRotator rotator(kOrder, HshRotation::even_fill, 1.5f);
  constexpr std::size_t kTurns = 2000;
  std::vector<Coefficients> many(kTurns, Coefficients(c.size()));
  const auto angles = [](std::size_t i) {
    return ZyzAngles{0.01f * static_cast<float>(i), 1.5f * static_cast<float>(i % 97) / 97, 1};
  };
  set_threads(4);
  parallel_for(kTurns, 1, [&](std::size_t i) { rotator.rotate(angles(i), c, many[i]); });
  set_threads(0);
  Coefficients alone(c.size());
  for (std::size_t i = 0; i < kTurns; ++i) {
    rotator.rotate(angles(i), c, alone);
    ASSERT_EQ(alone, many[i]) << i;
  }
}

/// Frames that are none (a missing normal) give angles that are numbers.
TEST(HshRotationExtremes, GivesAnglesOfFramesThatAreNone) {
  const Frame zero{Vec3(0), Vec3(0), Vec3(0)}, unit;
  for (const auto& [from, to] : {std::pair{zero, unit}, {unit, zero}, {zero, zero}}) {
    const ZyzAngles a = rotation_angles(from, to);
    EXPECT_TRUE(std::isfinite(a.alpha) && std::isfinite(a.beta) && std::isfinite(a.gamma));
  }
}

TEST(ShRotationExtremes, KeepsItsLengthAtEveryAngleAndOrder) {
  for (const int order : {1, 2, 30, 100}) {
    const Coefficients c = random_coefficients(order);
    Coefficients out(c.size());
    for (const float beta : {0.f, 1e-30f, 1e-6f, 0.01f, 1.5707963f, 3.14f, kPi}) {
      ShRotation(order, {100, beta, -3}).rotate(c, out);
      EXPECT_NEAR(length(out) / length(c), 1, 1e-6) << order << " " << beta;
    }
  }
}

/// A mistake of ours ends with the values, not with numbers from nowhere.
TEST(HshRotationExtremesDeathTest, StopsAtAnglesThatAreNone) {
  const HshRotator rotator(3);
  const Coefficients c(9, 1.f);
  Coefficients out(9), few(4);
  EXPECT_DEATH(rotator.rotate({0, NAN, 0}, c, out), "beta");
  EXPECT_DEATH(rotator.rotate({INFINITY, 0, 0}, c, out), "alpha");
  EXPECT_DEATH(rotator.rotate({0, 0.1f, 0}, c, few), "coefficients");
  EXPECT_DEATH(rotate_about_z(out, NAN), "angle");
}

}  // namespace
}  // namespace phos
