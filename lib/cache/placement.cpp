#include "cache/placement.h"

#include <algorithm>
#include <iterator>

#include "cache/growth.h"
#include "cache/placer.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace phos {
namespace {

constexpr std::size_t kTaskPlaces = 256;  // looked up by one task

/// The sites of places [begin, end) that are not covered, in order.
std::vector<RecordSite> open_sites(const Candidates& candidates, const Growth& growth, std::size_t begin,
                                   std::size_t end) {
  return parallel_reduce<std::vector<RecordSite>>(
      end - begin, kTaskPlaces, {},
      [&](std::size_t from, std::size_t to) {
        std::vector<RecordSite> sites;
        for (std::size_t i = from; i < to; ++i) candidates.sites(begin + i, sites);
        std::erase_if(sites, [&](const RecordSite& site) { return growth.covered(site); });
        return sites;
      },
      [](std::vector<RecordSite>& all, const std::vector<RecordSite>& part) {
        all.insert(all.end(), part.begin(), part.end());
      });
}

/// One pass over the candidates. Returns how many records it had to add.
std::size_t run_pass(const Candidates& candidates, int number, Growth& growth, Placer& placer) {
  Progress progress(number == 1 ? "records" : text("records, pass ", number), candidates.count, "candidates");
  std::size_t placed = 0;
  for (std::size_t begin = 0; begin < candidates.count;) {
    const std::size_t block =
        std::min(candidates.count - begin, std::clamp<std::size_t>(4 * growth.size(), 64, 16384));
    placed += placer.cover(open_sites(candidates, growth, begin, begin + block));
    begin += block;
    progress.advance(block);
  }
  return placed;
}

struct Cover {
  std::uint64_t sites = 0, open = 0;
};

Cover cover_of(const Candidates& candidates, const Growth& growth) {
  return parallel_reduce<Cover>(
      candidates.count, 4096, {},
      [&](std::size_t begin, std::size_t end) {
        std::vector<RecordSite> sites;
        for (std::size_t i = begin; i < end; ++i) candidates.sites(i, sites);
        Cover cover{sites.size(), 0};
        for (const RecordSite& site : sites) cover.open += !growth.covered(site);
        return cover;
      },
      [](Cover& total, const Cover& part) { total.sites += part.sites, total.open += part.open; });
}

}  // namespace

void finish_placement(Growth& growth, const ParallelMaker& maker, IrradianceCache& cache,
                      PlacementReport& report, Counters& counters) {
  const std::size_t before = cache.records.size();
  growth.rules().finish(cache.records, &report.radiance);
  report.made_records.assign(growth.rules().made().begin(), growth.rules().made().end());
  report.kept = cache.records.size() - before;
  report.made = maker.made(), report.making_s = maker.seconds();
  report.clamped_to_neighbour = growth.rules().clamped_to_neighbour();
  report.clamped_to_least = growth.rules().raised_to_least();
  maker.count_into(counters);
  growth.rules().count_into(counters);
  if (report.uncovered > 0) counters.count("candidates left uncovered", report.uncovered);
}

PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters) {
  PlacementReport report;
  Growth growth(cache, rays, resolved);
  ParallelMaker maker(estimator);
  Placer placer(maker, growth);
  for (int pass = 1; pass <= placement.passes; ++pass) {
    report.passes = static_cast<std::uint64_t>(pass);
    const std::size_t placed = run_pass(candidates, pass, growth, placer);
    const std::size_t shrunk = pass < placement.passes ? growth.compare() : 0;
    if (placed == 0 && shrunk == 0) break;
  }
  const Cover cover = cover_of(candidates, growth);
  report.candidates = cover.sites, report.uncovered = cover.open;
  finish_placement(growth, maker, cache, report, counters);
  return report;
}

PlacementReport place_every(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                            const RecordOptions& resolved, std::span<const SurfaceSample> points,
                            Counters& counters, const MaterialFilter& wanted) {
  std::vector<SurfaceSample> chosen;
  if (wanted) {
    const auto unwanted = [&](const SurfaceSample& p) {
      const std::optional<std::uint32_t> material = material_at(rays, p.position, p.normal);
      return !material || !wanted(*material);
    };
    std::remove_copy_if(points.begin(), points.end(), std::back_inserter(chosen), unwanted);
    points = chosen;
  }
  PlacementReport report;
  report.candidates = points.size(), report.passes = 1;
  Growth growth(cache, rays, resolved);
  ParallelMaker maker(estimator);
  for (const Made& made : maker.make_at(points, 0, points.size())) growth.accept(made);
  finish_placement(growth, maker, cache, report, counters);
  return report;
}

}  // namespace phos
