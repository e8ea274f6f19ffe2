// Numerical events. Each module declares in its events.h the events that it counts: the name of an event, how
// often it may happen, and the remedy where it happens more often.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace phos {

/// An event. It is declared once, as a constant that lives as long as the program. Two events of one name
/// abort.
class Event {
 public:
  /// An event that describes the scene or the settings, and is no fault however often it happens. `trials`:
  /// the name of the trials ("samples").
  Event(std::string_view name, std::string_view trials) : Event(name, trials, 1, "") {}
  /// A fault that one trial may have with the probability `share`, which is below 1.
  Event(std::string_view name, std::string_view trials, double share, std::string_view remedy);
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  const std::string_view name, trials;
  const double share;
  const std::string_view remedy;  ///< "" where the share is 1
};

/// The share of a rounding that went wrong, once in a million.
inline constexpr double kRare = 1e-6;

/// Every event that the program declares, by name.
std::vector<const Event*> all_events();

/// The most events that `trials` of probability `share` have in all but 1e-4 of such runs: the upper 99.99 %
/// quantile of the binomial distribution. `share` in [0, 1].
std::uint64_t allowed_count(std::uint64_t trials, double share);

}  // namespace phos
