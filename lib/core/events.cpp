#include "core/events.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos {

namespace {

constexpr double kAny = 1;
constexpr double kRare = 1e-6;  // a rounding that went wrong, once in a million
constexpr std::string_view kLookAtLights = "look for extreme values in materials and lights with phos-scene";

constexpr Event kEvents[] = {
    // Photons.
    {"photon left the scene", kAny, "paths", ""},
    {"photon with non-finite flux", kRare, "photons", "check the powers of the lights and the materials"},
    {"photon path of 65535 bounces ended", kRare, "photons",
     "a material reflects all of its light: lower its reflectance"},
    // Estimates by rays.
    {"non-finite sample", kRare, "samples", kLookAtLights},
    {"non-finite BRDF value", kRare, "values",
     "check the exponents, roughness and tables of the glossy materials"},
    {"BRDF lobe not resolved by quadrature", kAny, "directions", ""},
    {"BRDF with an albedo above 1", kAny, "directions", ""},
    {"gathered paths cut", kAny, "rays", ""},
    {"specular paths cut", kAny, "samples", ""},
    {"gathered irradiance below zero", kAny, "records", ""},
    {"gathered places without a record", kAny, "rays", ""},
    {"gathered places beyond the reach of records", kAny, "rays", ""},
    {"gathered glossy places without a radiance record", kAny, "rays", ""},
    {"harmonic light below zero", kAny, "samples", ""},
    // Records and their places.
    {"records above the asked error", kAny, "records", ""},
    {"records at an occlusion gradient", kAny, "records", ""},
    {"records at a shadow edge", kAny, "records", ""},
    {"records beside a wall", kAny, "records", ""},
    {"records from a kernel", kAny, "records", ""},
    {"records from the hull", kAny, "records", ""},
    {"records fully lit", kAny, "records", ""},
    {"records in the dark", kAny, "records", ""},
    {"records probed", kAny, "records", ""},
    {"records with degenerate hull", kAny, "records", ""},
    {"records with shrunk zone", kAny, "records", ""},
    {"records with too few photons", kAny, "records", ""},
    {"records without photons", kAny, "records", ""},
    {"axes of footprints left unresolved", kAny, "axes", ""},
    {"candidates left uncovered", kAny, "candidates", ""},
    {"radii clamped to a neighbour", kAny, "records", ""},
    {"radii raised to the smallest", kAny, "records", ""},
    {"sides inside solids passed over", kAny, "sides", ""},
    // Films.
    {"place without a surface", kAny, "places", ""},
    {"record without a surface", kAny, "records", ""},
    {"records traced one frame ahead", kAny, "records", ""},
    // Pictures.
    {"non-finite pixel", kAny, "pixels", ""},
    {"point that cannot be shown", kAny, "points", ""},
};

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

std::span<const Event> all_events() { return kEvents; }

const Event& event_named(std::string_view name) {
  const auto* found = std::find_if(std::begin(kEvents), std::end(kEvents),
                                   [&](const Event& event) { return event.name == name; });
  PHOS_CHECK(found != std::end(kEvents), "\"", name, "\" is not in the table of events");
  return *found;
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
