#include "estimate/gather.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "core/sampling.h"
#include "estimate/events.h"
#include "estimate/hemisphere/hemisphere_record.h"

namespace phos::inline estimate {
namespace {

constexpr std::int64_t kFirstPass = 64;  // rays; later passes have as many as all before them
// Random streams number a pass and a ring in 16 bits.
constexpr int kRingBits = 11;
constexpr std::uint32_t kMostPasses = 1u << (16 - kRingBits);

/// 16 random bits as a place in a cell, in (0, 1); 1/2 on the mean.
float in_cell(std::uint32_t bits) { return (static_cast<float>(bits) + 0.5f) * 0x1p-16f; }

/// A unit vector turned by an angle of at most a third of pi: the first terms of the series, to rounding.
Vec2 turned(const Vec2& v, float angle) {
  const float x2 = angle * angle;
  const float c = 1 + x2 * (-1.f / 2 + x2 * (1.f / 24 + x2 * (-1.f / 720 + x2 * (1.f / 40320))));
  const float s = angle * (1 + x2 * (-1.f / 6 + x2 * (1.f / 120 + x2 * (-1.f / 5040 + x2 * (1.f / 362880)))));
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// visit(cell) for each cell, in tiles of cells that lie about each other: the ray tracer takes such rays
/// together, in two thirds of the time.
template <class Visit>
void each_in_tiles(const Hemisphere& h, const Visit& visit) {
  constexpr int kSide = 4;
  for (int ring = 0; ring < h.rings; ring += kSide)
    for (int slice = 0; slice < h.slices; slice += kSide)
      for (int j = ring; j < std::min(ring + kSide, h.rings); ++j)
        for (int k = slice; k < std::min(slice + kSide, h.slices); ++k) visit(h.at(j, k));
}

}  // namespace

struct GatherEstimator::Impl : HemisphereRecords {
  using HemisphereRecords::HemisphereRecords;
  struct Worker;

  void aim(const RecordSite& site, std::int64_t count, std::uint32_t pass, Measure measure,
           Hemisphere& h) const;
  std::size_t sample_all(const GatherEstimator& self, const RecordSite& site, Worker& worker) const;
};

struct GatherEstimator::Impl::Worker : HemisphereWorker {
  std::vector<Ray> rays;  // tile by tile
  std::vector<Hit> found;
  struct Found {
    std::vector<Hit> hits;  // in order
    std::vector<LampSight> sights;
    std::size_t sight_count = 0;
  };
  std::vector<Found> found_in;  // each pass
  std::vector<Hemisphere> passes;
  std::size_t pass_count = 0;  // of the last record
};

/// Directions through the cells of equal measure, jittered within each.
void GatherEstimator::Impl::aim(const RecordSite& site, std::int64_t count, std::uint32_t pass,
                                Measure measure, Hemisphere& h) const {
  h.frame = make_frame(site.normal), h.measure = measure;
  h.rings = rings_for(count), h.slices = slices_for(h.rings);
  PHOS_CHECK(pass < kMostPasses && h.rings < 1 << kRingBits, "pass ", pass, ", ", h.rings, " rings");
  const auto rings = static_cast<float>(h.rings), slices = static_cast<float>(h.slices);
  h.resize(static_cast<std::size_t>(h.rings) * static_cast<std::size_t>(h.slices));
  std::fill(h.projected_sr.begin(), h.projected_sr.end(), kPi / (rings * slices));
  const auto count_of_ring = static_cast<std::size_t>(h.slices);
  std::vector<Vec2> middle(count_of_ring);  // of each slice
  for (std::size_t k = 0; k < count_of_ring; ++k)
    middle[k] = cos_sin((static_cast<float>(k) + 0.5f) / slices);
  std::vector<Vec2> jitter(count_of_ring);
  RandomStream random(seed, Stage::record, site.item);
  const float slice_angle = 2 * kPi / slices;
  const bool solid = measure == Measure::solid;
  Vec3* direction = h.direction.data();
  float* projected_sr = h.projected_sr.data();
  for (int ring = 0; ring < h.rings; ++ring, direction += h.slices, projected_sr += h.slices) {
    random.start_bounce(pass << kRingBits | static_cast<std::uint32_t>(ring));
    for (Vec2& u : jitter) {
      const std::uint32_t bits = random.bits();
      u = {in_cell(bits >> 16), in_cell(bits & 0xffffu)};
    }
    for (std::size_t k = 0; k < count_of_ring; ++k) {
      const float share = (static_cast<float>(ring) + jitter[k].x) * (1 / rings);  // of the measure
      const float sin2 = solid ? share * (2 - share) : share;
      const float z = solid ? std::max(0.f, 1 - share) : std::sqrt(std::max(0.f, 1 - sin2));
      const Vec2 around = turned(middle[k], slice_angle * (jitter[k].y - 0.5f));
      direction[k] = h.frame.to_world(Vec3(std::sqrt(sin2) * around, z));
      if (solid) projected_sr[k] *= 2 * z;
    }
  }
}

void GatherEstimator::sample(const RecordSite& site, std::int64_t rays, std::uint32_t pass, Hemisphere& h,
                             Estimator::Worker& worker, Measure measure) const {
  auto& w = static_cast<Impl::Worker&>(worker);
  impl_->aim(site, rays, pass, measure, h);
  const SurfacePoint from = receiver(impl_->rays.scene(), site.position, site.normal);
  const Vec3 origin = from.leave(site.normal);
  w.rays.clear();
  each_in_tiles(h, [&](std::size_t i) { w.rays.push_back({origin, h.direction[i]}); });
  w.found.assign(h.size(), Hit());
  impl_->rays.intersect(w.rays, w.found);
  if (w.found_in.size() <= pass) w.found_in.resize(pass + 1);
  auto& [hits, sights, sight_count] = w.found_in[pass];
  hits.resize(h.size());
  const Hit* next = w.found.data();
  each_in_tiles(h, [&, &hits = hits](std::size_t i) { hits[i] = *next++; });
  impl_->light.shade(origin, hits, site.item, pass, h, *w.light);
  std::swap(sights, w.light->sights);
  sight_count = w.light->sight_count;
  w.counters.merge(w.light->counters);
  w.light->counters = Counters();
  clear_own_surface(from.error_m, h);
}

/// Hemispheres until they are rays enough; returns how many passes they are.
std::size_t GatherEstimator::Impl::sample_all(const GatherEstimator& self, const RecordSite& site,
                                              Worker& w) const {
  const auto hemisphere = [&](std::size_t pass, std::int64_t count) {
    if (w.passes.size() <= pass) w.passes.resize(pass + 1);
    self.sample(site, count, static_cast<std::uint32_t>(pass), w.passes[pass], w);
  };
  if (!options.error) {
    hemisphere(0, options.rays);
    return 1;
  }
  double rays = 0, sum = 0, variance = 0;  // of luminance; sums over rays
  for (std::size_t pass = 0;; ++pass) {
    const std::int64_t left = options.rays - static_cast<std::int64_t>(rays);
    hemisphere(pass, std::min(left, std::max(kFirstPass, static_cast<std::int64_t>(rays))));
    const Hemisphere& h = w.passes[pass];
    const auto n = static_cast<double>(h.size());
    const double error = n * static_cast<double>(luminance(standard_error_of(h)));
    rays += n, sum += n * static_cast<double>(luminance(irradiance_of(h))), variance += error * error;
    const bool enough = std::sqrt(variance) <= *options.error * sum;
    // Two passes at least: light that one of them missed has a second chance.
    if (enough && pass > 0) return pass + 1;
    if (static_cast<double>(options.rays) - rays < static_cast<double>(kFirstPass)) {
      if (!enough) w.counters.count(kAboveErrorEvent);
      return pass + 1;
    }
  }
}

GatherEstimator::GatherEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                                 const RecordOptions& resolved, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(rays, lights, source, resolved, seed)) {}
GatherEstimator::~GatherEstimator() = default;

std::unique_ptr<Estimator::Worker> GatherEstimator::make_worker() const {
  auto worker = std::make_unique<Impl::Worker>();
  worker->light = impl_->light.make_worker();
  return worker;
}

Made GatherEstimator::make(const RecordSite& site, Estimator::Worker& worker) const {
  auto& w = static_cast<Impl::Worker&>(worker);
  w.light->hidden_radiance = Rgb(0), w.light->hidden = 0;
  w.pass_count = impl_->sample_all(*this, site, w);
  const std::span<const Hemisphere> passes(w.passes.data(), w.pass_count);
  PlaceLight light = light_of(passes, impl_->options);
  if (light.irradiance == Rgb(0) && w.light->hidden > 0) {
    float rays = 0;
    for (const Hemisphere& h : passes) rays += static_cast<float>(h.size());
    light.stderr_lx = w.light->hidden_radiance / static_cast<float>(w.light->hidden) * (kPi / rays);
  }
  return impl_->record(site, light, passes, w);
}

SeenPass GatherEstimator::seen(const Estimator::Worker& worker, std::uint32_t pass, const Hemisphere& h) {
  const Impl::Worker::Found& found = static_cast<const Impl::Worker&>(worker).found_in[pass];
  return {&h, found.hits, std::span(found.sights).first(found.sight_count)};
}

std::vector<SeenPass> GatherEstimator::last_seen(const Estimator::Worker& worker) const {
  const auto& w = static_cast<const Impl::Worker&>(worker);
  std::vector<SeenPass> seen;
  for (std::size_t i = 0; i < w.pass_count; ++i)
    seen.push_back(GatherEstimator::seen(worker, static_cast<std::uint32_t>(i), w.passes[i]));
  return seen;
}

Made GatherEstimator::record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                                  Estimator::Worker& worker) const {
  return impl_->record(site, light_of(passes, impl_->options), passes, static_cast<Impl::Worker&>(worker));
}

}  // namespace phos::inline estimate
