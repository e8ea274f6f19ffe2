#include "cache/placement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "cache/neighbour_clamp.h"
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

struct Candidate {
  Vec3 p, n;
  std::uint64_t item;
  std::uint32_t row;  // photon, or RecordMaker::kNoPhoton
};

/// Photons in an order drawn from the seed.
std::vector<std::uint32_t> shuffled(const RecordMaker& maker, const PhotonMap& photons, std::uint64_t seed,
                                    std::int64_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  for (std::uint32_t row = 0; row < photons.size(); ++row) {
    if (maker.wanted(row)) keyed.emplace_back(RandomStream(seed, Stage::placement, row).bits(), row);
  }
  std::sort(keyed.begin(), keyed.end());
  if (most > 0 && keyed.size() > static_cast<std::size_t>(most)) keyed.resize(static_cast<std::size_t>(most));
  std::vector<std::uint32_t> order;
  for (const auto& [key, row] : keyed) order.push_back(row);
  return order;
}

/// The cache while it grows: lookup, radii clamped to neighbours, and records as made.
class Growth {
 public:
  Growth(const IrradianceCache& cache, const Bounds& bounds, const RecordMaker& maker)
      : tree_(bounds, cache.accuracy), clamp_(bounds), maker_(maker), frozen_(cache.records.size()) {
    for (const IrradianceRecord& r : cache.records) {
      tree_.insert(r);
      made_.push_back({r, r.radius_m});
      clamp_.insert(r.position, r.normal, r.radius_m, true, [](std::size_t, float) {});
    }
  }

  bool covered(const Candidate& c) const { return tree_.covered(c.p, c.n); }

  void accept(const RecordMaker::Made& made, PlacementReport& report) {
    const IrradianceRecord& record = made.record;
    const float radius = clamp_.insert(
        record.position, record.normal, record.radius_m, false, [&](std::size_t i, float smaller) {
          const float final_m = within_limits(smaller, made_[i].least_radius_m);
          if (final_m < tree_.records()[i].radius_m) tree_.shrink(i, final_m);
          ++report.clamped_to_neighbour;
        });
    if (radius < record.radius_m) ++report.clamped_to_neighbour;
    made_.push_back(made);
    IrradianceRecord placed = record;
    placed.radius_m = within_limits(radius, made.least_radius_m);
    tree_.insert(placed);
  }

  /// New records with their final radii; where the smallest radius allowed is larger than the right one,
  /// gradients are reduced so that extrapolation stays bounded (A7).
  void finish(std::vector<IrradianceRecord>& records, PlacementReport& report) const {
    for (std::size_t i = frozen_; i < made_.size(); ++i) {
      IrradianceRecord r = made_[i].record;
      const float raw = clamp_.radius_m(i);
      r.radius_m = within_limits(raw, made_[i].least_radius_m);
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
  float within_limits(float radius_m, float least_m) const {
    return std::clamp(std::max(radius_m, least_m), static_cast<float>(*maker_.options().min_radius_m),
                      static_cast<float>(*maker_.options().max_radius_m));
  }
  RecordTree tree_;
  NeighbourClamp clamp_;
  const RecordMaker& maker_;
  std::vector<RecordMaker::Made> made_;  // radius before clamping
  std::size_t frozen_;
};

class Placer {
 public:
  Placer(const RecordMaker& maker, Growth& growth, PlacementReport& report)
      : maker_(maker), growth_(growth), report_(report) {}

  /// One pass over n candidates. Returns how many it had to cover.
  std::size_t pass(std::size_t n, const std::function<Candidate(std::size_t)>& candidate, int number) {
    Progress progress(number == 1 ? "records" : text("records, pass ", number), n, "candidates");
    std::size_t placed = 0;
    for (std::size_t begin = 0; begin < n;) {
      const std::size_t block = std::min(n - begin, std::clamp<std::size_t>(4 * growth_.size(), 64, 16384));
      placed += cover(open_candidates(begin, begin + block, candidate));
      begin += block;
      progress.advance(block);
    }
    return placed;
  }

  RecordEvents events;

 private:
  std::vector<Candidate> open_candidates(std::size_t begin, std::size_t end,
                                         const std::function<Candidate(std::size_t)>& candidate) const {
    std::vector<std::uint8_t> open(end - begin);
    parallel_for(end - begin, 256, [&](std::size_t i) { open[i] = !growth_.covered(candidate(begin + i)); });
    std::vector<Candidate> left;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i]) left.push_back(candidate(begin + i));
    }
    return left;
  }

  /// Makes and accepts in batches. A batch grows while its records keep clear of each other and shrinks when
  /// they cover each other's places, so that few are made in vain.
  std::size_t cover(const std::vector<Candidate>& open) {
    std::size_t placed = 0;
    for (std::size_t begin = 0; begin < open.size();) {
      std::vector<Candidate> batch;
      for (; begin < open.size() && batch.size() < batch_size_; ++begin) {
        if (!growth_.covered(open[begin])) batch.push_back(open[begin]);
      }
      const auto start = std::chrono::steady_clock::now();
      const std::vector<RecordMaker::Made> made = make(batch);
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

  std::vector<RecordMaker::Made> make(const std::vector<Candidate>& batch) {
    std::vector<RecordMaker::Made> made(batch.size());
    std::mutex mutex;
    parallel_chunks(batch.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      thread_local RecordMaker::Scratch scratch;
      scratch.events = {};
      for (std::size_t i = begin; i < end; ++i) {
        made[i] = maker_.make(batch[i].p, batch[i].n, batch[i].item, batch[i].row, scratch);
      }
      const std::lock_guard lock(mutex);
      for (std::size_t e = 0; e < events.n.size(); ++e) events.n[e] += scratch.events.n[e];
    });
    return made;
  }

  const RecordMaker& maker_;
  Growth& growth_;
  PlacementReport& report_;
  std::size_t batch_size_ = kLeastBatch;
};

}  // namespace

void declare_options(Options& options, RecordOptions& r, PlacementOptions& p) {
  options.section("Records");
  options.number("accuracy", r.accuracy, "A",
                 "error allowed in interpolation: a record serves points within A times its radius",
                 {1e-3, 1, false});
  options.number("min-radius", r.min_radius_m, "METRES", "smallest radius (default: scene diagonal / 100)",
                 kPositive);
  options.number("max-radius", r.max_radius_m, "METRES", "largest radius (default: scene diagonal / 4)",
                 kPositive);
  options.choice<Quantity>("paths", r.paths, {{"indirect", Quantity::indirect}, {"all", Quantity::all}},
                           "photons that count: indirect leaves out those straight from a light");
  options.choice<GradientMode>("gradients", r.gradients,
                               {{"photon", GradientMode::photon},
                                {"hemisphere", GradientMode::hemisphere},
                                {"none", GradientMode::none}},
                               "each photon's own term, a discretised hemisphere, or none");
  options.integer("hemisphere-rings", r.hemisphere_rings, "N", "rings of the discretised hemisphere",
                  {1, 64});
  options.section("Estimates");
  options.integer("near-photons", r.near_photons, "N",
                  "photons of the first query, for the distance to surroundings", {8, 4096});
  options.integer("min-photons", r.min_photons, "N",
                  "photons that a zone should hold at least, as far as the surroundings allow; records are "
                  "no closer to each "
                  "other than half such a zone",
                  {1, 1e6});
  options.integer("max-photons", r.max_photons, "N", "photons that a zone should hold at most", {16, 1e7});
  options.integer("distance-rays", r.distance_rays, "N",
                  "rays that look for dark surroundings; 0: photons alone", {0, 4096});
  options.integer("probes", r.probes, "N", "short rays that look for the surface where a zone is in doubt",
                  {16, 65536});
  options.section("Placement");
  options.integer("max-candidates", p.max_candidates, "N", "photons tried as places for records; 0: all",
                  {0, 1e12});
  options.integer("passes", p.passes, "N", "passes over the candidates at most", {1, 100});
}

PlacementReport place_records(IrradianceCache& cache, const PhotonMap& photons, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              std::uint64_t seed, std::span<const SurfaceSample> points, bool at_photons,
                              Counters& counters) {
  const RecordMaker maker(photons, rays, resolved, seed);
  std::vector<std::uint32_t> order;
  if (at_photons) order = shuffled(maker, photons, seed, placement.max_candidates);
  const std::size_t n = at_photons ? order.size() : points.size();
  const auto candidate = [&](std::size_t i) {
    if (!at_photons)
      return Candidate{points[i].position, points[i].normal, kPointItems + i, RecordMaker::kNoPhoton};
    const std::uint32_t row = order[i];
    return Candidate{photons.position[row], decode_octahedral(photons.normal[row]), row, row};
  };

  PlacementReport report;
  report.candidates = n;
  Growth growth(cache, rays.scene().bounds, maker);
  Placer placer(maker, growth, report);
  for (int pass = 1; pass <= placement.passes; ++pass) {
    report.passes = static_cast<std::uint64_t>(pass);
    if (placer.pass(n, candidate, pass) == 0) break;
  }
  report.uncovered = parallel_reduce<std::uint64_t>(
      n, 4096, 0,
      [&](std::size_t begin, std::size_t end) {
        std::uint64_t open = 0;
        for (std::size_t i = begin; i < end; ++i) open += !growth.covered(candidate(i));
        return open;
      },
      [](std::uint64_t& total, std::uint64_t part) { total += part; });
  growth.finish(cache.records, report);

  placer.events.add_to(counters);
  const auto count = [&](const char* event, std::uint64_t times) {
    if (times > 0) counters.count(event, times);
  };
  count("radii clamped to a neighbour", report.clamped_to_neighbour);
  count("radii raised to the smallest", report.clamped_to_least);
  count("candidates left uncovered", report.uncovered);
  return report;
}

}  // namespace phos
