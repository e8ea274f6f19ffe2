// Counts of numerical events and of their trials.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/events.h"

namespace phos {

/// Counts of events (core/events.h). Not thread-safe: one per chunk, merged
/// in order. Counts go into file headers and --stats; they are integers, so the order of merging does not
/// matter.
class Counters {
 public:
  void count(const Event& event, std::uint64_t times = 1) { counts_[std::string(event.name)] += times; }
  /// A count that stands in a file; another version of the program may have other events.
  void add(const std::string& event, std::uint64_t times = 1) { counts_[event] += times; }
  void merge(const Counters& other) {
    for (const auto& [event, n] : other.counts_) counts_[event] += n;
  }
  std::uint64_t operator[](const Event& event) const { return (*this)[std::string(event.name)]; }
  std::uint64_t operator[](const std::string& event) const;
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

  /// Throws Error(numerical) if the event happened more often than it may in this many trials; says how
  /// often, how often it may, and what to do.
  void require_allowed(const Event& event, std::uint64_t trials) const;

 private:
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace phos
