#include "record/far_records.h"

#include "record/tree.h"

namespace phos::inline record {

const RecordTree& FarRecords::wide(std::size_t i, RecordTree::Widen widen) const {
  const std::size_t at = i + (widen == RecordTree::Widen::along_plane ? kFactors.size() : 0);
  std::call_once(once_[at], [&] { wide_[at].emplace(records_.widened(kFactors[i], widen)); });
  return *wide_[at];
}

Interpolated FarRecords::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated found;
  if (records_.size() == 0) return found;
  for (std::size_t i = 0; i < kFactors.size() && !(found.weight > 0); ++i)
    found = wide(i, RecordTree::Widen::all_around).interpolate(p, n);
  return found;
}

Rgb FarRecords::irradiance(const Vec3& p, const Vec3& n, float& weight, RecordTree::Widen widen) const {
  Rgb found(0);
  weight = 0;
  if (records_.size() == 0) return found;
  for (std::size_t i = 0; i < kFactors.size() && !(weight > 0); ++i)
    found = wide(i, widen).irradiance(p, n, weight);
  return found;
}

}  // namespace phos::inline record
