#include "estimate/zone/surroundings.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "photon/density.h"
#include "scene/material/passage.h"

namespace phos::inline estimate {
namespace {

// A zone short of photons grows to at most this many times a R: beyond, other light is mixed in.
constexpr float kMostGrowth = 2.5f;
constexpr std::size_t kLeastForDensity = 16;  // photons nearby that promise how many a zone will hold
constexpr std::size_t kMostNearest = 512;
// A zone ends before photon k, where this part of the area between it and the one before is within: rounding
// must not decide whether the photon counts, nor its distance be told from another.
constexpr float kOfLastGap = 0.99f;

/// A radius that holds k photons of these radii, and not the one after, m.
float holding_m(const std::vector<float>& radii, std::size_t k) {
  const float before = k > 0 ? radii[k - 1] : 0.f, after = radii[k];
  return std::sqrt(before * before + kOfLastGap * (after - before) * (after + before));
}

}  // namespace

float Surroundings::distance_m(const ZonePlace& place, std::uint64_t item, std::uint32_t left_out,
                               NearPhotons& near) const {
  const float by_rays = by_rays_m(place, item);
  const float by_photons = by_photons_m(place, left_out, by_rays, near);
  if (options_.distance_rays == 0) return by_photons;
  // Few photons that by chance come from afar are as dim by chance: their record would be dark and reach far.
  const float share =
      0.5f * static_cast<float>(near.radii.size()) / static_cast<float>(options_.near_photons);
  return near.radii.empty() ? by_rays : 1 / (share / by_photons + (1 - share) / by_rays);
}

/// Harmonic mean over cosine-weighted rays, misses counting as infinitely far (docs/methods.md#a7). Photons
/// never come from dark surfaces; rays see them.
float Surroundings::by_rays_m(const ZonePlace& place, std::uint64_t item) const {
  const auto n = static_cast<int>(options_.distance_rays);
  if (n == 0) return kInfinity;
  RandomStream random(seed_, Stage::record, item);
  const double turn = 2 * std::numbers::pi * random.uniform_double();
  const auto least = static_cast<float>(*options_.min_radius_m);
  double sum = 0;
  std::vector<Crossing> crossings;
  for (int i = 0; i < n; ++i) {
    const double r2 = (i + 0.5) / n, r = std::sqrt(r2), t = turn + i * 2.399963229728653;
    const Vec3 local(r * std::cos(t), r * std::sin(t), std::sqrt(1 - r2));
    const Ray ray{place.p + 4 * place.rounding_m * place.frame.z, place.frame.to_world(local), 0, kInfinity};
    Hit hit;  // behind panes: they do not make records about windows small
    if (rays_.through(ray, hit, crossings)) sum += 1 / static_cast<double>(std::max(hit.distance_m, least));
  }
  return sum > 0 ? static_cast<float>(n / sum) : kInfinity;
}

/// The first of two queries (docs/methods.md#c6): the nearest photons tell how far the surroundings are.
float Surroundings::by_photons_m(const ZonePlace& place, std::uint32_t left_out, float limit_m,
                                 NearPhotons& near) const {
  near.clear(), near.complete_m = 0;
  const auto wanted = static_cast<std::size_t>(options_.near_photons);
  for (std::size_t k = wanted; photons_.size() > 0; k *= 4) {
    const std::size_t most = std::min(k, photons_.size());
    photons_.nearest(place.p, most, near.rows, near.distance2, limit_m);
    near.clear();
    const bool all = near.rows.size() < most || most == photons_.size();
    const float reach = near.rows.size() < most ? limit_m : std::sqrt(near.distance2.back());
    near.complete_m = reach;
    const float slab = slab_m(place, reach);
    for (std::size_t i = 0; i < near.rows.size() && near.radii.size() < wanted; ++i) {
      const std::uint32_t row = near.rows[i];
      const float away = std::sqrt(near.distance2[i]);
      if (row == left_out || !is_wanted(photons_, row, Counted(options_)) ||
          std::fabs(glm::dot(photons_.position[row] - place.p, place.frame.z)) > slab)
        continue;
      if (glm::dot(decode_octahedral(photons_.normal[row]), place.frame.z) < kSameFacing) continue;
      const Vec3 w = place.frame.to_local(decode_octahedral(photons_.direction[row]));
      if (!(w.z > kLeastRise)) continue;
      near.radii.push_back(away), near.directions.push_back(w), near.last = row;
      near.weights.push_back(luminance(photons_.flux[row])), near.distances.push_back(photons_.distance[row]);
    }
    if (all || k * 4 > kMostNearest || near.radii.size() >= std::min(wanted, kLeastForDensity)) break;
  }
  return mean_distance_m(near.directions, near.weights, near.distances);
}

ZoneRadius Surroundings::zone_radius(const ZonePlace& place, const NearPhotons& near,
                                     float distance_m) const {
  const auto most = static_cast<float>(*options_.max_radius_m);
  const float right = static_cast<float>(options_.accuracy) * std::min(distance_m, most);
  float radius = right;
  std::uint32_t decided_by = kNoPhoton;
  if (near.radii.size() >= kLeastForDensity) {
    const std::size_t k = near.radii.size(), least = static_cast<std::size_t>(options_.min_photons);
    const float last = std::max(holding_m(near.radii, k - 1), place.rounding_m);
    const auto holding = [&](double photons) {
      return last * static_cast<float>(std::sqrt(photons / static_cast<double>(k)));
    };
    const float lower =
        k >= least && least > 0 ? holding_m(near.radii, least - 1) : holding(static_cast<double>(least));
    const float upper = holding(static_cast<double>(options_.max_photons));
    radius = std::max(std::min(radius, upper), lower);
    if (radius != right && (radius == upper || k < least)) decided_by = near.last;
  } else {
    radius = most;
  }
  const auto least_right = static_cast<float>(options_.accuracy * *options_.min_radius_m);
  const float bounded = std::min({radius, kMostGrowth * std::max(right, 2 * least_right), most});
  return {std::max(bounded, 64 * place.rounding_m), bounded < radius ? kNoPhoton : decided_by};
}

}  // namespace phos::inline estimate
