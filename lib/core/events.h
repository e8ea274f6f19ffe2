// Every numerical event that a tool counts, in one table: what it says, how often it may happen, and what to
// do where it happens more often.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace phos {

struct Event {
  std::string_view name;
  /// The probability with which one trial may have it. 1: it says something of the scene or of the settings,
  /// and is no fault however often it comes.
  double share;
  std::string_view trials;  ///< what a trial is, in the plural ("samples")
  std::string_view remedy;  ///< of an event whose share is below 1
};

std::span<const Event> all_events();
/// Aborts for a name that is not in the table.
const Event& event_named(std::string_view name);

/// The most events that `trials` of probability `share` have in all but 1e-4 of such runs: the upper 99.99 %
/// quantile of the binomial distribution. `share` in [0, 1].
std::uint64_t allowed_count(std::uint64_t trials, double share);

}  // namespace phos
