// The standard error of what several records say.
#include <gtest/gtest.h>

#include <cmath>

#include "estimate/zone/gradients.h"
#include "record/irradiance_cache.h"

namespace phos {
namespace {

IrradianceRecord record(float x, float lux, float error_lx, float shared) {
  IrradianceRecord r;
  r.position = {x, 0, 0}, r.normal = {0, 1, 0};
  r.irradiance = Rgb(lux), r.stderr_lx = Rgb(error_lx);
  r.shared = shared, r.radius_m = 1;
  return r;
}

Interpolated blended(std::span<const IrradianceRecord> records, const std::vector<float>& weights) {
  Interpolated sum;
  for (std::size_t i = 0; i < records.size(); ++i) sum.add(records[i], weights[i], {0, 0, 0}, {0, 1, 0});
  sum.finish();
  return sum;
}

TEST(Blend, ARecordAloneHasItsOwnError) {
  for (const float shared : {0.f, 0.2f, 1.f}) {
    const std::vector one{record(0, 10, 0.5f, shared)};
    EXPECT_NEAR(blended(one, {0.7f}).stderr_lx.y, 0.5f, 1e-6f);
  }
}

TEST(Blend, WhatIsNotSharedAveragesOut) {
  const std::vector<IrradianceRecord> own(4, record(0, 10, 1, 0)), common(4, record(0, 10, 1, 1)),
      zones(4, record(0, 10, 1, 0.2f));
  EXPECT_NEAR(blended(own, {1, 1, 1, 1}).stderr_lx.y, 0.5, 1e-6);
  EXPECT_NEAR(blended(own, {0.1f, 0.2f, 0.3f, 0.4f}).stderr_lx.y, std::sqrt(0.3), 1e-6);
  EXPECT_NEAR(blended(common, {1, 1, 1, 1}).stderr_lx.y, 1, 1e-6);
  EXPECT_NEAR(blended(zones, {1, 1, 1, 1}).stderr_lx.y, std::sqrt(0.2 + 0.8 / 4), 1e-6);
}

TEST(Blend, DisagreementBeyondNoiseIsError) {
  const std::vector exact{record(0, 9, 0, 0), record(0, 11, 0, 0)};
  EXPECT_NEAR(blended(exact, {1, 1}).stderr_lx.y, std::sqrt(kCommonDisagreement), 1e-5);
  // Two noisy ones differ by as much by chance: their variance is 1/2 s^2.
  const auto s = static_cast<float>(std::sqrt(2 / kCarriedNoise));
  const std::vector noisy{record(0, 9, s, 0), record(0, 11, s, 0)};
  EXPECT_NEAR(blended(noisy, {1, 1}).stderr_lx.y, s / std::sqrt(2.f), 1e-4f);
}

TEST(Blend, KeepsItsUnits) {
  for (const float unit : {1e-15f, 1.f, 1e15f}) {
    const std::vector two{record(0, 9 * unit, 0.1f * unit, 0.5f), record(0, 11 * unit, 0.2f * unit, 0.5f)};
    const std::vector plain{record(0, 9, 0.1f, 0.5f), record(0, 11, 0.2f, 0.5f)};
    EXPECT_NEAR(blended(two, {1, 2}).stderr_lx.y / unit, blended(plain, {1, 2}).stderr_lx.y, 1e-5f);
  }
  EXPECT_EQ(blended(std::vector{record(0, 0, 0, 0)}, {1}).stderr_lx, Rgb(0));
}

/// Irradiance of a piece of a Lambert surface, or of a lamp without one, from places about p: its Laplacian
/// by differences.
TEST(Curvature, IsThatOfTheClosedForm) {
  const DVec3 q(0.4, -0.3, 0.9);
  const Vec3 n(glm::normalize(DVec3(-0.5, 0.1, -0.8)));
  const double h = 1e-3;
  for (const bool surface : {true, false}) {
    const auto lux = [&](double x, double y) {
      const DVec3 way = q - DVec3(x, y, 0);
      const double d = glm::length(way), power = way.z / (d * d * d);
      return surface ? power * -glm::dot(DVec3(n), way) / d : power;
    };
    const double exact =
        (lux(h, 0) + lux(-h, 0) + lux(0, h) + lux(0, -h) - 4 * lux(0, 0)) / (h * h * lux(0, 0));
    const Vec3 w(glm::normalize(q));
    const float found =
        curvature_term(w, surface ? n : -w, static_cast<float>(1 / glm::length(q)), {0, 0, 1});
    EXPECT_NEAR(found, exact, 1e-4 * std::fabs(exact)) << surface;
    // As seen from a place beside, over the light there.
    const Vec3 step(-0.2f, 0.25f, 0);
    const Vec3 there(q - DVec3(step));
    const Vec3 w_there = glm::normalize(there);
    const float beside =
        curvature_term(w_there, surface ? n : -w_there, 1 / glm::length(there), {0, 0, 1}, -step);
    const auto x = static_cast<double>(step.x), y = static_cast<double>(step.y);
    const double exact_beside = exact * lux(0, 0) / lux(x, y);
    EXPECT_NEAR(beside, exact_beside, 1e-4 * std::fabs(exact_beside)) << surface;
  }
  EXPECT_EQ(curvature_term({0, 0, 1}, {0, 0, -1}, 0, {0, 0, 1}), 0);
}

}  // namespace
}  // namespace phos
