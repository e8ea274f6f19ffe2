#include "reference/sample_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace {

using namespace phos;

std::uint64_t sum_of(const std::vector<std::uint32_t>& shares) {
  return std::accumulate(shares.begin(), shares.end(), std::uint64_t{0});
}

TEST(SampleShares, AreTheSameWhereNothingVaries) {
  for (const std::uint32_t share : sample_shares(std::vector<double>(12, 0.0), 4, 8)) EXPECT_EQ(share, 8u);
  for (const std::uint32_t share : sample_shares(std::vector<double>(12, 2.5), 4, 8)) EXPECT_EQ(share, 8u);
  EXPECT_EQ(sample_shares(std::vector<double>{3}, 1, 10), std::vector<std::uint32_t>{10});  // no neighbours
  EXPECT_EQ(sample_shares(std::vector<double>{}, 5, 10).size(), 0u);
}

TEST(SampleShares, AreAsManyAsAreAskedForInGroupsOfFour) {
  std::vector<double> variance(30 * 20);
  for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = static_cast<double>(i * i % 97) * 1e-40;
  for (const std::int64_t mean : {1, 3, 16, 1000}) {
    const std::vector<std::uint32_t> shares = sample_shares(variance, 30, mean);
    EXPECT_EQ(sum_of(shares), variance.size() * static_cast<std::uint64_t>(mean));
    for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
      EXPECT_EQ(shares[i] % 4, 0u);
      EXPECT_GE(shares[i], std::floor(static_cast<double>(mean) / 3) - 4) << i;
    }
  }
}

TEST(SampleShares, GoByTheDeviationOfThePixelsAboutEach) {
  // One pixel of 11 x 11 varies: its neighbours get the two thirds that are not even, it does not.
  std::vector<double> variance(121, 0.0);
  variance[5 * 11 + 5] = 7;
  const std::vector<std::uint32_t> shares = sample_shares(variance, 11, 120);
  EXPECT_NEAR(shares[5 * 11 + 5], 40, 4);
  for (const std::size_t i : {4u * 11 + 4, 4u * 11 + 5, 5u * 11 + 6, 6u * 11 + 6})
    EXPECT_NEAR(shares[i], 40 + 121 * 80 / 8, 4) << i;
  EXPECT_NEAR(shares[0], 40, 4);

  // Two halves, one of which deviates ten times as much: away from the border it gets ten times the rest.
  std::vector<double> halves(20 * 20);
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = i % 20 < 10 ? 1 : 100;
  const std::vector<std::uint32_t> two = sample_shares(halves, 20, 3000);
  EXPECT_NEAR((two[205 + 10] - 1000.0) / (two[205] - 1000.0), 10, 0.1);
}

}  // namespace
