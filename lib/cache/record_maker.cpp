#include "cache/record_maker.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"

namespace phos {
namespace {

// A record reaches at least this part of the zone whose photons it has: nearer records would tell the same
// tale.
constexpr float kReach = 0.75f;
// A zone short of photons grows to at most this many times a R: beyond, other light is mixed in.
constexpr float kMostGrowth = 2.5f;
constexpr float kSlab = 0.05f;             // half thickness of a zone in its radii (FORMULAS C5)
constexpr float kSameFacing = 0.9396926f;  // cos 20 deg (C5)
constexpr float kRounding = 2e-6f;         // of a coordinate: positions are floats that rays have found
constexpr std::size_t kLeastClustered =
    128;  // photons that a zone must hold to be shrunk to a quarter of its area
// Points at the very border of a surface often lie outside of the hull: one in a thousand may be called dark.
constexpr double kDarkPhotons = 6.9;
constexpr std::size_t kLeastForDensity = 16;  // photons nearby that promise how many a zone will hold
constexpr std::size_t kMostNearest = 512;

float scale_of(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }

}  // namespace

/// Where a record is made.
struct RecordMaker::Site {
  Vec3 p;
  Frame frame;
  float rounding_m;                // of coordinates here
  float above_m = 0, below_m = 0;  // slab that holds the zone's photons
  bool parted = false;             // something stands between the record and a part of its surface
};

RecordMaker::RecordMaker(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
                         std::uint64_t seed)
    : photons_(photons), rays_(rays), options_(resolved), seed_(seed) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
  const PhotonTotals& totals = photons.totals;
  if (totals.stored > 0) {
    one_photon_lm_ = totals.stored_flux_lm / static_cast<float>(totals.stored);
  } else if (totals.emitted > 0) {
    one_photon_lm_ = totals.emitted_flux_lm / static_cast<float>(totals.emitted);
  }
}
RecordMaker::~RecordMaker() = default;

/// Harmonic mean over cosine-weighted rays, misses counting as infinitely far (A7). Photons never come from
/// dark surfaces; rays see them.
float RecordMaker::ray_distance_m(const Site& site, std::uint64_t item) const {
  const auto n = static_cast<int>(options_.distance_rays);
  if (n == 0) return kInfinity;
  RandomStream random(seed_, Stage::record, item);
  const double turn = 2 * std::numbers::pi * random.uniform_double();
  const auto least = static_cast<float>(*options_.min_radius_m);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double r2 = (i + 0.5) / n, r = std::sqrt(r2), t = turn + i * 2.399963229728653;
    const Vec3 local(r * std::cos(t), r * std::sin(t), std::sqrt(1 - r2));
    const Ray ray{site.p + 4 * site.rounding_m * site.frame.z, site.frame.to_world(local), 0, kInfinity};
    Hit hit;
    if (rays_.intersect(ray, hit)) sum += 1 / static_cast<double>(std::max(hit.distance_m, least));
  }
  return sum > 0 ? static_cast<float>(n / sum) : kInfinity;
}

/// The thesis' first query: the nearest photons tell how far the surroundings are. Leaves their distances
/// from p in scratch.radii, sorted, for the choice of the zone.
float RecordMaker::photon_distance_m(const Site& site, std::uint32_t seed_row, Scratch& s,
                                     float limit_m) const {
  s.radii.clear(), s.directions.clear(), s.weights.clear(), s.distances.clear();
  const auto wanted_count = static_cast<std::size_t>(options_.near_photons);
  for (std::size_t k = wanted_count; photons_.size() > 0; k *= 4) {
    photons_.nearest(site.p, std::min(k, photons_.size()), s.rows, s.distance2);
    s.radii.clear(), s.directions.clear(), s.weights.clear(), s.distances.clear();
    const float reach = std::min(limit_m, s.distance2.empty() ? 0.f : std::sqrt(s.distance2.back()));
    const float slab = std::max(kSlab * reach, 4 * site.rounding_m);
    for (std::size_t i = 0; i < s.rows.size() && s.radii.size() < wanted_count; ++i) {
      const std::uint32_t row = s.rows[i];
      const float away = std::sqrt(s.distance2[i]);
      if (away > limit_m) break;
      if (row == seed_row || !wanted(row) ||
          std::fabs(glm::dot(photons_.position[row] - site.p, site.frame.z)) > slab)
        continue;
      if (glm::dot(decode_octahedral(photons_.normal[row]), site.frame.z) < kSameFacing) continue;
      const Vec3 w = site.frame.to_local(decode_octahedral(photons_.direction[row]));
      if (!(w.z > 0)) continue;
      s.radii.push_back(away), s.directions.push_back(w);
      s.weights.push_back(luminance(photons_.flux[row])), s.distances.push_back(photons_.distance[row]);
    }
    const bool exhausted = s.rows.size() >= photons_.size() || k * 4 > kMostNearest ||
                           (!s.distance2.empty() && std::sqrt(s.distance2.back()) > limit_m);
    if (exhausted || s.radii.size() >= std::min(wanted_count, kLeastForDensity)) break;
  }
  return mean_distance_m(s.directions, s.weights, s.distances);
}

/// The second query's radius: a x R, enlarged or reduced for the photons that its neighbourhood promises.
float RecordMaker::zone_radius_m(const Site& site, const Scratch& s, float distance_m) const {
  const auto most = static_cast<float>(*options_.max_radius_m);
  const float right = static_cast<float>(options_.accuracy) * std::min(distance_m, most);
  float radius = right;
  if (s.radii.size() >= kLeastForDensity) {
    const std::size_t k = s.radii.size(), least = static_cast<std::size_t>(options_.min_photons);
    const float last = std::max(s.radii.back(), site.rounding_m);
    const auto holding = [&](double photons) {
      return last * static_cast<float>(std::sqrt(photons / static_cast<double>(k)));
    };
    const float lower = k >= least && least > 0 ? s.radii[least - 1] : holding(static_cast<double>(least));
    const float upper = holding(static_cast<double>(options_.max_photons));
    radius = std::max(std::min(radius, upper), lower);
  } else {
    radius = most;
  }
  const auto least_right = static_cast<float>(options_.accuracy * *options_.min_radius_m);
  radius = std::min({radius, kMostGrowth * std::max(right, 2 * least_right), most});
  return std::max(radius, 64 * site.rounding_m);
}

/// Parallel sheets: the slab ends half way to the next surface above and below, if one is within it.
void RecordMaker::limit_slab(Site& site, float radius_m) const {
  const float slab = std::max(kSlab * radius_m, 4 * site.rounding_m);
  const auto half_way = [&](const Vec3& direction) {
    Hit hit;
    const Ray ray{site.p, direction, std::max(4 * site.rounding_m, 0.02f * slab), slab};
    return slab > 4 * site.rounding_m && rays_.intersect(ray, hit) ? hit.distance_m / 2 : slab;
  };
  site.above_m = half_way(site.frame.z), site.below_m = half_way(-site.frame.z);
}

/// A lookup on a parallel surface not far below must be able to tell that this record lies in front of it
/// (record_in_front allows 1 % of R): the radius that a surface below leaves.
float RecordMaker::above_next_surface_m(const Site& site, float radius_m) const {
  Hit hit;
  const Ray ray{site.p, -site.frame.z, 4 * site.rounding_m, 0.02f * radius_m};
  return ray.t_max_m > ray.t_min_m && rays_.intersect(ray, hit) ? 50 * hit.distance_m : radius_m;
}

/// FORMULAS C5: photons on this surface, from this side.
void RecordMaker::gather(const Site& site, float radius_m, std::uint32_t seed_row, Scratch& s) const {
  s.zone.clear(), s.height_m.clear();
  photons_.in_sphere(site.p, radius_m * (1 + kSlab * kSlab), s.rows);
  const auto nearest = static_cast<float>(*options_.min_radius_m);
  std::uint32_t last_code = 0;
  float facing = -1;
  bool decoded = false;
  for (const std::uint32_t row : s.rows) {
    if (row == seed_row || !wanted(row)) continue;
    const Vec3 local = site.frame.to_local(photons_.position[row] - site.p);
    if (local.z > site.above_m || local.z < -site.below_m) continue;
    // Strictly inside: a zone whose radius is that of a photon does not hold that photon (C4).
    if (!(local.x * local.x + local.y * local.y < radius_m * radius_m)) continue;
    if (!decoded || photons_.normal[row] != last_code) {
      last_code = photons_.normal[row], decoded = true;
      facing = glm::dot(decode_octahedral(last_code), site.frame.z);
    }
    if (facing < kSameFacing) continue;
    const Vec3 w = decode_octahedral(photons_.direction[row]);
    if (!(glm::dot(w, site.frame.z) > 0)) continue;
    s.zone.offset_m.push_back(Vec2(local)), s.height_m.push_back(local.z);
    // Flux per surface area times `facing` is flux per tangent-plane area.
    s.zone.flux_lm.push_back(photons_.flux[row] * facing);
    s.zone.direction.push_back(w);
    s.zone.inverse_distance.push_back(1 / std::max(photons_.distance[row], nearest));
    s.zone.source_normal.push_back(decode_octahedral(photons_.source_normal[row]));
  }
}

/// Does a line above the surface lead from the record to that place? Walls that stand on the surface part it,
/// and surfaces run on inside of walls, where no light comes.
bool RecordMaker::within_sight(const Site& site, const Vec2& offset_m, float height_m) const {
  const Vec3 up = site.above_m * site.frame.z;
  const Vec3 to = site.frame.to_world(Vec3(offset_m, height_m));
  const float distance = glm::length(to);
  return !(distance > 0) || !rays_.occluded({site.p + up, to / distance, 0, distance});
}

bool RecordMaker::on_surface(Site& site, const Vec2& offset_m) const {
  const Vec3 from = site.p + site.frame.to_world(Vec3(offset_m, site.above_m));
  const Ray ray{from, -site.frame.z, 0, site.above_m + site.below_m};
  Hit hit;
  if (!rays_.intersect(ray, hit)) return false;
  if (!(glm::dot(rays_.surface(ray, hit).smooth_normal, site.frame.z) > kSameFacing)) return false;
  if (within_sight(site, offset_m, site.above_m - hit.distance_m)) return true;
  site.parted = true;
  return false;
}

/// Leaves out the photons of places that are not within_sight.
void RecordMaker::drop_hidden(const Site& site, Scratch& s) const {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.zone.size(); ++i) {
    if (!within_sight(site, s.zone.offset_m[i], s.height_m[i])) continue;
    s.zone.move(i, kept), s.height_m[kept] = s.height_m[i];
    ++kept;
  }
  s.zone.resize(kept), s.height_m.resize(kept);
}

/// The zone's estimate; a zone with a caustic in it is made smaller while it has photons to spare (C3).
ZoneEstimate RecordMaker::estimate(Site& site, float& radius_m, std::uint32_t seed_row, Scratch& s) const {
  const OnSurface probe = [&](const Vec2& offset) { return on_surface(site, offset); };
  const DensityOptions density{.probes = static_cast<int>(options_.probes),
                               .dark_photons = kDarkPhotons,
                               .centre_lit = seed_row != kNoPhoton};
  bool shrunk = false;
  for (;;) {
    limit_slab(site, radius_m);
    site.parted = false;
    gather(site, radius_m, seed_row, s);
    ZoneEstimate zone = zone_irradiance(s.zone.offset_m, s.zone.flux_lm, radius_m, probe, density, s.density);
    if (site.parted) {
      drop_hidden(site, s);
      zone = zone_irradiance(s.zone.offset_m, s.zone.flux_lm, radius_m, probe, density, s.density);
    }
    if (zone.clustered && s.zone.size() >= kLeastClustered) {
      radius_m /= 2, shrunk = true;
      continue;
    }
    const auto count = [&](bool happened, const char* event) {
      if (happened) s.counters.count(event);
    };
    count(zone.kind == ZoneKind::few, "records with too few photons");
    count(zone.kind == ZoneKind::full, "records fully lit");
    count(zone.kind == ZoneKind::hull, "records from the hull");
    count(zone.kind == ZoneKind::dark, "records in the dark");
    count(zone.degenerate, "records with degenerate hull");
    count(shrunk, "records with shrunk zone");
    count(s.zone.size() == 0, "records without photons");
    count(zone.probed, "records probed");
    count(site.parted, "records beside a wall");
    count(std::isfinite(zone.edge_m), "records at a shadow edge");
    return zone;
  }
}

/// Irradiance moved from the area's centroid to p along the gradient, photon by photon (C3).
void RecordMaker::move_to_centre(const Site& site, const ZoneEstimate& zone, const Scratch& s,
                                 IrradianceRecord& record) const {
  const Vec3 step = site.frame.to_world(Vec3(-zone.centroid_m, 0));
  DVec3 sum(0), squares(0);
  for (std::size_t i = 0; i < s.zone.size(); ++i) {
    if (!s.density.used[i]) continue;
    const double change =
        static_cast<double>(glm::dot(photon_translation_term(s.zone, i, site.frame.z), step));
    const DVec3 f = DVec3(s.zone.flux_lm[i]) * (1 + change);
    sum += f, squares += f * f;
  }
  const DVec3 moved = sum / zone.area_m2, geometric = moved * zone.area_error;
  record.irradiance = Rgb(glm::clamp(moved, DVec3(0), 2.0 * DVec3(zone.irradiance)));
  record.stderr_lx = Rgb(glm::sqrt(squares / (zone.area_m2 * zone.area_m2) + geometric * geometric));
}

/// Irradiance at p with its error and gradients, and what they and the edges allow of the radius.
void RecordMaker::fill(const Site& site, const ZoneEstimate& zone, float zone_radius_m, const Scratch& s,
                       IrradianceRecord& record) const {
  const auto a = static_cast<float>(options_.accuracy);
  if (s.zone.size() == 0 || zone.kind == ZoneKind::dark) {
    // What one photon would have shown: the dark is known no better.
    record.stderr_lx = one_photon_lm_ / static_cast<float>(zone.area_m2);
    if (zone.kind == ZoneKind::dark) record.radius_m = std::min(record.radius_m, 0.5f * zone.edge_m / a);
    return;
  }
  const std::span<const std::uint8_t> used(s.density.used);
  record.irradiance = zone.irradiance, record.stderr_lx = zone.stderr_lx;
  if (zone.centroid_m != Vec2(0)) move_to_centre(site, zone, s, record);
  const Gradients analytic = photon_gradients(s.zone, used, zone.area_m2, site.frame);
  const float brightest = max_component(record.irradiance);
  float within = record.radius_m;  // KBPv06: where the gradient would change a channel by itself
  for (int c = 0; c < 3; ++c) {
    const float slope = glm::length(analytic.translation[c]);
    if (record.irradiance[c] > 0.01f * brightest && slope * within > record.irradiance[c]) {
      within = record.irradiance[c] / slope;
    }
  }
  record.radius_m = std::max(within, kReach * zone_radius_m / a);
  const float bounded = std::min(1.f, within / record.radius_m);
  if (std::isfinite(zone.edge_m)) record.radius_m = std::min(record.radius_m, zone.edge_m / a);
  if (options_.gradients == GradientMode::none) return;
  const Gradients g = options_.gradients == GradientMode::analytic
                          ? analytic
                          : hemisphere_gradients(s.zone, used, zone.area_m2, site.frame,
                                                 static_cast<int>(options_.hemisphere_rings));
  for (int c = 0; c < 3; ++c) {
    record.rotation_gradient[c] = g.rotation[c], record.translation_gradient[c] = bounded * g.translation[c];
  }
}

Made RecordMaker::make(const RecordSite& at, Worker& worker) const {
  auto& s = static_cast<Scratch&>(worker);
  const Vec3 p = at.position, n = at.normal;
  const std::uint32_t seed_row = at.photon;
  const float diagonal = rays_.scene().bounds.diagonal_m();
  Site site{p, make_frame(n), kRounding * std::max({scale_of(p), 1e-3f * diagonal, 1e-30f})};
  const float by_rays = ray_distance_m(site, at.item);
  const float by_photons = photon_distance_m(site, seed_row, s, by_rays);
  // Photons know the lit surroundings, rays the dark ones too: the harmonic mean of both, or the one there
  // is.
  float distance = by_photons;
  if (options_.distance_rays > 0) {
    distance = s.radii.empty() ? by_rays : 2 / (1 / by_photons + 1 / by_rays);
  }
  if (!(distance < kInfinity)) distance = kInfinity;

  IrradianceRecord record;
  record.position = p, record.normal = n;
  record.distance_m = distance;
  record.radius_m = std::min(distance, static_cast<float>(*options_.max_radius_m));
  const float wide = zone_radius_m(site, s, distance);
  float narrow = wide;
  const ZoneEstimate zone = estimate(site, narrow, seed_row, s);
  // It serves no point whose photons it has not seen: their light may be another's.
  if (s.zone.size() > 0)
    record.radius_m = std::min(record.radius_m, narrow / static_cast<float>(options_.accuracy));
  fill(site, zone, narrow, s, record);
  const float least = std::min(record.radius_m, kReach * narrow / static_cast<float>(options_.accuracy));
  record.radius_m = std::max(least, std::min(record.radius_m, above_next_surface_m(site, record.radius_m)));
  record.radius_m = std::max(record.radius_m, std::numeric_limits<float>::min());
  bool finite = is_finite(record.irradiance) && is_finite(record.stderr_lx);
  for (int c = 0; c < 3; ++c) {
    finite = finite && is_finite(record.rotation_gradient[c]) && is_finite(record.translation_gradient[c]);
  }
  if (!finite) {
    throw Error(ExitCode::numerical, "",
                text("irradiance at (", p.x, ", ", p.y, ", ", p.z,
                     ") m exceeds the range of numbers; give the lights or the scene other units"));
  }
  return {record, std::min(least, record.radius_m), at.least_radius_m, at.most_radius_m};
}

}  // namespace phos
