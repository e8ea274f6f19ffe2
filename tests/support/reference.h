// A scene with the data that estimates need, and estimates against closed forms within their own errors.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::test {

struct RaysAndLamps {
  explicit RaysAndLamps(const Scene& scene) : rays(scene), luminaires(scene) {}
  RayScene rays;
  Luminaires luminaires;
};

/// |value - expected| within 4 standard errors and the rounding of floats: seeds are fixed; the largest of
/// some 150 |z| is under 4 but for one set of seeds in a hundred. `relative` bounds the standard error
/// itself, so that a hopeless estimate does not pass.
inline void expect_within(double value, double standard_error, double expected, double relative,
                          const std::string& what) {
  constexpr double kMostSigma = 4;
  EXPECT_NEAR(value, expected, kMostSigma * standard_error + 2e-6 * expected) << what;
  EXPECT_LE(standard_error, relative * expected) << what;
}

}  // namespace phos::test
