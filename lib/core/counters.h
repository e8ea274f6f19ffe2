// Numerical events: what happened, how often, out of how many, and how often it may.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace phos {

/// Counts of events such as "degenerate hull" or "non-finite sample". Not thread-safe: one per chunk, merged
/// in order. Counts go into file headers and --stats; they are integers, so the order of merging does not
/// matter.
class Counters {
 public:
  void count(const std::string& event, std::uint64_t times = 1) { counts_[event] += times; }
  void merge(const Counters& other) {
    for (const auto& [event, n] : other.counts_) counts_[event] += n;
  }
  std::uint64_t operator[](const std::string& event) const;
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

  /// Throws Error(numerical) if the event happened in more than `fraction` of `trials`; says how often and
  /// `remedy`.
  void require_at_most(const std::string& event, double fraction, std::uint64_t trials,
                       const std::string& remedy) const;

 private:
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace phos
