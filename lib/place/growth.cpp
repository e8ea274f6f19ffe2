#include "place/growth.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "place/events.h"
#include "radiance/cache.h"
#include "scene/rays.h"

namespace phos::inline place {
namespace {

/// What circles may foretell wrongly, of the light.
constexpr float kTolerance = 0.1f;

}  // namespace

RadiusBounds bounds_of(const RecordOptions& resolved) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
  return {static_cast<float>(*resolved.min_radius_m), static_cast<float>(*resolved.max_radius_m)};
}

void RadiusRules::keep(const IrradianceRecord& record) {
  PHOS_CHECK(kept_ == made_.size(), "kept after ", made_.size() - kept_, " new ones");
  clamp_.insert(record.position, record.normal, record.footprint ? kInfinity : record.radius_m, true,
                [](std::size_t, float) {});
  made_.push_back({record, record.radius_m});
  limit_m_.push_back(kInfinity);
  ++kept_;
}

float RadiusRules::add(const Made& made, const std::function<void(std::size_t, float)>& shrunk) {
  const IrradianceRecord& record = made.record;
  if (record.footprint) {
    clamp_.insert(record.position, record.normal, kInfinity, true, [](std::size_t, float) {});
    made_.push_back(made);
    limit_m_.push_back(kInfinity);
    return record.radius_m;
  }
  const float radius =
      clamp_.insert(record.position, record.normal, record.radius_m, false, [&](std::size_t i, float raw_m) {
        ++clamped_to_neighbour_;
        shrunk(i, within_bounds_m(std::min(raw_m, limit_m_[i]), made_[i], bounds_));
      });
  if (radius < record.radius_m) ++clamped_to_neighbour_;
  made_.push_back(made);
  limit_m_.push_back(kInfinity);
  return within_bounds_m(radius, made, bounds_);
}

float RadiusRules::limit(std::size_t record, float radius_m) {
  PHOS_CHECK(record >= kept_, "record ", record, " is to stay as it is");
  limit_m_[record] = std::min(limit_m_[record], radius_m);
  return this->radius_m(record);
}

float RadiusRules::lower(std::size_t record, float radius_m) {
  PHOS_CHECK(record >= kept_, "record ", record, " is to stay as it is");
  clamp_.lower(record, radius_m);
  return this->radius_m(record);
}

float RadiusRules::radius_m(std::size_t i) const {
  const IrradianceRecord& r = made_[i].record;
  if (!r.footprint) return within_bounds_m(std::min(clamp_.radius_m(i), limit_m_[i]), made_[i], bounds_);
  return std::min(r.radius_m, std::max(limit_m_[i], least_radius_m(bounds_, r)));
}

void RadiusRules::finish(std::vector<IrradianceRecord>& records, std::vector<RadianceRecord>* radiance) {
  raised_to_least_ = 0;
  for (std::size_t i = kept_; i < made_.size(); ++i) {
    IrradianceRecord r = made_[i].record;
    r.radius_m = radius_m(i);
    if (r.footprint) {
      records.push_back(r);
      if (radiance && made_[i].radiance) radiance->emplace_back(*made_[i].radiance).radius_m = r.radius_m;
      continue;
    }
    const float raw = std::min(clamp_.radius_m(i), limit_m_[i]);
    const bool raised = raw < r.radius_m;
    const float slope = raised ? raw / r.radius_m : 1;  // the part of gradients that is left
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
  if (clamped_to_neighbour_ > 0) counters.count(kClampedEvent, clamped_to_neighbour_);
  if (raised_to_least_ > 0) counters.count(kRaisedEvent, raised_to_least_);
}

float least_radius_m(const RadiusBounds& bounds, const IrradianceRecord& shaped) {
  return bounds.least_m * (shaped.footprint->longest_m() / shaped.footprint->shortest_m());
}

float within_bounds_m(float radius_m, const Made& made, const RadiusBounds& bounds) {
  const float least_m = made.least_share * made.site_least_m;
  const float radius =
      std::clamp(std::max(radius_m, made.least_radius_m), least_m, std::max(least_m, made.site_most_m));
  return std::clamp(radius, bounds.least_m, bounds.most_m);
}

Growth::Growth(const IrradianceCache& cache, const RayScene& rays, const RecordOptions& resolved, GrowthBy by)
    : tree_(rays.scene().bounds, cache.accuracy, resolved.leak_test == LeakTest::ray ? &rays : nullptr),
      rules_(by == GrowthBy::error ? RadiusRules(rays.scene().bounds, bounds_of(resolved), ClampBy::judged,
                                                 std::min(1.f, 0.5f / static_cast<float>(resolved.accuracy)))
                                   : RadiusRules(rays.scene().bounds, bounds_of(resolved))),
      accuracy_(static_cast<float>(resolved.accuracy)),
      reading_accuracy_(static_cast<float>(reading_accuracy(cache.accuracy))),
      most_m_(static_cast<float>(*resolved.max_radius_m)),
      kept_(cache.records.size()),
      by_(by) {
  if (resolved.footprint == Footprint::circle_harmonic) tolerance_ = kTolerance;
  if (resolved.footprint == Footprint::adaptive) tolerance_ = 2 * static_cast<float>(resolved.rho);
  if (tolerance_) as_read_.emplace(rays.scene().bounds, reading_accuracy(cache.accuracy));
  for (const IrradianceRecord& r : cache.records) {
    tree_.insert(r);
    rules_.keep(r);
    if (as_read_) as_read_->insert(r);
  }
}

void Growth::accept(const Made& made) {
  Made start = made;
  IrradianceRecord& placed = start.record;
  if (by_ == GrowthBy::error)
    placed.radius_m = std::min(kStartReach * std::min(placed.distance_m, made.light_m) / accuracy_, most_m_);
  placed.radius_m = rules_.add(start, [&](std::size_t i, float radius_m) { shrink(i, radius_m); });
  tree_.insert(placed);
  if (as_read_) as_read_->insert(placed);
}

bool Growth::lower(std::size_t record, float radius_m) {
  const float before_m = tree_.records()[record].radius_m;
  shrink(record, rules_.lower(record, radius_m));
  return tree_.records()[record].radius_m < before_m;
}

void Growth::shrink(std::size_t i, float radius_m) {
  if (!(radius_m < tree_.records()[i].radius_m)) return;
  tree_.shrink(i, radius_m);
  if (shrunk_in_.size() <= i) shrunk_in_.resize(i + 1, 0);
  shrunk_in_[i] = pass_;
  if (as_read_) as_read_->shrink(i, radius_m);
}

std::size_t Growth::compare() {
  if (!as_read_) return 0;
  const std::span<const IrradianceRecord> all = as_read_->records();
  struct Wrong {
    std::size_t record;
    float radius_m;
  };
  const std::vector<Wrong> wrong = parallel_reduce<std::vector<Wrong>>(
      all.size(), 64, {},
      [&](std::size_t begin, std::size_t end) {
        std::vector<Wrong> found;
        std::vector<const IrradianceRecord*> valid;
        for (std::size_t i = begin; i < end; ++i) {
          const IrradianceRecord& there = all[i];
          const float light = luminance(there.irradiance), noise = luminance(there.stderr_lx);
          as_read_->valid(there.position, there.normal, valid);
          for (const IrradianceRecord* r : valid) {
            const auto k = static_cast<std::size_t>(r - all.data());
            if (k == i || k < kept_) continue;
            const float foretold = luminance(extrapolate(*r, there.position, there.normal));
            const float allowed =
                *tolerance_ * std::max(light, foretold) + 2 * std::hypot(noise, luminance(r->stderr_lx));
            if (std::fabs(foretold - light) <= allowed) continue;
            const float turn = turn_error(glm::length(there.normal - r->normal));
            const float apart = record_error(*r, there.position, there.normal) - turn;
            const float share = apart / std::max(reading_accuracy_ - turn, std::numeric_limits<float>::min());
            found.push_back({k, r->radius_m * std::clamp(share, 0.5f, 1.f)});
          }
        }
        return found;
      },
      [](std::vector<Wrong>& sum, const std::vector<Wrong>& part) {
        sum.insert(sum.end(), part.begin(), part.end());
      });
  std::size_t shrunk = 0;
  std::vector<float> before;
  for (const IrradianceRecord& r : all) before.push_back(r.radius_m);
  for (const Wrong& w : wrong) shrink(w.record, rules_.limit(w.record, w.radius_m));
  for (std::size_t i = 0; i < before.size(); ++i) shrunk += as_read_->records()[i].radius_m < before[i];
  return shrunk;
}

}  // namespace phos::inline place
