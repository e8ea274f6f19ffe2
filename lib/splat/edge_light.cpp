#include "splat/edge_light.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/sampling.h"

namespace phos {
namespace {

/// Samples that tell whether their neighbours' light is their own, and the difference, relative, from which
/// on it is not.
constexpr std::size_t kTests = 8;
constexpr float kUneven = 0.05f;
constexpr std::uint32_t kShifts = 3;  // of a lamp's points
/// Variance of the share that even points see of a lamp, over that of independent ones: 0.11 was measured for
/// straight shadow edges; more is left for others.
constexpr float kEven = 0.25f;

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
      const Sight& found = s.sight[lamp];
      if (begin > 0 && lamps_.form[lamp].closed() && !(found.seen > 0 && found.seen < found.sent)) continue;
      const std::uint32_t* shift = &s.shift[lamp * kShifts];
      const int count = lamps_.lights[lamp].extended() ? rays_each_ : 1;
      for (int r = 0; r < count; ++r) {
        const int k = static_cast<int>(place) * count + r;
        lamp_rays.aim(lamp, p, golden_point(k, shift[2]), sobol_point(k, shift[0], shift[1]), s.sight[lamp],
                      &s.brought[lamp]);
      }
    }
  }
  lamp_rays.send();
}

/// The lamps whole, at places begin .. end - 1.
void EdgeLight::add_whole(const EdgeSamples& samples, std::size_t begin, std::size_t end, Scratch& s) const {
  for (std::size_t place = begin; place < end; ++place) {
    const std::uint32_t i = samples.sample[place];
    const SurfacePoint p = lamps_.rays.surface(samples.ray[i], samples.hit[i]);
    for (std::size_t lamp = 0; lamp < lamps_.form.size(); ++lamp)
      if (lamps_.form[lamp].closed() && s.sight[lamp].seen > 0)
        s.whole[lamp] += lamps_.form[lamp].projected_solid_angle(p.position, p.normal);
  }
}

/// `places`: at which the lamps were taken whole.
SharedLight EdgeLight::sum(std::size_t places, const Scratch& s) const {
  SharedLight all;
  for (std::size_t lamp = 0; lamp < lamps_.form.size(); ++lamp) {
    Finding found;
    found.add(s.sight[lamp], 1), found.add(s.brought[lamp], 1);
    if (!lamps_.form[lamp].closed()) {
      all.add_mean(found);
    } else if (found.seen > 0) {
      const float whole = s.whole[lamp] / static_cast<float>(places);
      all.add_share(lamps_.form[lamp].luminance() * whole, found.share(),
                    kEven * found.variance_of(found.share()));
    }
  }
  return all;
}

std::optional<SharedLight> EdgeLight::light(const EdgeSamples& samples, const SharedLight* about,
                                            Scratch& s) const {
  s.sight.assign(lamps_.form.size(), Sight()), s.brought.assign(lamps_.form.size(), Brought());
  s.whole.assign(lamps_.form.size(), 0.f);
  RandomStream random(seed_, Stage::edge_light, samples.pixel);
  random.start_bounce(samples.number & 0xffffu);
  s.shift.resize(lamps_.form.size() * kShifts);
  for (std::uint32_t& shift : s.shift) shift = random.bits();

  const std::size_t places = samples.sample.size(), tests = std::min(places, kTests);
  send(samples, 0, tests, s);
  if (about && about->variance == DVec3(0)) {
    add_whole(samples, 0, 1, s);
    const float expected = luminance(about->illuminance), found = luminance(sum(1, s).illuminance);
    if (std::fabs(found - expected) <= kUneven * std::max(found, expected)) return {};
  }
  send(samples, tests, places, s);
  std::fill(s.whole.begin(), s.whole.end(), 0.f);
  add_whole(samples, 0, tests, s);
  SharedLight light = sum(tests, s);
  light.variance *= static_cast<double>(places);
  return light;
}

}  // namespace phos
