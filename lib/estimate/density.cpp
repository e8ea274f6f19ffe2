#include "estimate/density.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "estimate/events.h"
#include "estimate/next_surface.h"
#include "estimate/record_of.h"

namespace phos::inline estimate {
namespace {

// A record reaches at least this part of the zone whose photons it has, as far as edges let it: nearer
// records would tell the same tale (docs/methods.md#z3). Surroundings nearer than that have had their say:
// they made the zone small.
constexpr float kReach = 0.75f;
constexpr float kRounding = 2e-6f;  // of a coordinate: positions are floats that rays have found
constexpr std::size_t kLeastClustered =
    128;  // photons that a zone must hold to be shrunk to a quarter of its area
constexpr std::size_t kLeastCompared = 64;  // photons that can tell an occlusion gradient from noise
// Points at the very border of a surface often lie outside of the hull: one in a thousand may be called dark.
constexpr double kDarkPhotons = 6.9;

/// Mean of |x|^2 under a kernel, over its mean under the disc (docs/methods.md#c4).
float kernel_spread(Kernel kernel) {
  if (kernel == Kernel::epanechnikov) return 2 / 3.f;
  if (kernel == Kernel::cone) return 3 / 5.f;
  return 1;
}

/// The mean of E over a disc of radius R exceeds that in its middle by R2/8 lap E + R4/192 lap lap E + ...
/// The mean of lap E, R2/8 times, has 1/64 there; on the disc shrunk to sqrt(1/3) it has 1/192.
constexpr float kBendStep = 0.4226497f;  // 1 - sqrt(1/3): so far a photon is moved towards the centroid

/// The part of a sum that is believed beyond its own noise, of that variance (as docs/methods.md#d4); below,
/// none.
double beyond_noise(double sum, double variance) {
  return sum * sum > 3 * variance ? 1 - 3 * variance / (sum * sum) : 0;
}

/// Probes of a zone by which its area is known four times as well as its Poisson photons tell their density:
/// n low-discrepancy probes err by n^-3/4 / 2 (probe_error), m photons by m^-1/2, so that n^3 = 16 m^2. A
/// hull needs some of them within itself.
int probes_for(std::size_t photons, std::int64_t most) {
  const std::int64_t least_probes = photons < static_cast<std::size_t>(DensityOptions().few) ? 32 : 64;
  const auto m = static_cast<std::int64_t>(std::min<std::size_t>(photons, 1 << 20));
  std::int64_t n = std::min(least_probes, most);
  while (n < most && n * n * n < 16 * m * m) ++n;
  return static_cast<int>(n);
}

/// More of the mean than this is not taken for curvature: the terms after it are as large.
constexpr double kMostBend = 0.25;

/// All zones have in common the variance that paths add to a zone, whose variance is `spread` times the
/// variance of its photons alone; a tiny part is left out.
float shared_of(double spread) {
  if (spread < 1.02) return kSharedByZones;
  return static_cast<float>((static_cast<double>(kSharedByZones) + spread - 1) / spread);
}

float scale_of(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }

}  // namespace

DensityEstimator::DensityEstimator(const PhotonMap& photons, const RayScene& rays,
                                   const RecordOptions& resolved, std::uint64_t seed)
    : photons_(photons),
      rays_(rays),
      options_(resolved),
      gatherer_(photons, rays, Counted(resolved), static_cast<float>(resolved.min_radius_m.value_or(0))),
      surroundings_(photons, rays, resolved, seed),
      noise_(photon_noise(photons, resolved.paths == Quantity::all)) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
  const PhotonTotals& totals = photons.totals;
  if (totals.stored > 0) {
    one_photon_lm_ = totals.stored_flux_lm / static_cast<float>(totals.stored);
  } else if (totals.emitted > 0) {
    one_photon_lm_ = totals.emitted_flux_lm / static_cast<float>(totals.emitted);
  }
}
DensityEstimator::~DensityEstimator() = default;

/// The zone's estimate; a zone with a caustic in it is made smaller while it has photons to spare
/// (docs/methods.md#c3).
ZoneEstimate DensityEstimator::by_hull(Zone& at, Scratch& s) const {
  ZonePlace& place = at.place;
  const OnSurface probe = [&](const Vec2& offset) { return gatherer_.on_surface(place, offset); };
  DensityOptions density{.dark_photons = kDarkPhotons, .centre_lit = at.left_out.own != kNoPhoton};
  const ZonePhotons& photons = s.gathered.zone;
  bool shrunk = false;
  for (;;) {
    place.parted = false;
    density.probes = probes_for(photons.size(), options_.probes);
    ZoneEstimate zone =
        zone_irradiance(photons.offset_m, photons.flux_lm, at.radius_m, probe, density, s.density);
    if (place.parted) {
      gatherer_.drop_hidden(place, s.gathered);
      zone = zone_irradiance(photons.offset_m, photons.flux_lm, at.radius_m, probe, density, s.density);
    }
    if (zone.clustered && photons.size() >= kLeastClustered) {
      at.radius_m /= 2, shrunk = true;
      gather(at, s);
      continue;
    }
    const auto count = [&](bool happened, const Event& event) {
      if (happened) s.counters.count(event);
    };
    count(zone.kind == ZoneKind::few, kTooFewPhotonsEvent);
    count(zone.kind == ZoneKind::full, kFullyLitEvent);
    count(zone.kind == ZoneKind::hull, kFromHullEvent);
    count(zone.kind == ZoneKind::dark, kInDarkEvent);
    count(zone.degenerate, kDegenerateHullEvent);
    count(shrunk, kShrunkZoneEvent);
    count(photons.size() == 0, kWithoutPhotonsEvent);
    count(zone.probed, kProbedEvent);
    count(place.parted, kBesideWallEvent);
    count(std::isfinite(zone.edge_m), kShadowEdgeEvent);
    return zone;
  }
}

ZoneEstimate DensityEstimator::by_kernel(const Zone& at, Scratch& s) const {
  const ZonePhotons& photons = s.gathered.zone;
  s.counters.count(kFromKernelEvent);
  if (photons.size() == 0) s.counters.count(kWithoutPhotonsEvent);
  return kernel_irradiance(photons.offset_m, photons.flux_lm, at.radius_m, options_.kernel, s.density);
}

/// Adds the part that counts of the photon on which the record sits; it covers photons within reach_m.
void DensityEstimator::count_own(const RecordSite& at, const ZonePlace& place, float zone_radius_m,
                                 float reach_m, ZoneEstimate& zone, Scratch& s) const {
  if (at.photon == kNoPhoton || zone.kind == ZoneKind::dark || !zone.centred) return;
  const double covered = std::min(1.0, static_cast<double>(reach_m) / static_cast<double>(zone_radius_m));
  const double mean =
      static_cast<double>(at.tried) * covered * covered * static_cast<double>(s.gathered.zone.size() + 1);
  const double share = mean > 0 ? 1 - mean / std::expm1(mean) : 0;
  if (!gatherer_.add_own(place, at.photon, static_cast<float>(share), s.gathered)) return;
  s.density.used.push_back(1);
  const double weight = zone.kind == ZoneKind::kernel ? kernel_weight(options_.kernel, 0) : 1;
  const DVec3 own = DVec3(s.gathered.zone.flux_lm.back()) * weight / zone.area_m2, error(zone.stderr_lx);
  zone.irradiance = Rgb(DVec3(zone.irradiance) + own);
  zone.stderr_lx = Rgb(glm::sqrt(error * error + own * own));
}

/// The part of the curvature `bend` (in the sum of flux; variance `noise`) that is taken away.
double DensityEstimator::share_of_bend(double bend, double noise, const ZoneEstimate& zone,
                                       float zone_radius_m, const Scratch& s) {
  const ZonePhotons& photons = s.gathered.zone;
  const double beyond = beyond_noise(bend, noise);
  if (!(beyond > 0)) return 0;
  ZoneShape shape = disc_shape(static_cast<double>(zone_radius_m));
  double area_m2 = zone.area_m2;
  if (zone.kind == ZoneKind::hull)
    shape = polygon_shape(photons.offset_m, s.density.hull.vertices), area_m2 = s.density.hull.area;
  double flux = 0, squares = 0, moment_m2 = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!s.density.used[i]) continue;
    const auto f = static_cast<double>(luminance(photons.flux_lm[i]));
    const glm::dvec2 place = glm::dvec2(photons.offset_m[i]) - shape.centroid_m;
    flux += f, squares += f * f, moment_m2 += f * glm::dot(place, place);
  }
  if (!(flux > 0)) return 0;
  const double share = std::min(beyond, kMostBend * flux / std::fabs(bend));
  const double even_m4 = shape.second_moments_m4[0][0] + shape.second_moments_m4[1][1];
  // Of a shape that is partly no surface, photons' places tell nothing to check it by.
  if (zone.partial || !(even_m4 > 0)) return 0;
  // Over a disc of light that is E + k r^2, the mean of r^2 exceeds half of R^2 by R^2 bend / (6 flux); its
  // own variance is 1/12 of the variance of the flux. If the photons lie as they would without, by e^2 : 1,
  // they do not come from where they seem to.
  const double moment = moment_m2 * area_m2 / (2 * even_m4 * flux) - 0.5, expected = bend / (6 * flux),
               variance = squares / (12 * flux * flux), off = moment - expected;
  return off * off - moment * moment > 4 * variance ? 0 : share;
}

/// Irradiance at p from the mean over the area, photon by photon: moved along the gradient from the area's
/// centroid (docs/methods.md#c3; photons from a wall nearby tell little of it), and without the part
/// that the curvature of irradiance adds to the mean, its Laplacian x (mean of |x - centroid|^2 - |p -
/// centroid|^2) / 4 - as for a disc of this area, and right in the next order too (kBendStep). Each is taken
/// away as far as it exceeds its own noise, so that even light stays as it is, the curvature up to kMostBend
/// of the mean, and unless the photons lie otherwise; the part that may be left is in the error. A kernel,
/// for comparison, keeps the bend, and its error contains it.
/// Returns the factor on the variance that comes from photons of one path; where paths are known, the
/// record's error contains it already.
double DensityEstimator::move_to_centre(const ZonePlace& place, const ZoneEstimate& zone, float zone_radius_m,
                                        Scratch& s, IrradianceRecord& record) const {
  const ZonePhotons& photons = s.gathered.zone;
  const Vec3 step = place.frame.to_world(Vec3(-zone.centroid_m, 0));
  const auto change = [&](std::size_t i) {
    return static_cast<double>(glm::dot(photon_translation_term(photons, i, place.frame.z), step));
  };
  const auto grey = [](const DVec3& light) { return static_cast<double>(luminance(Rgb(light))); };
  const bool kernel = zone.kind == ZoneKind::kernel;
  const float flat_m2 = static_cast<float>(zone.area_m2 / (8 * std::numbers::pi)) *
                            (kernel ? kernel_spread(options_.kernel) : 1) -
                        glm::dot(zone.centroid_m, zone.centroid_m) / 4;
  s.paths.set(s.gathered.family);
  PathSquares bend_squares(s.paths), move_squares(s.paths), squares(s.paths);
  DVec3 bend(0), move(0);
  s.bend.assign(photons.size(), 0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!s.density.used[i]) continue;
    const Vec2 to_centroid = zone.centroid_m - photons.offset_m[i];
    s.bend[i] =
        flat_m2 * curvature_term(photons.direction[i], photons.source_normal[i], photons.inverse_distance[i],
                                 place.frame.z, place.frame.to_world(Vec3(kBendStep * to_centroid, 0)));
    const DVec3 bent = DVec3(photons.flux_lm[i]) * static_cast<double>(s.bend[i]);
    bend += bent, bend_squares.add(i, bent);
    const DVec3 moved = DVec3(photons.flux_lm[i]) * change(i);
    move += moved, move_squares.add(i, moved);
  }
  const DVec3 bend2 = bend_squares.squares(), move2 = move_squares.squares();
  const auto spread = [&] {
    return s.paths.known() ? squares.spread() : noise_.spread(static_cast<double>(photons.size()));
  };
  if (kernel) {
    s.bend.assign(photons.size(), 0);
    for (std::size_t i = 0; i < photons.size(); ++i)
      if (s.density.used[i]) squares.add(i, DVec3(photons.flux_lm[i]));
    const DVec3 alone(zone.stderr_lx);
    const DVec3 left = glm::max(bend * bend - bend2, DVec3(0)) / (zone.area_m2 * zone.area_m2);
    record.stderr_lx = Rgb(glm::sqrt(alone * alone * squares.spread() + left));
    return spread();
  }
  const double bend_share = share_of_bend(grey(bend), bend_squares.grey_squares(), zone, zone_radius_m, s),
               move_share = beyond_noise(grey(move), move_squares.grey_squares());
  s.moved_m = -static_cast<float>(move_share) * zone.centroid_m;
  DVec3 sum(0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!s.density.used[i]) continue;
    s.bend[i] *= static_cast<float>(bend_share);
    const DVec3 f =
        DVec3(photons.flux_lm[i]) * ((1 + move_share * change(i)) * (1 - static_cast<double>(s.bend[i])));
    sum += f, squares.add(i, f);
  }
  const DVec3 moved = sum / zone.area_m2, geometric = moved * zone.area_error;
  const DVec3 left = (1 - bend_share) * (1 - bend_share) * glm::max(bend * bend - bend2, DVec3(0)) +
                     (1 - move_share) * (1 - move_share) * glm::max(move * move - move2, DVec3(0));
  const DVec3 variance = (squares.squares() + left) / (zone.area_m2 * zone.area_m2) + geometric * geometric;
  record.irradiance = Rgb(glm::clamp(moved, DVec3(0), 2.0 * DVec3(zone.irradiance)));
  record.stderr_lx = Rgb(glm::sqrt(variance));
  return spread();
}

/// Analytic gradients, and those that see dark occluders where the photons' places can tell
/// (docs/methods.md#d4).
ComparedGradients DensityEstimator::compared(const ZonePlace& place, const ZoneEstimate& zone,
                                             float zone_radius_m, const Scratch& s) const {
  const ZonePhotons& photons = s.gathered.zone;
  const std::span<const std::uint8_t> used(s.density.used);
  if (!zone.partial && photons.size() >= kLeastCompared) {
    const ZoneShape shape = zone.kind == ZoneKind::hull
                                ? polygon_shape(photons.offset_m, s.density.hull.vertices)
                                : disc_shape(static_cast<double>(zone_radius_m));
    return compare_gradients(photons, used, zone.area_m2, place.frame, shape);
  }
  const Gradients analytic = photon_gradients(photons, used, zone.area_m2, place.frame);
  return {analytic, analytic, analytic};
}

/// Irradiance at p with its error and gradients, and the radius that they and the edges allow. Without
/// photons, but its own, it is known no better than by the light of one photon.
void DensityEstimator::fill(const ZonePlace& place, const ZoneEstimate& zone, float zone_radius_m, Scratch& s,
                            IrradianceRecord& record) const {
  const auto a = static_cast<float>(options_.accuracy);
  const ZonePhotons& photons = s.gathered.zone;
  const Rgb one_photon_lx = one_photon_lm_ / static_cast<float>(zone.area_m2);
  if (photons.size() == 0 || zone.kind == ZoneKind::dark) {
    record.stderr_lx = one_photon_lx;
    if (zone.kind == ZoneKind::dark) record.radius_m = std::min(record.radius_m, 0.5f * zone.edge_m / a);
    return;
  }
  record.irradiance = zone.irradiance, record.stderr_lx = zone.stderr_lx;
  const double spread = move_to_centre(place, zone, zone_radius_m, s, record);
  if (!s.paths.known()) record.stderr_lx *= static_cast<float>(std::sqrt(spread));
  if (!s.others) record.stderr_lx = glm::max(record.stderr_lx, one_photon_lx);
  record.shared = shared_of(spread);
  const ComparedGradients known = compared(place, zone, zone_radius_m, s);
  // Counted, but no reason for a smaller radius: photons few enough to need one seldom tell (a thousandth of
  // the records of a Cornell box or Sponza), and errors there were the same with it.
  if (known.z2 > kOccludedZ2 && zone.kind != ZoneKind::kernel) {
    s.counters.count(kOcclusionEvent);
  }
  const float within = within_gradient_m(record.irradiance, known.analytic.translation, record.radius_m);
  record.radius_m = std::max(within, std::min(record.radius_m, kReach * zone_radius_m / a));
  const float bounded = std::min(1.f, within / record.radius_m);
  if (std::isfinite(zone.edge_m)) record.radius_m = std::min(record.radius_m, zone.edge_m / a);
  const Gradients g = options_.gradients == GradientMode::none         ? Gradients{}
                      : options_.gradients == GradientMode::positional ? known.positional
                      : options_.gradients == GradientMode::blend      ? known.blend
                      : options_.gradients == GradientMode::hemisphere
                          ? hemisphere_gradients(photons, s.density.used, zone.area_m2, place.frame,
                                                 static_cast<int>(options_.hemisphere_rings))
                          : known.analytic;
  require_finite(rays_.scene().origin_m, record.position, record.irradiance, record.stderr_lx, g.rotation,
                 g.translation);
  for (int c = 0; c < 3; ++c) {
    record.rotation_gradient[c] = g.rotation[c], record.translation_gradient[c] = bounded * g.translation[c];
  }
}

DensityEstimator::Zone DensityEstimator::zone_about(const RecordSite& at, Scratch& s) const {
  const Vec3 p = at.position;
  const float diagonal = rays_.scene().bounds.diagonal_m();
  const ZonePlace place{p, make_frame(at.normal),
                        kRounding * std::max({scale_of(p), 1e-3f * diagonal, 1e-30f})};
  float distance = surroundings_.distance_m(place, at.item, at.photon, s.near);
  if (!(distance < kInfinity)) distance = kInfinity;
  const ZoneRadius chosen = surroundings_.zone_radius(place, s.near, distance);
  Zone zone{place, chosen.radius_m, {at.photon, chosen.decided_by}, distance};
  gather(zone, s);
  return zone;
}

void DensityEstimator::gather(Zone& zone, Scratch& s) const {
  gatherer_.limit_slab(zone.place, zone.radius_m);
  gatherer_.gather(zone.place, zone.radius_m, zone.left_out, s.near, s.gathered);
}

Made DensityEstimator::make(const RecordSite& at, Worker& worker) const {
  auto& s = static_cast<Scratch&>(worker);
  return make_of(at, zone_about(at, s), s);
}

Rgb DensityEstimator::irradiance_lx(const RecordSite& at, Worker& worker) const {
  auto& s = static_cast<Scratch&>(worker);
  const Zone zone = zone_about(at, s);
  if (s.gathered.zone.size() > 0 || at.photon != kNoPhoton) return make_of(at, zone, s).record.irradiance;
  s.counters.count(kWithoutPhotonsEvent);
  return Rgb(0);
}

/// The record at a site, of the photons that were gathered in its zone.
Made DensityEstimator::make_of(const RecordSite& at, Zone about, Scratch& s) const {
  const ZonePlace& place = about.place;
  IrradianceRecord record;
  record.position = place.p, record.normal = at.normal;
  record.distance_m = about.distance_m;
  ZoneEstimate zone = options_.estimate == Estimate::kernel ? by_kernel(about, s) : by_hull(about, s);
  const float narrow = about.radius_m, seen = narrow / static_cast<float>(options_.accuracy);
  record.radius_m =
      std::max(kReach * seen, std::min(about.distance_m, static_cast<float>(*options_.max_radius_m)));
  s.others = s.gathered.zone.size() > 0;
  count_own(at, place, narrow, static_cast<float>(options_.accuracy) * record.radius_m, zone, s);
  s.frame = place.frame, s.zone = zone, s.moved_m = Vec2(0);
  // It serves no point whose photons it has not seen: their light may be another's.
  if (s.gathered.zone.size() > 0) record.radius_m = std::min(record.radius_m, seen);
  fill(place, zone, narrow, s, record);
  const float least = std::min(record.radius_m, kReach * seen);
  const float next_m =
      height_over_next_m(rays_, place.p, place.frame.z, 4 * place.rounding_m, record.radius_m);
  record.radius_m = std::max(least, std::min(record.radius_m, next_m * (1 / kNextSurface)));
  record.radius_m = std::max(record.radius_m, std::numeric_limits<float>::min());
  return {record, std::min(least, record.radius_m), at.least_radius_m, at.most_radius_m};
}

}  // namespace phos::inline estimate
