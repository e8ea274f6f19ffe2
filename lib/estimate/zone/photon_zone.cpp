#include "estimate/zone/photon_zone.h"

#include <algorithm>
#include <cmath>

#include "core/octahedral.h"

namespace phos::inline estimate {
const FacingCells& ZoneGatherer::facing() const {
  std::call_once(once_, [&] {
    facing_.emplace(photons_, [&](std::uint32_t row) { return is_wanted(photons_, row, counted_); });
  });
  return *facing_;
}

void ZoneGatherer::gather(const ZonePlace& place, float radius_m, const LeftOut& left_out,
                          const NearPhotons& near_photons, GatheredPhotons& gathered) const {
  ZonePhotons& zone = gathered.zone;
  const float sphere_m = radius_m * (1 + kSlab * kSlab);
  if (sphere_m < near_photons.complete_m) {
    const auto& distance2 = near_photons.distance2;
    const auto end = std::upper_bound(distance2.begin(), distance2.end(), sphere_m * sphere_m);
    gathered.rows.assign(near_photons.rows.begin(), near_photons.rows.begin() + (end - distance2.begin()));
  } else if (near_photons.radii.empty() && !facing().may_hold(place, radius_m)) {
    gathered.rows.clear();  // a dark side of something: its sphere may hold all photons of a lit one
  } else {
    photons_.in_sphere(place.p, sphere_m, gathered.rows);
  }
  const std::size_t found = gathered.rows.size();
  zone.resize(found), gathered.height_m.resize(found), gathered.codes.resize(found);
  const bool families = !photons_.family.empty();
  gathered.family.resize(families ? found : 0);
  std::size_t near = 0;
  std::uint32_t last_code = 0;
  float facing = glm::dot(decode_octahedral(last_code), place.frame.z);
  for (const std::uint32_t row : gathered.rows) {
    if (row == left_out.own || row == left_out.decided || !is_wanted(photons_, row, counted_)) continue;
    const Vec3 local = place.frame.to_local(photons_.position[row] - place.p);
    if (local.z > place.above_m || local.z < -place.below_m) continue;
    // Strictly inside: a zone that ends at a photon does not hold that photon
    // (docs/methods.md#c4).
    if (!(local.x * local.x + local.y * local.y < radius_m * radius_m)) continue;
    if (photons_.normal[row] != last_code) {
      last_code = photons_.normal[row];
      facing = glm::dot(decode_octahedral(last_code), place.frame.z);
    }
    if (facing < kSameFacing) continue;
    gathered.rows[near] = row, gathered.codes[near] = photons_.direction[row];
    zone.offset_m[near] = Vec2(local), gathered.height_m[near] = local.z;
    // Flux per surface area times `facing` is flux per tangent-plane area.
    zone.flux_lm[near] = photons_.flux[row] * facing;
    ++near;
  }
  decode_octahedral(std::span(gathered.codes).first(near), zone.direction);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near; ++i) {
    if (!(glm::dot(zone.direction[i], place.frame.z) > kLeastRise)) continue;
    const std::uint32_t row = gathered.rows[i];
    zone.offset_m[kept] = zone.offset_m[i], gathered.height_m[kept] = gathered.height_m[i];
    zone.flux_lm[kept] = zone.flux_lm[i], zone.direction[kept] = zone.direction[i];
    zone.inverse_distance[kept] = 1 / std::max(photons_.distance[row], nearest_m_);
    gathered.codes[kept] = photons_.source_normal[row];
    if (families) gathered.family[kept] = photons_.family[row];
    ++kept;
  }
  zone.resize(kept), gathered.height_m.resize(kept), gathered.family.resize(families ? kept : 0);
  decode_octahedral(std::span(gathered.codes).first(kept), zone.source_normal);
}

bool ZoneGatherer::add_own(const ZonePlace& place, std::uint32_t row, float share,
                           GatheredPhotons& gathered) const {
  const Vec3 direction = decode_octahedral(photons_.direction[row]);
  if (!(glm::dot(direction, place.frame.z) > kLeastRise)) return false;
  ZonePhotons& zone = gathered.zone;
  const std::size_t last = zone.size();
  zone.resize(last + 1), gathered.height_m.push_back(0);
  if (!photons_.family.empty()) gathered.family.push_back(photons_.family[row]);
  zone.offset_m[last] = Vec2(0), zone.flux_lm[last] = share * photons_.flux[row];
  zone.direction[last] = direction, zone.source_normal[last] = decode_octahedral(photons_.source_normal[row]);
  zone.inverse_distance[last] = 1 / std::max(photons_.distance[row], nearest_m_);
  return true;
}

void ZoneGatherer::drop_hidden(const ZonePlace& place, GatheredPhotons& gathered) const {
  ZonePhotons& zone = gathered.zone;
  const bool families = !gathered.family.empty();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < zone.size(); ++i) {
    if (!within_sight(place, zone.offset_m[i], gathered.height_m[i])) continue;
    zone.move(i, kept), gathered.height_m[kept] = gathered.height_m[i];
    if (families) gathered.family[kept] = gathered.family[i];
    ++kept;
  }
  zone.resize(kept), gathered.height_m.resize(kept), gathered.family.resize(families ? kept : 0);
}

}  // namespace phos::inline estimate
