#include "cache/far_records.h"

namespace phos {

const RecordTree& FarRecords::wide(std::size_t i) const {
  std::call_once(once_[i], [&] { wide_[i].emplace(records_.widened(kFactors[i])); });
  return *wide_[i];
}

Interpolated FarRecords::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated found;
  if (records_.size() == 0) return found;
  for (std::size_t i = 0; i < kFactors.size() && !(found.weight > 0); ++i) found = wide(i).interpolate(p, n);
  return found;
}

Rgb FarRecords::irradiance(const Vec3& p, const Vec3& n, float& weight) const {
  Rgb found(0);
  weight = 0;
  if (records_.size() == 0) return found;
  for (std::size_t i = 0; i < kFactors.size() && !(weight > 0); ++i) found = wide(i).irradiance(p, n, weight);
  return found;
}

}  // namespace phos
