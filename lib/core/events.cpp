#include "core/events.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"

namespace phos {

namespace {

/// Made when the first event is, whichever that is.
std::map<std::string_view, const Event*>& registered() {
  static std::map<std::string_view, const Event*> all;
  return all;
}

/// log n! minus Stirling's formula for it.
double stirling_error(double n) {
  if (n < 16) return std::lgamma(n + 1) - (n + 0.5) * std::log(n) + n - 0.5 * std::log(2 * std::numbers::pi);
  const double n2 = n * n;
  return (1 / 12. - (1 / 360. - 1 / 1260. / n2) / n2) / n;
}

/// x log(x / mean) + mean - x, which is small where the two are near each other.
double deviance(double x, double mean) {
  const double d = (x - mean) / mean;
  if (std::fabs(d) > 0.01) return x * std::log(x / mean) + mean - x;
  double sum = 0, power = d;  // of mean (d^2 / 2 - d^3 / 6 + d^4 / 12 - ...)
  for (int k = 2; k < 12; ++k) power *= k == 2 ? d : -d, sum += power / (k * (k - 1));
  return mean * sum;
}

/// log C(n, k) p^k (1-p)^(n-k), in the form that does not cancel for large n (Loader 2000).
double log_probability(double n, double k, double p) {
  if (k == 0) return n * std::log1p(-p);
  if (k == n) return n * std::log(p);
  return stirling_error(n) - stirling_error(k) - stirling_error(n - k) - deviance(k, n * p) -
         deviance(n - k, n * (1 - p)) + 0.5 * std::log(n / (2 * std::numbers::pi * k * (n - k)));
}

}  // namespace

Event::Event(std::string_view its_name, std::string_view its_trials, double its_share,
             std::string_view its_remedy)
    : name(its_name), trials(its_trials), share(its_share), remedy(its_remedy) {
  PHOS_CHECK(registered().emplace(name, this).second, "event \"", name, "\" is declared twice");
}

std::vector<const Event*> all_events() {
  std::vector<const Event*> all;
  for (const auto& [name, event] : registered()) all.push_back(event);
  return all;
}

std::uint64_t allowed_count(std::uint64_t trials, double share) {
  constexpr double kBeyond = 1e-4;
  PHOS_CHECK(share >= 0 && share <= 1, share);
  if (share == 0 || trials == 0) return 0;
  if (share == 1) return trials;
  const auto n = static_cast<double>(trials);
  // What lies 12 standard deviations below the mean is 0 in doubles. The tail is summed from its far end, so
  // that nothing cancels.
  const double mean = n * share, deviation = std::sqrt(mean * (1 - share));
  const double last = std::min(n, std::ceil(mean + 12 * deviation + 40));
  const double first = std::max(0.0, std::floor(mean - deviation));
  double tail = 0, k = last;
  for (double p = std::exp(log_probability(n, k, share)); k > first; --k) {
    if (tail + p > kBeyond) break;  // P(X >= k) is more than that: k itself is allowed
    tail += p;
    p *= k / (n - k + 1) * ((1 - share) / share);
  }
  return static_cast<std::uint64_t>(k);
}

}  // namespace phos
