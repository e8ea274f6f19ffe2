// The table of numerical events: each has a stated frequency, and a tool that sees more of one says so.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <set>

#include "core/counters.h"
#include "core/error.h"
#include "core/events.h"
#include "support/run.h"

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

class OfEvent : public testing::TestWithParam<Event> {};

/// "" or what is said.
std::string complaint(const std::string& event, std::uint64_t times, std::uint64_t trials) {
  Counters counters;
  if (times > 0) counters.count(event, times);
  try {
    counters.require_allowed(event, trials);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
    return e.what();
  }
  return "";
}

TEST_P(OfEvent, IsAllowedSoOftenAndNoMore) {
  const Event& event = GetParam();
  const std::string name(event.name);
  ASSERT_GT(event.share, 0);
  ASSERT_LE(event.share, 1);
  EXPECT_FALSE(event.trials.empty());
  EXPECT_EQ(event.remedy.empty(), event.share == 1) << "a fault has a remedy, what is no fault has none";
  for (const std::uint64_t trials : {1ull, 1000ull, 1000000ull, 1000000000ull}) {
    const std::uint64_t allowed = allowed_count(trials, event.share);
    EXPECT_EQ(complaint(name, 0, trials), "");
    EXPECT_EQ(complaint(name, allowed, trials), "");
    if (event.share == 1) {
      EXPECT_EQ(complaint(name, trials, trials), "");
      continue;
    }
    const std::string said = complaint(name, allowed + 1, trials);
    for (const std::string& part :
         {name, std::to_string(allowed + 1), std::to_string(trials), "at most " + std::to_string(allowed),
          std::string(event.remedy), std::string(event.trials)})
      EXPECT_NE(said.find(part), std::string::npos) << said << " lacks " << part;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OfEvent, testing::ValuesIn(all_events().begin(), all_events().end()),
                         [](const auto& info) {
                           std::string name(info.param.name);
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

// What the sources count is in the table, and what is in the table is counted somewhere.
TEST(Events, AreThoseThatTheSourcesCount) {
  std::set<std::string> known, counted;
  for (const Event& event : all_events()) EXPECT_TRUE(known.insert(std::string(event.name)).second);
  const std::regex counts(R"re((?:count\([^"();]*|const char\* k\w+ =\s*)"([^"]+)")re");
  std::string all;
  for (const char* folder : {"/lib", "/tools"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(PHOS_SOURCE) + folder)) {
      const std::string extension = entry.path().extension().string();
      if ((extension != ".cpp" && extension != ".h") || entry.path().stem() == "events") continue;
      const std::string code = test::slurp(entry.path().string());
      all += code;
      for (std::sregex_iterator i(code.begin(), code.end(), counts), end; i != end; ++i) {
        const std::string call = (*i)[0], name = (*i)[1];
        if (call.starts_with("count")) counted.insert(name);
      }
    }
  for (const char* other : {"first", "total", "POSITION", "measured angles that reflect more than they get",
                            "measured cells without data, filled from the nearest"})
    counted.erase(other);  // counts of other things: of a shard's run, of glTF attributes, of measured data
  for (const std::string& name : counted) EXPECT_TRUE(known.contains(name)) << name << " is not in the table";
  for (const std::string& name : known)
    EXPECT_NE(all.find('"' + name + '"'), std::string::npos) << name << " is counted nowhere";
}

}  // namespace
}  // namespace phos
