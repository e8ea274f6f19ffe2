#include "place/placement.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "place/events.h"
#include "place/growth.h"
#include "place/parallel_maker.h"
#include "place/placement_options.h"

namespace phos::inline place {
namespace {

constexpr std::size_t kTaskPlaces = 256;  // looked up by one task
// Places that are looked up together before records are made at open places. Many where next to none of a
// block was: one then walks from each to the next. Few where many were: neighbours that are open together are
// made in vain.
constexpr std::size_t kLeastBlock = 64, kOpenBlock = std::size_t{1} << 14, kMostBlock = std::size_t{1} << 20;
constexpr std::size_t kNextToNone = 1024;  // one place in so many

/// Places [begin, begin + count), walked over.
class Walk {
 public:
  Walk(const Candidates& candidates, std::size_t begin, std::size_t count) : begin_(begin) {
    if (!candidates.coarse_to_fine || !std::has_single_bit(count) || begin % count != 0) return;
    const int bits = std::countr_zero(count);
    if (bits % 2 == 0) level_ = bits / 2;
  }
  std::size_t place(std::size_t j) const { return begin_ + (level_ > 0 ? grid_order(j, level_) : j); }

 private:
  std::size_t begin_;
  int level_ = 0;
};

/// Of each place the record that covered it when it was looked at last, so that later passes look again only
/// where that one has lost reach. Places with several sites, and places beyond a certain number, are not
/// remembered.
class CoveredPlaces {
 public:
  explicit CoveredPlaces(std::size_t places) : by_(places <= kMost ? places : 0, kUnknown) {}

  /// Was the place found covered, by a record that has not shrunk since? Sets `sites` to the number of its
  /// sites.
  bool still(std::size_t place, int pass, const Growth& growth, std::uint64_t& sites) const {
    if (place >= by_.size() || by_[place] == kUnknown) return false;
    sites = by_[place] == kEmpty ? 0 : 1;
    return by_[place] == kEmpty || growth.shrunk_in(by_[place]) < pass - 1;
  }
  /// Found now: `record` covers the only one of its sites, if `covered`.
  void note(std::size_t place, std::size_t sites, bool covered, std::size_t record) {
    if (place >= by_.size()) return;
    by_[place] = sites == 0 ? kEmpty : sites == 1 && covered ? static_cast<std::uint32_t>(record) : kUnknown;
  }

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 24;
  static constexpr std::uint32_t kUnknown = ~0u, kEmpty = kUnknown - 1;
  std::vector<std::uint32_t> by_;
};

/// One pass over places.
struct Looking {
  int pass;  ///< numbered from 1 on
  Growth& growth;
  CoveredPlaces& places;
};

struct OpenSite {
  std::size_t place;
  RecordSite site;
};

/// use(place, site) for the sites of number [from, to) of a walk that are not covered.
template <class Use>
std::uint64_t each_open(const Candidates& candidates, const Looking& looking, const Walk& walk,
                        std::size_t from, std::size_t to, const Use& use) {
  std::vector<RecordSite> sites;
  std::size_t record = static_cast<std::size_t>(-1);
  std::uint64_t all = 0;
  for (std::size_t j = from; j < to; ++j) {
    const std::size_t place = walk.place(j);
    std::uint64_t known = 0;
    if (looking.places.still(place, looking.pass, looking.growth, known)) {
      all += known;
      continue;
    }
    sites.clear();
    candidates.sites(place, sites);
    all += sites.size();
    bool covered = true;
    for (const RecordSite& site : sites)
      if (!looking.growth.covered(site, record)) covered = false, use(place, site);
    looking.places.note(place, sites.size(), covered, record);
  }
  return all;
}

struct Cover {
  std::uint64_t sites = 0, open = 0;
};

/// The sites of places [begin, begin + count) that are not covered, in order; `cover` counts them too.
std::vector<RecordSite> open_sites(const Candidates& candidates, const Looking& looking, std::size_t begin,
                                   std::size_t count, Cover& cover) {
  struct Found {
    std::uint64_t sites = 0;
    std::vector<OpenSite> open;
  };
  const Walk walk(candidates, begin, count);
  Found found = parallel_reduce<Found>(
      count, kTaskPlaces, {},
      [&](std::size_t from, std::size_t to) {
        Found part;
        part.sites =
            each_open(candidates, looking, walk, from, to, [&](std::size_t place, const RecordSite& site) {
              part.open.push_back({place, site});
            });
        return part;
      },
      [](Found& all, const Found& part) {
        all.sites += part.sites;
        all.open.insert(all.open.end(), part.open.begin(), part.open.end());
      });
  cover.sites += found.sites, cover.open += found.open.size();
  std::stable_sort(found.open.begin(), found.open.end(),
                   [](const OpenSite& a, const OpenSite& b) { return a.place < b.place; });
  std::vector<RecordSite> sites;
  for (const OpenSite& o : found.open) sites.push_back(o.site);
  return sites;
}

/// The largest 4^k places from `begin` on that one walks over, at most `most`.
std::size_t block_at(std::size_t begin, std::size_t most) {
  std::size_t block = kLeastBlock;
  while (block * 4 <= most && begin % (block * 4) == 0) block *= 4;
  return block;
}

/// The result of one pass over the candidates, and the number of records that it added.
struct Pass {
  Cover cover;
  std::size_t placed = 0;
};

Pass run_pass(const Candidates& candidates, const Looking& looking, Placer& placer) {
  Growth& growth = looking.growth;
  growth.begin_pass(looking.pass);
  const bool first = looking.pass == 1;
  Progress progress(first ? "records" : text("records, pass ", looking.pass), candidates.count, "candidates");
  Pass pass;
  std::size_t most = first ? kLeastBlock : kOpenBlock;
  for (std::size_t begin = 0; begin < candidates.count;) {
    const std::size_t block = std::min(candidates.count - begin, block_at(begin, most));
    const std::vector<RecordSite> open = open_sites(candidates, looking, begin, block, pass.cover);
    pass.placed += placer.cover(open);
    begin += block;
    most = open.size() * kNextToNone < block ? std::min(4 * std::max(most, block), kMostBlock)
                                             : std::clamp(4 * growth.size(), kLeastBlock, kOpenBlock);
    progress.advance(block);
  }
  return pass;
}

Cover cover_of(const Candidates& candidates, const Looking& looking) {
  Cover total;
  for (std::size_t begin = 0; begin < candidates.count;) {
    const std::size_t block = std::min(candidates.count - begin, block_at(begin, kMostBlock));
    open_sites(candidates, looking, begin, block, total);
    begin += block;
  }
  return total;
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
  if (report.uncovered > 0) counters.count(kUncoveredEvent, report.uncovered);
}

PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters) {
  PlacementReport report;
  Growth growth(cache, rays, resolved);
  ParallelMaker maker(estimator);
  Placer placer(maker, growth);
  CoveredPlaces places(candidates.count);
  std::optional<Cover> cover;
  for (int number = 1; number <= placement.passes && !cover; ++number) {
    report.passes = static_cast<std::uint64_t>(number);
    const Pass pass = run_pass(candidates, {number, growth, places}, placer);
    const std::size_t shrunk = number < placement.passes ? growth.compare() : 0;
    if (pass.placed == 0 && shrunk == 0) cover = pass.cover;  // nothing has changed since it began
  }
  if (!cover) cover = cover_of(candidates, {static_cast<int>(report.passes) + 1, growth, places});
  report.candidates = cover->sites, report.uncovered = cover->open;
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

}  // namespace phos::inline place
