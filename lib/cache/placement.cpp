#include "cache/placement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "cache/neighbour_clamp.h"
#include "cache/record_maker.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"

namespace phos {
namespace {

constexpr std::uint64_t kPointItems = std::uint64_t{1}
                                      << 40;  // random streams of points, apart from those of photons
constexpr std::size_t kChunk = 4;             // records made by one task
constexpr std::size_t kLeastBatch = 16, kMostBatch = 1024;

/// The cache while it grows: lookup, radii clamped to neighbours, and records as made.
class Growth {
 public:
  Growth(const IrradianceCache& cache, const RayScene& rays, const RecordOptions& options)
      : tree_(rays.scene().bounds, cache.accuracy, options.leak_test == LeakTest::ray ? &rays : nullptr),
        clamp_(rays.scene().bounds),
        options_(options),
        frozen_(cache.records.size()) {
    for (const IrradianceRecord& r : cache.records) {
      tree_.insert(r);
      made_.push_back({r, r.radius_m});
      clamp_.insert(r.position, r.normal, r.radius_m, true, [](std::size_t, float) {});
    }
  }

  bool covered(const RecordSite& site) const { return tree_.covered(site.position, site.normal); }

  void accept(const Made& made, PlacementReport& report) {
    const IrradianceRecord& record = made.record;
    const float radius = clamp_.insert(record.position, record.normal, record.radius_m, false,
                                       [&](std::size_t i, float smaller) {
                                         const float final_m = within_limits(smaller, made_[i]);
                                         if (final_m < tree_.records()[i].radius_m) tree_.shrink(i, final_m);
                                         ++report.clamped_to_neighbour;
                                       });
    if (radius < record.radius_m) ++report.clamped_to_neighbour;
    made_.push_back(made);
    IrradianceRecord placed = record;
    placed.radius_m = within_limits(radius, made);
    tree_.insert(placed);
  }

  /// New records with their final radii; where the smallest radius allowed is larger than the right one,
  /// gradients are reduced so that extrapolation stays bounded (A7).
  void finish(std::vector<IrradianceRecord>& records, PlacementReport& report) const {
    for (std::size_t i = frozen_; i < made_.size(); ++i) {
      IrradianceRecord r = made_[i].record;
      const float raw = clamp_.radius_m(i);
      r.radius_m = within_limits(raw, made_[i]);
      if (raw < r.radius_m) {
        ++report.clamped_to_least;
        for (Vec3& g : r.translation_gradient) g *= raw / r.radius_m;
      }
      records.push_back(r);
    }
    report.kept = made_.size() - frozen_;
  }
  std::size_t size() const { return made_.size(); }

 private:
  float within_limits(float radius_m, const Made& made) const {
    const float radius = std::clamp(std::max(radius_m, made.least_radius_m), made.site_least_m,
                                    std::max(made.site_least_m, made.site_most_m));
    return std::clamp(radius, static_cast<float>(*options_.min_radius_m),
                      static_cast<float>(*options_.max_radius_m));
  }
  RecordTree tree_;
  NeighbourClamp clamp_;
  const RecordOptions& options_;
  std::vector<Made> made_;  // radius before clamping
  std::size_t frozen_;
};

class Placer {
 public:
  Placer(const Estimator& estimator, Growth& growth, PlacementReport& report)
      : estimator_(estimator), growth_(growth), report_(report) {}

  /// One pass over n candidates. Returns how many it had to cover.
  std::size_t pass(const Candidates& candidates, int number) {
    const std::size_t n = candidates.count;
    Progress progress(number == 1 ? "records" : text("records, pass ", number), n, "candidates");
    std::size_t placed = 0;
    for (std::size_t begin = 0; begin < n;) {
      const std::size_t block = std::min(n - begin, std::clamp<std::size_t>(4 * growth_.size(), 64, 16384));
      placed += cover(open_candidates(begin, begin + block, candidates));
      begin += block;
      progress.advance(block);
    }
    return placed;
  }

  /// What happened in all threads together.
  void count_into(Counters& counters) const {
    for (const auto& worker : workers_) counters.merge(worker->counters);
  }

 private:
  std::vector<RecordSite> open_candidates(std::size_t begin, std::size_t end,
                                          const Candidates& candidates) const {
    std::vector<std::uint8_t> open(end - begin);
    parallel_for(end - begin, 256,
                 [&](std::size_t i) { open[i] = !growth_.covered(candidates.site(begin + i)); });
    std::vector<RecordSite> left;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i]) left.push_back(candidates.site(begin + i));
    }
    return left;
  }

  /// Makes and accepts in batches. A batch grows while its records keep clear of each other and shrinks when
  /// they cover each other's places, so that few are made in vain.
  std::size_t cover(const std::vector<RecordSite>& open) {
    std::size_t placed = 0;
    for (std::size_t begin = 0; begin < open.size();) {
      std::vector<RecordSite> batch;
      for (; begin < open.size() && batch.size() < batch_size_; ++begin) {
        if (!growth_.covered(open[begin])) batch.push_back(open[begin]);
      }
      const auto start = std::chrono::steady_clock::now();
      const std::vector<Made> made = make(batch);
      report_.making_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < made.size(); ++i) {
        if (growth_.covered(batch[i])) continue;
        growth_.accept(made[i], report_);
        ++kept;
      }
      const bool in_vain = kept * 10 < made.size() * 9;
      batch_size_ = std::clamp(in_vain ? batch_size_ / 2 : batch_size_ * 2, kLeastBatch, kMostBatch);
      placed += kept;
      report_.made += made.size();
    }
    return placed;
  }

  std::vector<Made> make(const std::vector<RecordSite>& batch) {
    std::vector<Made> made(batch.size());
    const auto run = [&](std::size_t begin, std::size_t end) {
      std::unique_ptr<Estimator::Worker> worker = take_worker();
      for (std::size_t i = begin; i < end; ++i) made[i] = estimator_.make(batch[i], *worker);
      give_back(std::move(worker));
    };
    if (estimator_.one_thread())
      run(0, batch.size());
    else
      parallel_chunks(batch.size(), kChunk, run);
    return made;
  }

  std::unique_ptr<Estimator::Worker> take_worker() {
    const std::lock_guard lock(mutex_);
    if (workers_.empty()) return estimator_.make_worker();
    std::unique_ptr<Estimator::Worker> worker = std::move(workers_.back());
    workers_.pop_back();
    return worker;
  }
  void give_back(std::unique_ptr<Estimator::Worker> worker) {
    const std::lock_guard lock(mutex_);
    workers_.push_back(std::move(worker));
  }

  const Estimator& estimator_;
  Growth& growth_;
  PlacementReport& report_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Estimator::Worker>> workers_;  // idle ones
  std::size_t batch_size_ = kLeastBatch;
};

}  // namespace

Candidates photon_candidates(const PhotonMap& photons, Quantity wanted, std::uint64_t seed,
                             std::int64_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  for (std::uint32_t row = 0; row < photons.size(); ++row) {
    if (is_wanted(photons, row, wanted))
      keyed.emplace_back(RandomStream(seed, Stage::placement, row).bits(), row);
  }
  std::sort(keyed.begin(), keyed.end());
  if (most > 0 && keyed.size() > static_cast<std::size_t>(most)) keyed.resize(static_cast<std::size_t>(most));
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, row] : keyed) order.push_back(row);
  return {order.size(), [&photons, order = std::move(order)](std::size_t i) {
            const std::uint32_t row = order[i];
            return RecordSite{photons.position[row], decode_octahedral(photons.normal[row]), row, row};
          }};
}

Candidates point_candidates(std::span<const SurfaceSample> points) {
  return {points.size(), [points](std::size_t i) {
            return RecordSite{points[i].position, points[i].normal, kPointItems + i};
          }};
}

void declare_options(Options& options, PlacementOptions& p) {
  options.section("Placement");
  options.integer("max-candidates", p.max_candidates, "N", "photons tried as places for records; 0: all",
                  {0, 1e12});
  options.integer("passes", p.passes, "N", "passes over the candidates at most", {1, 100});
}

PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters) {
  PlacementReport report;
  report.candidates = candidates.count;
  Growth growth(cache, rays, resolved);
  Placer placer(estimator, growth, report);
  for (int pass = 1; pass <= placement.passes; ++pass) {
    report.passes = static_cast<std::uint64_t>(pass);
    if (placer.pass(candidates, pass) == 0) break;
  }
  report.uncovered = parallel_reduce<std::uint64_t>(
      candidates.count, 4096, 0,
      [&](std::size_t begin, std::size_t end) {
        std::uint64_t open = 0;
        for (std::size_t i = begin; i < end; ++i) open += !growth.covered(candidates.site(i));
        return open;
      },
      [](std::uint64_t& total, std::uint64_t part) { total += part; });
  growth.finish(cache.records, report);

  placer.count_into(counters);
  const auto count = [&](const char* event, std::uint64_t times) {
    if (times > 0) counters.count(event, times);
  };
  count("radii clamped to a neighbour", report.clamped_to_neighbour);
  count("radii raised to the smallest", report.clamped_to_least);
  count("candidates left uncovered", report.uncovered);
  return report;
}

}  // namespace phos
