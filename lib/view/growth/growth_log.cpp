#include "view/growth/growth_log.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"

namespace phos::inline view {
namespace {

/// Neighbours and bounds settle radius and gradients along the surface; nothing else changes.
bool same(const IrradianceRecord& a, const IrradianceRecord& b) {
  return a.radius_m == b.radius_m &&
         std::equal(std::begin(a.translation_gradient), std::end(a.translation_gradient),
                    std::begin(b.translation_gradient));
}

}  // namespace

void GrowthLog::update(std::vector<IrradianceRecord> now) {
  PHOS_CHECK(now.size() >= records_.size(), now.size(), " records after ", records_.size());
  changed_.resize(now.size(), 0);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (i < records_.size() && same(now[i], records_[i])) continue;
    by_serial_.erase(changed_[i]);
    changed_[i] = ++serial_;
    by_serial_.emplace(serial_, static_cast<std::uint32_t>(i));
  }
  records_ = std::move(now);
}

GrowthLog::Changes GrowthLog::since(std::uint32_t serial, std::size_t most) const {
  Changes changes;
  changes.serial = serial;
  auto next = by_serial_.upper_bound(serial);
  for (; next != by_serial_.end() && changes.rows.size() < most; ++next)
    changes.rows.push_back(next->second), changes.serial = next->first;
  changes.more = next != by_serial_.end();
  return changes;
}

}  // namespace phos::inline view
