#include "view/growth/grown_cache.h"

#include <algorithm>

#include "core/error.h"
#include "view/growth/points_to_grow.h"

namespace phos::inline view {
namespace {

constexpr std::size_t kLeastBatch = 4, kMostBatch = 64;

}  // namespace

GrownCache::GrownCache(const IrradianceCache& covering, const Estimator& estimator, const RayScene& rays,
                       const RecordOptions& resolved, float beside_m)
    : rays_(rays),
      beside_m_(beside_m),
      growth_(covering, rays, resolved),
      maker_(estimator),
      accuracy_(covering.accuracy),
      batch_(kLeastBatch) {
  PHOS_CHECK(!any_footprint(covering.records), "records with footprints");
}

RecordSite GrownCache::site_at(const SurfaceSample& point, std::size_t number) const {
  return {point.position, point.normal, kPointItems + grown_ + number};
}

bool GrownCache::covered(const RecordSite& site, double share) {
  if (share >= 1) return growth_.covered(site);
  const auto accuracy = static_cast<float>(share * accuracy_);
  growth_.tree().valid(site.position, site.normal, found_);
  return std::any_of(found_.begin(), found_.end(), [&](const IrradianceRecord* r) {
    return record_weight(record_error(*r, site.position, site.normal), accuracy) > kLeastWeight;
  });
}

std::size_t GrownCache::grow(std::span<const SurfaceSample> asked, double share) {
  PHOS_CHECK(share > 0 && share <= 1, "share ", share);
  const std::vector<SurfaceSample> points = points_to_grow(rays_, asked, beside_m_);
  const std::size_t before = grown_;
  for (std::size_t begin = 0; begin < points.size();) {
    std::vector<RecordSite> sites;
    std::vector<std::size_t> from;  // of each site: its point
    std::size_t end = begin;
    for (; end < points.size() && sites.size() < batch_; ++end) {
      const RecordSite site = site_at(points[end], sites.size());
      if (!covered(site, share)) sites.push_back(site), from.push_back(end);
    }
    const std::vector<Made> made = maker_.make(sites);
    // A record that is accepted covers points behind it, and may reduce others, which opens points. Where a
    // point is found otherwise than before, later sites get other numbers, and their records are made anew.
    std::size_t kept = 0, i = begin;
    for (; i < end; ++i) {
      const bool has_site = kept < from.size() && from[kept] == i;
      if (covered(site_at(points[i], 0), share) == has_site) break;
      if (has_site) growth_.accept(made[kept++]);
    }
    const bool in_vain = kept < made.size();
    begin = i;
    grown_ += kept;
    batch_ = std::clamp(in_vain ? batch_ / 2 : batch_ * 2, kLeastBatch, kMostBatch);
  }
  return grown_ - before;
}

std::vector<IrradianceRecord> GrownCache::records() {
  std::vector<IrradianceRecord> records;
  records.reserve(grown_);
  growth_.rules().finish(records);
  return records;
}

void GrownCache::count_into(Counters& counters) {
  maker_.count_into(counters);
  growth_.rules().count_into(counters);
}

}  // namespace phos::inline view
