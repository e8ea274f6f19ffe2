#include "estimate/hit_light.h"

#include "core/error.h"
#include "core/random.h"
#include "estimate/events.h"
#include "estimate/hit_light_impl.h"
#include "estimate/read_noise.h"

namespace phos::inline estimate {

HitLight::HitLight(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                   const RecordOptions& resolved, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(rays, lights, source, resolved, seed)) {}
HitLight::~HitLight() = default;

std::unique_ptr<HitLight::Worker> HitLight::make_worker() const { return std::make_unique<Worker>(); }

void HitLight::lamps_from(const LampLight* lamps) { impl_->told = lamps; }

bool HitLight::is_diffuse(std::uint32_t material) const { return impl_->surface[material].diffuse; }

void HitLight::shade(const Vec3& origin, std::span<const Hit> hits, std::uint64_t item, std::uint32_t pass,
                     Hemisphere& h, Worker& worker) const {
  PHOS_CHECK(hits.size() == h.size() && pass < 0xffff, hits.size(), " hits of ", h.size(), " rays, pass ",
             pass);
  RandomStream random(impl_->seed, Stage::direct_light, item);
  random.start_bounce(1 + pass);
  const LampSequence lamp_points(random, impl_->lamps.samples());
  const std::size_t most_sights = impl_->lamps.samples() * hits.size();
  if (worker.sights.size() < most_sights) worker.sights.resize(most_sights);
  worker.sight_count = 0;
  worker.tell_noise = h.stratified();
  worker.other_light.clear();
  ReadNoise noise(impl_->source);
  h.lamps = {};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    impl_->rays.ask_ahead(hits, i);
    h.distance_m[i] = hits[i].distance_m;
    h.radiance[i] = Rgb(0);
    h.hit_normal[i] = -h.direction[i];
    if (!std::isfinite(hits[i].distance_m)) continue;
    const SurfacePoint point = impl_->rays.surface({origin, h.direction[i]}, hits[i]);
    h.hit_normal[i] = point.geometric_normal;
    if (impl_->bounces == 0) continue;
    const RayName ray{item, pass, static_cast<std::uint32_t>(i)};
    worker.read = {}, worker.dark = 0;
    Impl::Landing landing;
    h.radiance[i] = impl_->surface[point.material].diffuse
                        ? impl_->from_diffuse(point, -h.direction[i], lamp_points, ray, worker)
                        : impl_->from_any({origin, h.direction[i]}, Rgb(1), ray, 0, worker, &landing);
    if (impl_->surface[point.material].straight)
      h.distance_m[i] = landing.distance_m, h.hit_normal[i] = landing.normal;
    if (impl_->source.photon_lm > 0)
      noise.add(worker.read, h.projected_sr[i], glm::dot(h.direction[i], h.frame.z));
  }
  h.source = noise.all();
  for (LampSight& sight : std::span(worker.sights).first(worker.sight_count)) {
    const Rgb radiance = sight.brdf * sight.light.lux;
    sight.arrived = impl_->arriving(sight.light);
    if (positive(sight.arrived))
      h.radiance[sight.hit] += sight.arrived * radiance;
    else
      worker.hidden_radiance += radiance, ++worker.hidden;
  }
  for (const Worker::OtherLight& other : worker.other_light) {
    // Where something is in the way, shadows make their noise, which even places take less of.
    Rgb radiance(0);
    bool arrived = true;
    for (const LampSight& sight : std::span(worker.sights).subspan(other.first, other.count)) {
      radiance += sight.brdf * sight.light.lux;
      arrived = arrived && sight.arrived == Rgb(1);
    }
    if (arrived) h.lamps.add(radiance - other.radiance, kOfWhichOneTells);
  }
  if (worker.without_record > 0) worker.counters.count(kWithoutRecordEvent, worker.without_record);
  if (worker.beyond_reach > 0) worker.counters.count(kBeyondReachEvent, worker.beyond_reach);
  if (worker.without_radiance > 0) worker.counters.count(kWithoutRadianceEvent, worker.without_radiance);
  worker.without_record = worker.beyond_reach = worker.without_radiance = 0;
  if (worker.fallback) {
    worker.counters.merge(worker.fallback->counters);
    worker.fallback->counters = Counters();
  }
}

}  // namespace phos::inline estimate
