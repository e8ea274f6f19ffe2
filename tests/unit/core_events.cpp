// Numerical events: each has a stated frequency, and a tool that sees more of one says so.
#include <gtest/gtest.h>

#include <cmath>

#include "core/counters.h"
#include "core/error.h"
#include "core/events.h"

namespace phos {
namespace {

/// P(X <= k), X binomial, term by term in long double.
double at_most(std::uint64_t k, std::uint64_t n, double p) {
  long double sum = 0;
  for (std::uint64_t i = 0; i <= k && i <= n; ++i)
    sum +=
        std::exp(std::lgamma(static_cast<long double>(n) + 1) - std::lgamma(static_cast<long double>(i) + 1) -
                 std::lgamma(static_cast<long double>(n - i) + 1) +
                 static_cast<long double>(i) * std::log(static_cast<long double>(p)) +
                 static_cast<long double>(n - i) * std::log1p(-static_cast<long double>(p)));
  return static_cast<double>(sum);
}

// The quantile is the least k with P(X <= k) >= 0.9999, for any size and share.
TEST(AllowedCount, IsTheBinomialQuantile) {
  for (const std::uint64_t n : {1ull, 2ull, 10ull, 100ull, 1000ull, 65536ull, 1000000ull, 30000000ull}) {
    for (const double p : {1e-9, 1e-6, 1e-4, 0.003, 0.1, 0.5, 0.9, 0.9999}) {
      if (static_cast<double>(n) * p > 5e5) continue;  // the sum above takes long
      const std::uint64_t k = allowed_count(n, p);
      ASSERT_LE(k, n);
      EXPECT_GE(at_most(k, n, p), 0.9999 - 1e-9) << n << " " << p << " " << k;
      if (k > 0) {
        EXPECT_LT(at_most(k - 1, n, p), 0.9999 + 1e-9) << n << " " << p << " " << k;
      }
    }
  }
}

TEST(AllowedCount, LimitsAndKnownValues) {
  EXPECT_EQ(allowed_count(0, 0.5), 0u);
  EXPECT_EQ(allowed_count(1000, 0), 0u);
  EXPECT_EQ(allowed_count(1000, 1), 1000u);
  EXPECT_EQ(allowed_count(99, 1e-6), 0u);       // (1 - 1e-6)^99 is 0.999901
  EXPECT_EQ(allowed_count(101, 1e-6), 1u);      // (1 - 1e-6)^101 is 0.999899
  EXPECT_EQ(allowed_count(1000000, 1e-6), 6u);  // Poisson of mean 1: P(X <= 5) 0.99941, P(X <= 6) 0.99992
  // Normal where the mean is large: mean + 3.719 deviations.
  const double n = 1e13, p = 1e-6;
  EXPECT_NEAR(static_cast<double>(allowed_count(10000000000000u, p)), n * p + 3.719016 * std::sqrt(n * p), 5);
}

const Event kTried{"tried once", "tries"}, kWrong{"went wrong", "tries", kRare, "try again"};

TEST(Events, AreListedByName) {
  const std::vector<const Event*> all = all_events();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], &kTried);
  EXPECT_EQ(all[1], &kWrong);
}

TEST(Events, OfOneNameAbort) { EXPECT_DEATH(Event("went wrong", "tries"), "declared twice"); }

TEST(Events, AreCounted) {
  Counters counters;
  counters.count(kTried), counters.count(kWrong, 3), counters.add("tried once", 4);
  EXPECT_EQ(counters[kTried], 5u);
  EXPECT_EQ(counters["went wrong"], 3u);
  EXPECT_NO_THROW(counters.require_allowed(kTried, 5));
  EXPECT_THROW(counters.require_allowed(kWrong, 1000), Error);
}

}  // namespace
}  // namespace phos
