#include "splat/direct/edge_light.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/sampling.h"

namespace phos::inline splat {
namespace {

/// Samples that tell whether their neighbours' light is their own, and the difference, relative, from which
/// on it is not.
constexpr std::size_t kTests = 8;
constexpr float kUneven = 0.05f;
/// Where a lamp's light differs more than that, relative, between two samples, it is the mean of so many.
constexpr float kSteep = 0.03f;
constexpr std::size_t kWhole = 32;
constexpr std::uint32_t kShifts = 3;  // of a lamp's points
/// Variance of the share that even points see of a lamp, over the variance by independent points: 0.11 was
/// measured for straight shadow edges; more is left for others.
constexpr float kEven = 0.25f;

/// Of the share of a lamp that `found` saw. That all rays arrive, or none does, does not tell that nothing
/// else is to be seen: the variance of the share as the rays leave it to be, before them by Jeffreys' prior
/// (1946).
float variance_of_share(const PooledVisibility& found) {
  const float n = found.rays, share = (n * found.share() + 0.5f) / (n + 1);
  return kEven * share * (1 - share) / (n + 2);
}

/// `count` of the samples, taken evenly from all of them.
std::vector<std::uint32_t> some_of(const EdgeSamples& samples, std::size_t count) {
  std::vector<std::uint32_t> some;
  for (std::size_t k = 0; k < count; ++k) some.push_back(samples.sample[k * samples.sample.size() / count]);
  return some;
}

/// The first, and the one on the other side of the pixel's centre (further_offset()); if that shows another
/// surface, nothing.
std::vector<std::uint32_t> mirrored(const EdgeSamples& samples) {
  const std::uint32_t first = samples.sample[0],
                      other = first + static_cast<std::uint32_t>((samples.ray.size() + 1) / 2);
  if (!std::binary_search(samples.sample.begin(), samples.sample.end(), other)) return {};
  return {first, other};
}

}  // namespace

EdgeLight::EdgeLight(const RayScene& rays, const Luminaires& lights, int rays_each, std::uint64_t seed)
    : lamps_(rays, lights), rays_each_(rays_each), seed_(seed) {}

/// Rays from places begin .. end - 1 of the samples to all lamps.
void EdgeLight::send(const EdgeSamples& samples, std::size_t begin, std::size_t end, Scratch& s) const {
  LampRays lamp_rays(lamps_);
  for (std::size_t place = begin; place < end; ++place) {
    const std::uint32_t i = samples.sample[place];
    const SurfacePoint p = lamps_.rays.surface(samples.ray[i], samples.hit[i]);
    for (std::size_t lamp = 0; lamp < lamps_.form.size(); ++lamp) {
      const LampVisibility& found = s.sight[lamp];
      if (begin > 0 && lamps_.form[lamp].closed() && !(found.seen > 0 && found.seen < found.sent)) continue;
      const std::uint32_t* shift = &s.shift[lamp * kShifts];
      const int count = lamps_.lights[lamp].extended() ? rays_each_ << samples.doublings : 1;
      for (int r = 0; r < count; ++r) {
        const int k = static_cast<int>(place) * count + r;
        lamp_rays.aim(lamp, p, golden_point(k, shift[2]), sobol_point(k, shift[0], shift[1]), s.sight[lamp],
                      &s.brought[lamp]);
      }
    }
  }
  lamp_rays.send();
}

/// The lamps whole, on the mean of some samples; where none of a lamp is seen, at the first. Returns by how
/// much the light of one that is seen differs among them from the first, relative.
float EdgeLight::find_whole(const EdgeSamples& samples, std::span<const std::uint32_t> some,
                            Scratch& s) const {
  std::fill(s.whole.begin(), s.whole.end(), 0.f);
  s.first = s.whole;
  float differs = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const SurfacePoint p = lamps_.rays.surface(samples.ray[some[k]], samples.hit[some[k]]);
    for (std::size_t lamp = 0; lamp < lamps_.form.size(); ++lamp) {
      const LampVisibility& sight = s.sight[lamp];
      if (!lamps_.form[lamp].closed() || !(sight.sent > 0) || (k > 0 && !(sight.seen > 0))) continue;
      const float whole = lamps_.form[lamp].projected_solid_angle(p.position, p.normal);
      s.whole[lamp] += sight.seen > 0 ? whole / static_cast<float>(some.size()) : whole;
      if (k == 0) s.first[lamp] = whole;
      if (const float larger = std::max(s.first[lamp], whole); larger > 0)
        differs = std::max(differs, std::fabs(whole - s.first[lamp]) / larger);
    }
  }
  return differs;
}

SharedLight EdgeLight::sum(const Scratch& s) const {
  SharedLight all;
  for (std::size_t lamp = 0; lamp < lamps_.form.size(); ++lamp) {
    PooledVisibility found;
    found.add(s.sight[lamp], 1), found.add(s.brought[lamp], 1);
    if (!lamps_.form[lamp].closed())
      all.add_mean(found);
    else if (found.sent > 0)
      all.add_share(lamps_.form[lamp].luminance() * s.whole[lamp], found.share(), variance_of_share(found));
  }
  return all;
}

SharedLight EdgeLight::light(const EdgeSamples& samples, const SharedLight* about, Scratch& s) const {
  s.sight.assign(lamps_.form.size(), LampVisibility()), s.brought.assign(lamps_.form.size(), Brought());
  s.whole.assign(lamps_.form.size(), 0.f);
  RandomStream random(seed_, Stage::edge_light, samples.pixel);
  random.start_bounce(samples.number & 0xffffu);
  s.shift.resize(lamps_.form.size() * kShifts);
  for (std::uint32_t& shift : s.shift) shift = random.bits();

  const std::size_t places = samples.sample.size(), tests = std::min(places, kTests);
  send(samples, 0, tests, s);
  bool right = false;
  if (about && about->variance == DVec3(0)) {
    find_whole(samples, samples.sample.first(1), s);
    const float expected = luminance(about->illuminance), found = luminance(sum(s).illuminance);
    right = std::fabs(found - expected) <= kUneven * std::max(found, expected);
  }
  if (!right) send(samples, tests, places, s);
  // Even where the pixel about them is right: light may change much from one side of the pixel to the other.
  const std::vector<std::uint32_t> two = mirrored(samples);
  if (two.empty() || find_whole(samples, two, s) > kSteep)
    find_whole(samples, some_of(samples, std::min(places, kWhole)), s);
  SharedLight light = sum(s);
  light.variance *= static_cast<double>(places);
  return light;
}

}  // namespace phos::inline splat
