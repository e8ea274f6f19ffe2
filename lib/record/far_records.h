// Light for points that no record reaches.
#pragma once

#include <array>
#include <mutex>
#include <optional>

#include "record/irradiance_cache.h"

#include "record/tree.h"

namespace phos::inline record {

/// Looks beyond the records' reach: to twice as far, then to four times. What is found is less exact than the
/// accuracy that was asked for, and better than dark; callers count such points as missed all the same. The
/// wider trees are made when they are first needed. Usable from any thread; holds a reference.
class FarRecords {
 public:
  explicit FarRecords(const RecordTree& records) : records_(records) {}
  /// weight 0: nothing there either.
  Interpolated interpolate(const Vec3& p, const Vec3& n) const;
  /// The irradiance of interpolate() alone, as RecordTree::irradiance(). Along their planes alone records
  /// reach farther with `widen` so: no surface is lit by another one that faces the same way.
  Rgb irradiance(const Vec3& p, const Vec3& n, float& weight,
                 RecordTree::Widen widen = RecordTree::Widen::all_around) const;

 private:
  /// The tree of factor i.
  const RecordTree& wide(std::size_t i, RecordTree::Widen widen) const;

  static constexpr std::array<double, 2> kFactors{2, 4};
  const RecordTree& records_;
  mutable std::array<std::once_flag, 2 * kFactors.size()> once_;  // all around, then along planes
  mutable std::array<std::optional<RecordTree>, 2 * kFactors.size()> wide_;
};

}  // namespace phos::inline record
