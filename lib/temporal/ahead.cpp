#include "temporal/ahead.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cache/direct_light.h"
#include "cache/gather.h"
#include "core/error.h"
#include "core/random.h"
#include "scene/anchor.h"
#include "temporal/reprojection.h"

namespace phos {
namespace {

/// Sets the random numbers of looking ahead apart from those of the records.
constexpr std::uint64_t kOwnStreams = 0x6168656164206f66;

/// Hits that speak for their neighbours: one of each tile of about `size` cells.
struct Tiles {
  int rows, columns;
  explicit Tiles(int size)
      : rows(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(size))))),
        columns((size + rows - 1) / rows) {}
};

struct AheadWorker : Estimator::Worker {
  std::unique_ptr<Estimator::Worker> now, next;
  std::unique_ptr<HitLight::Worker> lamps_now, lamps_next;
  std::vector<Hemisphere> passes;            // one frame on
  std::vector<Rgb> radiance;                 // of hits, one frame on
  Hemisphere chosen_now, chosen_next;        // of each tile one ray
  std::vector<Hit> hits_now, hits_next;      // of those
  std::vector<std::vector<std::size_t>> of;  // the cells that each speaks for
};

void take_counters(Estimator::Worker& from, Counters& into) {
  into.merge(from.counters);
  from.counters = Counters();
}

}  // namespace

struct AheadEstimator::Impl {
  FrameEstimator now, next;
  const HemisphereEstimator *seer, *next_seer;  // null: of no hemispheres
  Changes changes;
  Motion motion;
  HitLight lamps_now, lamps_next;
  RecordOptions records;
  std::uint64_t seed;
  AheadOptions options;
  Tiles tiles;

  Impl(const FrameEstimator& n, const FrameEstimator& m, const Changes& c, const RecordOptions& resolved,
       std::uint64_t own_seed, const AheadOptions& o)
      : now(n),
        next(m),
        seer(dynamic_cast<const HemisphereEstimator*>(&n.estimator)),
        next_seer(dynamic_cast<const HemisphereEstimator*>(&m.estimator)),
        changes(c),
        motion{n.rays.scene(), m.rays.scene(), changes.moved},
        lamps_now(n.rays, n.lights, {}, resolved, own_seed ^ kOwnStreams),
        lamps_next(m.rays, m.lights, {}, resolved, own_seed ^ kOwnStreams),
        records(resolved),
        seed(own_seed ^ kOwnStreams),
        options(o),
        tiles(static_cast<int>(std::lround(1 / o.share))) {}

  std::optional<RecordSite> moved(const RecordSite& site) const;
  bool change_of_lamps(const SeenPass& seen, std::uint32_t pass, const RecordSite& from, const RecordSite& to,
                       AheadWorker& w) const;
  Ahead reprojected(const Made& made, const RecordSite& from, const RecordSite& to, AheadWorker& w) const;
};

/// Where its surface takes a site; nothing where it has none any more.
std::optional<RecordSite> AheadEstimator::Impl::moved(const RecordSite& site) const {
  const Anchor anchor = anchor_at(now.rays, site.position, site.normal);
  if (anchor.triangle == kNoTriangle || !motion.moves(anchor.triangle)) return site;
  const std::optional<Pose> from = pose_of(motion.now, anchor), to = pose_of(motion.next, anchor);
  if (!from || !to) return {};
  RecordSite there = site;
  there.position += to->position - from->position;
  if (to->turn != from->turn) there.normal = glm::normalize(turned(*from, *to, site.normal));
  return there;
}

/// Sets w.radiance to what the hits of a pass will send. False: the same as now.
bool AheadEstimator::Impl::change_of_lamps(const SeenPass& seen, std::uint32_t pass, const RecordSite& from,
                                           const RecordSite& to, AheadWorker& w) const {
  const Hemisphere& h = *seen.hemisphere;
  w.radiance = h.radiance;
  w.hits_now.clear(), w.hits_next.clear(), w.of.clear();
  w.chosen_now.direction.clear(), w.chosen_next.direction.clear();
  RandomStream random(seed, Stage::record, from.item);
  random.start_bounce(pass);
  const Vec3 shift = to.position - from.position;
  for (int ring = 0; ring < h.rings; ring += tiles.rows) {
    for (int slice = 0; slice < h.slices; slice += tiles.columns) {
      std::vector<std::size_t> cells;
      for (int j = ring; j < std::min(ring + tiles.rows, h.rings); ++j)
        for (int k = slice; k < std::min(slice + tiles.columns, h.slices); ++k)
          if (std::isfinite(h.distance_m[h.at(j, k)])) cells.push_back(h.at(j, k));
      const auto pick = static_cast<std::size_t>(random.uniform() * static_cast<float>(cells.size()));
      if (cells.empty()) continue;
      const std::size_t i = cells[pick];
      const Hit& hit = seen.hits[i];
      const Vec3 way = h.distance_m[i] * h.direction[i] + (motion.of(hit) - shift);
      w.chosen_now.direction.push_back(h.direction[i]);
      w.chosen_next.direction.push_back(glm::normalize(way));
      w.hits_now.push_back(hit);
      w.hits_next.push_back({glm::length(way), hit.triangle, hit.u, hit.v});
      w.of.push_back(std::move(cells));
    }
  }
  const auto shade = [&](const RayScene& rays, const HitLight& lamps, const RecordSite& site,
                         std::span<const Hit> hits, Hemisphere& chosen, HitLight::Worker& worker) {
    chosen.resize(hits.size());
    const Vec3 origin = receiver(rays.scene(), site.position, site.normal).leave(site.normal);
    lamps.shade(origin, hits, site.item, pass, chosen, worker);
    worker.counters = Counters();
  };
  shade(now.rays, lamps_now, from, w.hits_now, w.chosen_now, *w.lamps_now);
  shade(next.rays, lamps_next, to, w.hits_next, w.chosen_next, *w.lamps_next);
  bool any = false;
  for (std::size_t k = 0; k < w.of.size(); ++k) {
    const Rgb change = w.chosen_next.radiance[k] - w.chosen_now.radiance[k];
    if (change == Rgb(0)) continue;
    any = true;
    for (const std::size_t cell : w.of[k]) w.radiance[cell] += change;
  }
  return any;
}

Ahead AheadEstimator::Impl::reprojected(const Made& made, const RecordSite& from, const RecordSite& to,
                                        AheadWorker& w) const {
  const std::vector<SeenPass> seen = seer->last_seen(*w.now);
  const bool stays = to.position == from.position && to.normal == from.normal;
  bool same = stays && records.paths == Quantity::indirect;
  double cells = 0, holes = 0;
  w.passes.resize(seen.size());
  for (std::size_t pass = 0; pass < seen.size(); ++pass) {
    const Hemisphere& h = *seen[pass].hemisphere;
    same = !change_of_lamps(seen[pass], static_cast<std::uint32_t>(pass), from, to, w) && same;
    for (std::size_t i = 0; i < h.size() && same; ++i)
      same = !std::isfinite(h.distance_m[i]) || !motion.moves(seen[pass].hits[i].triangle);
    const ReprojectionCounts counts =
        reproject(h, seen[pass].hits, w.radiance, motion, to.position - from.position, make_frame(to.normal),
                  w.passes[pass]);
    cells += static_cast<double>(counts.cells), holes += counts.holes;
  }
  if (same) return {made.record, made.radiance, 0};
  const auto share = static_cast<float>(holes / cells);
  const bool trace = holes > options.most_holes * cells;
  if (trace) w.counters.count("records traced one frame ahead");
  Made ahead = trace ? next.estimator.make(to, *w.next) : next_seer->record_from(to, w.passes, *w.next);
  // Cells that are empty or crowded by chance say nothing of the light's own variance.
  if (!trace) ahead.record.stderr_lx = made.record.stderr_lx;
  return {ahead.record, ahead.radiance, share};
}

AheadEstimator::AheadEstimator(const FrameEstimator& now, const FrameEstimator& next, const Changes& changes,
                               const RecordOptions& resolved, std::uint64_t seed, const AheadOptions& options)
    : impl_(std::make_unique<Impl>(now, next, changes, resolved, seed, options)) {
  PHOS_CHECK(options.share > 0 && options.share <= 1, "share ", options.share);
}
AheadEstimator::~AheadEstimator() = default;

bool AheadEstimator::one_thread() const {
  return impl_->now.estimator.one_thread() || impl_->next.estimator.one_thread();
}

std::unique_ptr<Estimator::Worker> AheadEstimator::make_worker() const {
  auto worker = std::make_unique<AheadWorker>();
  worker->now = impl_->now.estimator.make_worker(), worker->next = impl_->next.estimator.make_worker();
  worker->lamps_now = impl_->lamps_now.make_worker(), worker->lamps_next = impl_->lamps_next.make_worker();
  return worker;
}

Made AheadEstimator::make(const RecordSite& site, Estimator::Worker& worker) const {
  auto& w = static_cast<AheadWorker&>(worker);
  Made made = impl_->now.estimator.make(site, *w.now);
  take_counters(*w.now, w.counters);
  if (impl_->options.look == LookAhead::none) return made;
  if (!impl_->changes.light()) {
    made.ahead = std::make_shared<Ahead>(Ahead{made.record, made.radiance, 0});
    return made;
  }
  const std::optional<RecordSite> there = impl_->moved(site);
  if (!there) return made;
  const bool sees = impl_->seer && impl_->next_seer;
  Ahead ahead;
  if (impl_->options.look == LookAhead::reproject && sees) {
    ahead = impl_->reprojected(made, site, *there, w);
  } else {
    const Made next = impl_->next.estimator.make(*there, *w.next);
    ahead = {next.record, next.radiance, 0};
  }
  w.next->counters = Counters();  // what happened one frame on is not of this frame's records
  ahead.record.irradiance = glm::max(ahead.record.irradiance, Rgb(0));
  made.ahead = std::make_shared<Ahead>(std::move(ahead));
  return made;
}

}  // namespace phos
