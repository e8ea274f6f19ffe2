// Light for points that no record reaches.
#pragma once

#include <array>
#include <mutex>
#include <optional>

#include "cache/irradiance_cache.h"

namespace phos {

/// Looks beyond the records' reach: to twice as far, then to four times. What is found is less exact than the
/// accuracy that was asked for, and better than dark; callers count such points as missed all the same. The
/// wider trees are made when they are first needed. Usable from any thread; holds a reference.
class FarRecords {
 public:
  explicit FarRecords(const RecordTree& records) : records_(records) {}
  /// weight 0: nothing there either.
  Interpolated interpolate(const Vec3& p, const Vec3& n) const;
  /// The irradiance of interpolate() alone, as RecordTree::irradiance().
  Rgb irradiance(const Vec3& p, const Vec3& n, float& weight) const;

 private:
  /// The tree of factor i.
  const RecordTree& wide(std::size_t i) const;

  static constexpr std::array<double, 2> kFactors{2, 4};
  const RecordTree& records_;
  mutable std::array<std::once_flag, kFactors.size()> once_;
  mutable std::array<std::optional<RecordTree>, kFactors.size()> wide_;
};

}  // namespace phos
