#include "temporal/ahead.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "estimate/hit_light.h"
#include "scene/motion/anchor.h"
#include "temporal/events.h"
#include "temporal/reprojection.h"

namespace phos::inline temporal {
namespace {

/// Sets the random numbers of looking ahead apart from the numbers of the records.
constexpr std::uint64_t kOwnStreams = 0x6168656164206f66;
/// Cells are taken together in squares of so many each way.
constexpr int kTile = 4;

/// Spheres about everything that moves, each about where it is at either time.
class Movers {
 public:
  explicit Movers(const Motion& motion) {
    for (std::size_t i = 0; i < motion.now.instance.size(); ++i) {
      if (!motion.moved[i]) continue;
      Bounds bounds;
      const Instance& instance = motion.now.instance[i];
      for (const Scene* scene : {&motion.now, &motion.next})
        for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
          for (const std::uint32_t v : scene->triangle[instance.first_triangle + t].v)
            bounds.include(scene->position[v]);
      if (bounds.empty()) continue;
      const Vec3 c = bounds.centre();
      // Some roundings wider.
      const float r = 0.5f * bounds.diagonal_m() + 1e-6f * max_component(glm::abs(c));
      x_.push_back(c.x), y_.push_back(c.y), z_.push_back(c.z), r2_.push_back(1.0001f * r * r);
    }
  }
  /// May any of them cross the ray? Where there are too many to look at, always.
  bool cross(const Ray& ray) const {
    if (x_.size() > kMost) return true;
    const Vec3 o = ray.origin, d = ray.direction;
    int any = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const float x = x_[i] - o.x, y = y_[i] - o.y, z = z_[i] - o.z;
      const float along = x * d.x + y * d.y + z * d.z;
      const float t = along < 0 ? 0 : along < ray.t_max_m ? along : ray.t_max_m;
      const float ax = x - t * d.x, ay = y - t * d.y, az = z - t * d.z;
      any |= ax * ax + ay * ay + az * az < r2_[i];
    }
    return any != 0;
  }

 private:
  static constexpr std::size_t kMost = 256;
  std::vector<float> x_, y_, z_, r2_;
};

struct AheadWorker : Estimator::Worker {
  std::unique_ptr<Estimator::Worker> now, next;
  std::unique_ptr<HitLight::Worker> lamps_now, lamps_next;
  std::vector<Hemisphere> passes;        // one frame on
  std::vector<Rgb> radiance;             // of hits, one frame on
  Hemisphere chosen_now, chosen_next;    // of each tile one ray
  std::vector<Hit> hits_now, hits_next;  // of those
  std::vector<std::size_t> cells, end;   // that each speaks for: up to its end
  std::vector<std::uint8_t> ask;         // by hit: the lamps are asked again
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
  Movers movers;
  bool lamps_stay;

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
        movers(motion),
        lamps_stay(!c.lights && !c.materials) {}

  std::optional<RecordSite> moved(const RecordSite& site) const;
  bool goes(const SeenPass& seen, std::size_t i) const {
    return std::isfinite(seen.hemisphere->distance_m[i]) && motion.moves(seen.hits[i].triangle);
  }
  bool change_of_shadows(const SeenPass& seen, AheadWorker& w) const;
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

/// Adds to w.radiance the change of the lamps' light at hits that do not move, by surfaces that move and
/// lamps that do not: exact, ray by ray. Marks in w.ask the hits where this is not enough. False: no change.
bool AheadEstimator::Impl::change_of_shadows(const SeenPass& seen, AheadWorker& w) const {
  const auto known = [&](std::size_t i) {
    const Hit& hit = seen.hits[i];
    return !motion.moves(hit.triangle) &&
           lamps_now.is_diffuse(motion.now.instance[motion.now.triangle_instance[hit.triangle]].material);
  };
  for (std::size_t i = 0; i < w.ask.size(); ++i)
    w.ask[i] = std::isfinite(seen.hemisphere->distance_m[i]) && !known(i);
  // Light that a ray found (near area lamps) has no way to look along again.
  for (const LampSight& sight : seen.sights) w.ask[sight.hit] = w.ask[sight.hit] || sight.light.certain;
  bool any = false;
  for (const LampSight& sight : seen.sights) {
    if (w.ask[sight.hit]) continue;
    const Ray& way = sight.light.ray;
    if (!movers.cross(way)) continue;
    const Rgb arrives = next.rays.transmittance(way);
    if (arrives == sight.arrived) continue;
    any = true;
    w.radiance[sight.hit] += (arrives - sight.arrived) * sight.brdf * sight.light.lux;
  }
  return any;
}

/// Sets w.radiance to the light that the hits of a pass will send. False: the same as now.
bool AheadEstimator::Impl::change_of_lamps(const SeenPass& seen, std::uint32_t pass, const RecordSite& from,
                                           const RecordSite& to, AheadWorker& w) const {
  const Hemisphere& h = *seen.hemisphere;
  w.radiance = h.radiance;
  w.ask.assign(h.size(), 1);
  // Where there are no sights, the direct light is in the source, or there is none.
  bool any = lamps_stay && !seen.sights.empty() && change_of_shadows(seen, w);
  w.hits_now.clear(), w.hits_next.clear(), w.cells.clear(), w.end.clear();
  w.chosen_now.direction.clear(), w.chosen_next.direction.clear();
  for (int ring = 0; ring < h.rings; ring += kTile)
    for (int slice = 0; slice < h.slices; slice += kTile)
      for (int j = ring; j < std::min(ring + kTile, h.rings); ++j)
        for (int k = slice; k < std::min(slice + kTile, h.slices); ++k)
          if (w.ask[h.at(j, k)] && std::isfinite(h.distance_m[h.at(j, k)])) w.cells.push_back(h.at(j, k));
  // Few of them can all be asked at the price of a share of all.
  const double budget = std::max(1.0, options.share * static_cast<double>(h.size()));
  const auto group = static_cast<std::size_t>(std::ceil(static_cast<double>(w.cells.size()) / budget));
  RandomStream random(seed, Stage::record, from.item);
  random.start_bounce(pass);
  const Vec3 shift = to.position - from.position;
  for (std::size_t first = 0; first < w.cells.size(); first += group) {
    const std::size_t count = std::min(group, w.cells.size() - first);
    const std::size_t i =
        w.cells[first + static_cast<std::size_t>(random.uniform() * static_cast<float>(count))];
    const Hit& hit = seen.hits[i];
    const Vec3 way = h.distance_m[i] * h.direction[i] + (motion.of(hit) - shift);
    w.chosen_now.direction.push_back(h.direction[i]);
    w.chosen_next.direction.push_back(glm::normalize(way));
    w.hits_now.push_back(hit);
    w.hits_next.push_back({glm::length(way), hit.triangle, hit.u, hit.v});
    w.end.push_back(first + count);
  }
  if (w.hits_now.empty()) return any;
  const auto shade = [&](const RayScene& rays, const HitLight& lamps, const RecordSite& site,
                         std::span<const Hit> hits, Hemisphere& chosen, HitLight::Worker& worker) {
    chosen.resize(hits.size());
    const Vec3 origin = receiver(rays.scene(), site.position, site.normal).leave(site.normal);
    lamps.shade(origin, hits, site.item, pass, chosen, worker);
    worker.counters = Counters();
  };
  shade(now.rays, lamps_now, from, w.hits_now, w.chosen_now, *w.lamps_now);
  shade(next.rays, lamps_next, to, w.hits_next, w.chosen_next, *w.lamps_next);
  for (std::size_t k = 0, cell = 0; k < w.end.size(); ++k) {
    const Rgb change = w.chosen_next.radiance[k] - w.chosen_now.radiance[k];
    any = any || change != Rgb(0);
    for (; cell < w.end[k]; ++cell) w.radiance[w.cells[cell]] += change;
  }
  return any;
}

Ahead AheadEstimator::Impl::reprojected(const Made& made, const RecordSite& from, const RecordSite& to,
                                        AheadWorker& w) const {
  const std::vector<SeenPass> seen = seer->last_seen(*w.now);
  const bool stays = to.position == from.position && to.normal == from.normal;
  bool same = stays && (records.paths == Quantity::indirect || made.radiance);
  double cells = 0, holes = 0;
  DVec3 irradiance(0);
  w.passes.resize(seen.size());
  for (std::size_t pass = 0; pass < seen.size(); ++pass) {
    const Hemisphere& h = *seen[pass].hemisphere;
    same = !change_of_lamps(seen[pass], static_cast<std::uint32_t>(pass), from, to, w) && same;
    bool moves = !stays;
    for (std::size_t i = 0; i < h.size() && !moves; ++i) moves = goes(seen[pass], i);
    same = same && !moves;
    Hemisphere& then = w.passes[pass];
    if (moves) {
      const ReprojectionCounts counts = reproject(h, seen[pass].hits, w.radiance, motion,
                                                  to.position - from.position, make_frame(to.normal), then);
      holes += counts.holes;
    } else {
      then = h;
      then.radiance = w.radiance;
    }
    cells += static_cast<double>(h.size());
    irradiance += static_cast<double>(h.size()) * DVec3(irradiance_of(then));
  }
  if (same) return {made.record, made.radiance, 0};
  const auto share = static_cast<float>(holes / cells);
  if (holes > options.most_holes * cells) {
    w.counters.count(kTracedAheadEvent);
    const Made next_made = next.estimator.make(to, *w.next);
    return {next_made.record, next_made.radiance, share};
  }
  if (!options.whole && !made.radiance && records.paths == Quantity::indirect) {
    Ahead ahead{made.record, {}, share};
    ahead.record.position = to.position, ahead.record.normal = to.normal;
    ahead.record.irradiance = Rgb(irradiance / cells), ahead.record.footprint.reset();
    return ahead;
  }
  Made then = next_seer->record_from(to, w.passes, *w.next);
  // Cells that are empty or crowded by chance say nothing of the light's own variance.
  then.record.stderr_lx = made.record.stderr_lx;
  return {then.record, then.radiance, share};
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
  w.next->counters = Counters();  // events one frame on are not of this frame's records
  ahead.record.irradiance = glm::max(ahead.record.irradiance, Rgb(0));
  made.ahead = std::make_shared<Ahead>(std::move(ahead));
  return made;
}

}  // namespace phos::inline temporal
