#include "cache/growth.h"

#include <algorithm>

#include "cache/radiance_cache.h"
#include "core/error.h"

namespace phos {

RadiusBounds bounds_of(const RecordOptions& resolved) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
  return {static_cast<float>(*resolved.min_radius_m), static_cast<float>(*resolved.max_radius_m)};
}

void RadiusRules::keep(const IrradianceRecord& record) {
  PHOS_CHECK(kept_ == made_.size(), "kept after ", made_.size() - kept_, " new ones");
  clamp_.insert(record.position, record.normal, record.radius_m, true, [](std::size_t, float) {});
  made_.push_back({record, record.radius_m});
  ++kept_;
}

float RadiusRules::add(const Made& made, const std::function<void(std::size_t, float)>& shrunk) {
  const IrradianceRecord& record = made.record;
  const float radius =
      clamp_.insert(record.position, record.normal, record.radius_m, false, [&](std::size_t i, float raw_m) {
        ++clamped_to_neighbour_;
        shrunk(i, within_bounds(raw_m, made_[i]));
      });
  if (radius < record.radius_m) ++clamped_to_neighbour_;
  made_.push_back(made);
  return within_bounds(radius, made);
}

void RadiusRules::finish(std::vector<IrradianceRecord>& records, std::vector<RadianceRecord>* radiance) {
  for (std::size_t i = kept_; i < made_.size(); ++i) {
    IrradianceRecord r = made_[i].record;
    const float raw = clamp_.radius_m(i);
    r.radius_m = within_bounds(raw, made_[i]);
    const bool raised = raw < r.radius_m;
    const float slope = raised ? raw / r.radius_m : 1;  // what is left of gradients
    if (raised) {
      ++raised_to_least_;
      for (Vec3& g : r.translation_gradient) g *= slope;
    }
    records.push_back(r);
    if (!radiance || !made_[i].radiance) continue;
    RadianceRecord& full = radiance->emplace_back(*made_[i].radiance);
    full.radius_m = r.radius_m;
    if (!raised) continue;
    for (float& g : full.gradient_x) g *= slope;
    for (float& g : full.gradient_y) g *= slope;
  }
}

void RadiusRules::count_into(Counters& counters) const {
  if (clamped_to_neighbour_ > 0) counters.count("radii clamped to a neighbour", clamped_to_neighbour_);
  if (raised_to_least_ > 0) counters.count("radii raised to the smallest", raised_to_least_);
}

float RadiusRules::within_bounds(float radius_m, const Made& made) const {
  const float radius = std::clamp(std::max(radius_m, made.least_radius_m), made.site_least_m,
                                  std::max(made.site_least_m, made.site_most_m));
  return std::clamp(radius, bounds_.least_m, bounds_.most_m);
}

Growth::Growth(const IrradianceCache& cache, const RayScene& rays, const RecordOptions& resolved)
    : tree_(rays.scene().bounds, cache.accuracy, resolved.leak_test == LeakTest::ray ? &rays : nullptr),
      rules_(rays.scene().bounds, bounds_of(resolved)) {
  for (const IrradianceRecord& r : cache.records) {
    tree_.insert(r);
    rules_.keep(r);
  }
}

void Growth::accept(const Made& made) {
  IrradianceRecord placed = made.record;
  placed.radius_m = rules_.add(made, [&](std::size_t i, float radius_m) {
    if (radius_m < tree_.records()[i].radius_m) tree_.shrink(i, radius_m);
  });
  tree_.insert(placed);
}

}  // namespace phos
