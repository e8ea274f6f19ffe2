// Tables of glossy reflection, and harmonics, as discs.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "radiance/brdf/discs.h"

namespace phos::test {
namespace {

BrdfTable table(bool isotropic, int resolution, std::vector<std::uint8_t> orders, std::vector<float> error) {
  BrdfTable t;
  t.material = "m", t.isotropic = isotropic, t.resolution = resolution;
  t.order = *std::max_element(orders.begin(), orders.end());
  t.orders = std::move(orders), t.error = std::move(error);
  return t;
}

/// Three angles: at the pole, at tan(t/2) = 1/2, and at the horizon, which is traced.
TEST(BrdfDiscs, ErrorsOfAnIsotropicTable) {
  const std::vector<BrdfTable> tables{table(true, 3, {1, 2, 0}, {0.01f, 0.015f, 0.5f})};
  const DiscPlot plot = discs_of(tables, BrdfDiscs::error);
  EXPECT_DOUBLE_EQ(plot.hi, 2) << "1.5 %, rounded up";
  EXPECT_EQ(plot.rows[0][0].title, "m");
  const auto& value = plot.rows[0][0].value;
  EXPECT_NEAR(value(0, 0), 1, 1e-6);
  EXPECT_NEAR(value(0.2, 0), 1, 1e-6);
  EXPECT_NEAR(value(0.3, -0.4), 1.5, 1e-6);
  EXPECT_TRUE(std::isnan(value(-1, 0)));
  const DiscPlot orders = discs_of(tables, BrdfDiscs::order);
  EXPECT_EQ(orders.rows[0][0].value(0, 0.5), 2);
  EXPECT_EQ(orders.hi, 10);
}

/// Rows of entries go with y, columns with x.
TEST(BrdfDiscs, ErrorsOfAGrid) {
  const std::vector<BrdfTable> tables{table(false, 2, {1, 1, 1, 1}, {0.01f, 0.02f, 0.03f, 0.04f})};
  const DiscPlot plot = discs_of(tables, BrdfDiscs::error);
  const auto& value = plot.rows[0][0].value;
  EXPECT_NEAR(value(-0.5, -0.5), 1, 1e-6);
  EXPECT_NEAR(value(0.5, -0.5), 2, 1e-6);
  EXPECT_NEAR(value(-0.5, 0.5), 3, 1e-6);
  EXPECT_NEAR(value(0.5, 0.5), 4, 1e-6);
  EXPECT_NEAR(value(1, 0), 4, 1e-6) << "the rim belongs to the last entry";
}

/// H_0^0 = 1 / sqrt(2 pi), H_1^0 = sqrt(3 / (2 pi)) (2 z - 1); H_1^1 goes with -x, H_1^-1 with -y.
TEST(BrdfDiscs, Harmonics) {
  const std::vector<BrdfTable> tables{table(true, 2, {1, 2}, {0, 0})};
  const DiscPlot plot = discs_of(tables, BrdfDiscs::harmonics);
  ASSERT_EQ(plot.rows.size(), 2u);
  ASSERT_EQ(plot.rows[1].size(), 3u);
  EXPECT_EQ(plot.rows[1][0].title, "1, -1");
  EXPECT_TRUE(plot.about_zero);
  EXPECT_DOUBLE_EQ(plot.hi, 1) << "sqrt(3 / (2 pi)) = 0.69, rounded up";
  EXPECT_NEAR(plot.rows[0][0].value(0.3, 0.4), 0.3989423, 1e-6);
  EXPECT_NEAR(plot.rows[1][1].value(0, 0), 0.6909883, 1e-6);
  EXPECT_NEAR(plot.rows[1][1].value(0, 1), -0.6909883, 1e-6);
  EXPECT_LT(plot.rows[1][2].value(0.5, 0), -0.1);
  EXPECT_NEAR(plot.rows[1][2].value(0, 0.5), 0, 1e-6);
  EXPECT_LT(plot.rows[1][0].value(0, 0.5), -0.1);
}

TEST(BrdfDiscs, NothingToDraw) {
  EXPECT_THROW(discs_of({}, BrdfDiscs::error), Error);
  const std::vector<BrdfTable> traced{table(true, 2, {0, 0}, {0.5f, 0.5f})};
  EXPECT_THROW(discs_of(traced, BrdfDiscs::harmonics), Error);
  EXPECT_TRUE(std::isnan(discs_of(traced, BrdfDiscs::error).rows[0][0].value(0, 0)));
}

}  // namespace
}  // namespace phos::test
