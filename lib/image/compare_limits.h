// How much images may differ: the limits of phos-compare.
#pragma once

#include <span>
#include <string>

#include "core/options.h"
#include "image/flicker.h"
#include "image/metrics.h"

namespace phos::inline image {

/// Limits that were given. A pixel that is not finite breaks every one, and none.
class CompareLimits {
 public:
  /// --max-... and --min-...; `this` must outlive the options.
  void declare(Options& options);
  /// Throws Error(usage) for a limit on a measure that is not computed: for one image pair (flicker), or for
  /// a sequence.
  void require_measured(bool sequence) const;
  /// What is wrong, in one line; "" if nothing is.
  std::string verdict(std::span<const LayerMetrics> layers) const;
  std::string verdict(std::span<const FlickerMetrics> layers) const;

 private:
  static constexpr std::size_t kLimits = 12;
  std::optional<double> values_[kLimits];
};

}  // namespace phos::inline image
