#include "temporal/change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "support/golden_table.h"
#include "support/scenes.h"

namespace phos {
namespace {

TEST(ChangeRate, IsTheNormOfTheDifference) {
  EXPECT_DOUBLE_EQ(change_rate(Rgb(3, 4, 0), Rgb(3, 4, 0), 1e-3), 0);
  EXPECT_NEAR(change_rate(Rgb(3, 4, 0), Rgb(3, 4, 1), 1e-3), 0.2, 1e-7);
  // Ratios of coefficients (docs/methods.md#f2) would call the first of these static, the second infinite.
  EXPECT_NEAR(change_rate(std::vector<float>{10, -3}, std::vector<float>{10, 3}, 1e-3), 6 / std::sqrt(109.0),
              1e-6);
  EXPECT_NEAR(change_rate(std::vector<float>{10, 0}, std::vector<float>{10, 0.01f}, 1e-3), 1e-3, 1e-6);
  // Getting darker is a change as well.
  EXPECT_NEAR(change_rate(Rgb(10), Rgb(9), 1e-3), 0.1, 1e-6);
}

TEST(ChangeRate, InTheDarkCountsAgainstTheFloor) {
  EXPECT_DOUBLE_EQ(change_rate(Rgb(0), Rgb(0), 0.5), 0);
  EXPECT_NEAR(change_rate(Rgb(0), Rgb(2, 0, 0), 0.5), 4, 1e-6);
  EXPECT_NEAR(change_rate(Rgb(0.1f, 0, 0), Rgb(0.2f, 0, 0), 0.5), 0.2, 1e-6);
}

TEST(ChangeRate, KnowsNoUnit) {
  for (const float scale : {0x1p-60f, 1.f, 0x1p60f}) {
    const double floor = 1e-3 * static_cast<double>(scale);
    EXPECT_DOUBLE_EQ(change_rate(scale * Rgb(1, 2, 3), scale * Rgb(1.5f, 2, 3), floor),
                     change_rate(Rgb(1, 2, 3), Rgb(1.5f, 2, 3), 1e-3));
  }
  constexpr float kLarge = std::numeric_limits<float>::max();
  EXPECT_NEAR(change_rate(Rgb(kLarge), Rgb(-kLarge), 1e-3), 2, 1e-6);
}

TEST(LifeOf, IsWholeFramesWithinBounds) {
  EXPECT_EQ(life_of(0, 0.05, 20), 20);
  EXPECT_EQ(life_of(1e-300, 0.05, 20), 20);
  EXPECT_EQ(life_of(0.0101, 0.05, 20), 4);
  EXPECT_EQ(life_of(0.05, 0.05, 20), 1);
  EXPECT_EQ(life_of(7, 0.05, 20), 1);
  EXPECT_EQ(life_of(1e300, 0.05, 20), 1);
  EXPECT_EQ(life_of(std::numeric_limits<double>::infinity(), 0.05, 20), 1);
  for (const double rate : {0.0, 0.01, 1e9}) EXPECT_EQ(life_of(rate, 0.05, 1), 1);
  // E0 = E1 = 0 lives as long as any, E0 = 0 < E1 for one frame.
  EXPECT_EQ(life_of(change_rate(Rgb(0), Rgb(0), 1e-3), 0.05, 20), 20);
  EXPECT_EQ(life_of(change_rate(Rgb(0), Rgb(1), 1e-3), 0.05, 20), 1);
}

/// All of a life has weight, what follows has none (but for the last of its frames where nothing changes).
TEST(TimeWeight, FallsToZeroOverALife) {
  EXPECT_EQ(time_weight(0.3, 0, 0.05, 20), 1);
  EXPECT_EQ(time_weight(0, 19, 0.05, 20), 1);
  EXPECT_EQ(time_weight(0, 20, 0.05, 20), 0);
  for (const double rate : {0.003, 0.01, 0.024, 0.2}) {
    const std::int64_t life = life_of(rate, 0.05, 20);
    double last = 1;
    for (std::int64_t age = 1; age <= 25; ++age) {
      const double weight = time_weight(rate, static_cast<double>(age), 0.05, 20);
      EXPECT_LE(weight, last);
      if (age > life) {
        EXPECT_EQ(weight, 0) << rate << " " << age;
      }
      last = weight;
    }
  }
}

using Light = std::function<double(double t)>;

/// The lights of the table: a point of 100 cd that passes 2 m above, a square of 50 cd/m2, one that pulses.
Light light_of(const std::string& scene) {
  if (scene == "point_moving")
    return [](double t) { return test::point_over_plane_lx(100, 2, std::hypot(-2 + 0.05 * t, 0.3)); };
  if (scene == "area_moving")
    return [](double t) {
      const double c = -2 + 0.05 * t;
      const auto corner = [](double x, double y) { return test::corner_form_factor_parallel(x, y, 2); };
      return std::numbers::pi * 50 *
             (corner(c + 0.5, 0.5) - corner(c - 0.5, 0.5) - corner(c + 0.5, -0.5) + corner(c - 0.5, -0.5));
    };
  return [](double t) { return 10 * (1 + std::sin(2 * std::numbers::pi * t / 40)) / 2; };
}

/// Lives by rate (docs/methods.md#f4) over 80 frames, of at most 20, against the table of an independent
/// program.
TEST(LifeOf, GivesTheRecordsOfTheTable) {
  const auto rows = test::golden("F_lifespan.csv");
  ASSERT_EQ(rows.size(), 9u);
  for (const auto& row : rows) {
    const auto number = [&](const char* column) { return std::stod(row.at(column)); };
    const Light e = light_of(row.at("scene"));
    const double accuracy = number("a_t");
    int records = 0;
    double constant = 0, extrapolated = 0, interpolated = 0, most = 0, frames = 0;
    for (double t = 0; t < 80; ++records) {
      const double now = e(t), next = e(t + 1);
      const Rgb a(static_cast<float>(now)), b(static_cast<float>(next));
      const auto life = static_cast<double>(life_of(change_rate(a, b, 1e-6), accuracy, 20));
      const double end = e(t + life);
      for (double k = 0; k < life; ++k, ++frames) {
        const double truth = e(t + k), scale = std::max(truth, 1e-3);
        constant += std::fabs(now - truth) / scale;
        extrapolated += std::fabs(std::max(0.0, now + (next - now) * k) - truth) / scale;
        const double error = std::fabs(now + (end - now) * k / life - truth) / scale;
        interpolated += error, most = std::max(most, error);
      }
      t += life;
    }
    const std::string which = row.at("scene") + " " + row.at("a_t");
    EXPECT_EQ(records, std::stoi(row.at("records"))) << which;
    EXPECT_NEAR(constant / frames, number("const_mean"), 1e-5) << which;
    EXPECT_NEAR(extrapolated / frames, number("extrap_mean"), 1e-5) << which;
    EXPECT_NEAR(interpolated / frames, number("interp_mean"), 1e-5) << which;
    EXPECT_NEAR(most, number("interp_max"), 1e-5) << which;
  }
}

}  // namespace
}  // namespace phos
