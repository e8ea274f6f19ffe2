#include "cache/far_records.h"

namespace phos {

Interpolated FarRecords::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated found;
  if (records_.size() == 0) return found;
  for (std::size_t i = 0; i < kFactors.size() && !(found.weight > 0); ++i) {
    std::call_once(once_[i], [&] { wide_[i].emplace(records_.widened(kFactors[i])); });
    found = wide_[i]->interpolate(p, n);
  }
  return found;
}

}  // namespace phos
