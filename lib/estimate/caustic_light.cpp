#include "estimate/caustic_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "direct/direct_light.h"

namespace phos::inline estimate {
namespace {

/// Photons of the first, smallest query; each next one has four times as many.
constexpr std::size_t kFirstPhotons = 32, kMorePhotons = 4;
/// Light spread over the whole of a disc is as much as this part of the light on its part that is surface.
constexpr float kLeastShare = 0.25f;
/// Discs reach no farther than this part of the scene's diagonal.
constexpr float kMostReach = 1 / 8.f;
/// Looks for a border of the surface: about the rim of the disc, where it shows first, and within.
constexpr int kRim = 16, kInner = 8;
constexpr float kRimAt = 0.93f, kInnerAt = 0.5f;
/// Probes of a disc that has a border.
constexpr int kProbes = 256;
/// Directions along a virtual disc in which walls are looked for.
constexpr int kDirections = 64;
constexpr double kGoldenAngle = 2.399963229728653;

/// One of n probes, by growing distance, of equal area each.
Vec2 probe_offset(int i, int n, float radius_m) {
  const double r = std::sqrt((i + 0.5) / n), t = i * kGoldenAngle;
  return static_cast<float>(r) * radius_m * Vec2(std::cos(t), std::sin(t));
}

Vec2 on_circle(int i, int n, float radius_m) {
  const double t = 2 * std::numbers::pi * i / n;
  return radius_m * Vec2(std::cos(t), std::sin(t));
}

}  // namespace

CausticLight::CausticLight(const RayScene& rays, std::shared_ptr<const CausticMap> map,
                           std::size_t most_photons)
    : rays_(rays),
      surface_(rays),
      map_(std::move(map)),
      most_photons_(most_photons),
      most_m_(std::max(kMostReach * rays.scene().bounds.diagonal_m(), 1e-30f)) {}

LocalDensity CausticLight::density(float radius_m, const ShareOfDisc& share, Worker& worker) const {
  worker.distance2_m2.clear(), worker.flux_lm.clear();
  for (const CausticHit& hit : worker.hits)
    worker.distance2_m2.push_back(hit.distance2_m2), worker.flux_lm.push_back(hit.flux_lm);
  return local_density(worker.distance2_m2, worker.flux_lm, radius_m, map_->one_photon_lm(), share);
}

LocalDensity CausticLight::on_surface(const Vec3& p, const Vec3& n, std::size_t most_photons, Worker& worker,
                                      float enough_lx) const {
  if (map_->photons().size() == 0) return {};
  ZonePlace place{p, make_frame(n), receiver(rays_.scene(), p, n).error_m};
  LocalDensity estimate;
  float radius_m = most_m_;
  std::size_t k = std::min(kFirstPhotons, most_photons);
  for (;; k = std::min(k * kMorePhotons, most_photons)) {
    radius_m = most_m_;
    const float slab = slab_m(place, radius_m);
    map_->landed(p, n, k, slab, slab, radius_m, worker.map, worker.hits);
    estimate = density(radius_m, {}, worker);
    const float unsure_lx = luminance(estimate.stderr_lx());
    if (kLeastShare * enough_lx > luminance(estimate.irradiance) + 2 * unsure_lx) return estimate;
    if (estimate.settled || k == most_photons || !(radius_m < most_m_) || unsure_lx < enough_lx) break;
  }
  if (!(radius_m > 0)) return {};
  if (worker.hits.empty()) return estimate;
  surface_.limit_slab(place, radius_m);
  std::erase_if(worker.hits, [&](const CausticHit& hit) {
    const float height = glm::dot(hit.position - p, n);
    return height > place.above_m || height < -place.below_m;
  });
  bool whole = true;
  for (int i = 0; i < kRim && whole; ++i)
    whole = surface_.on_surface(place, on_circle(i, kRim, kRimAt * radius_m));
  for (int i = 0; i < kInner && whole; ++i)
    whole = surface_.on_surface(place, on_circle(i, kInner, kInnerAt * radius_m));
  if (whole) return density(radius_m, {}, worker);

  std::array<std::uint16_t, kProbes + 1> found{};  // of the first probes
  for (int i = 0; i < kProbes; ++i)
    found[static_cast<std::size_t>(i) + 1] = static_cast<std::uint16_t>(
        found[static_cast<std::size_t>(i)] + surface_.on_surface(place, probe_offset(i, kProbes, radius_m)));
  if (place.parted)
    std::erase_if(worker.hits, [&](const CausticHit& hit) {
      const Vec3 local = place.frame.to_local(hit.position - p);
      return !surface_.within_sight(place, Vec2(local), local.z);
    });
  const auto share = [&](double r) {
    const double part = r / static_cast<double>(radius_m);
    const int probes = std::clamp(static_cast<int>(std::lround(kProbes * part * part)), 1, kProbes);
    const int on = found[static_cast<std::size_t>(probes)];
    if (on == probes) return DiscShare();
    // Only the number of probes along the border is uncertain; the photons that are there tell that some of
    // it is surface.
    const double measured = std::max(on, 1) / static_cast<double>(probes);
    return DiscShare{measured, 0.5 * std::pow(probes, -0.75) / measured};
  };
  return density(radius_m, share, worker);
}

DiscShare CausticLight::seen_share(std::span<const float> reach_m, double radius_m) const {
  double sum = 0;
  bool cut = false;
  for (const float reach : reach_m) {
    const double part = std::min(1.0, static_cast<double>(reach) / radius_m);
    cut = cut || part < 1;
    sum += part * part;
  }
  if (!cut) return {};
  const double share = std::max(sum, 1e-6) / static_cast<double>(reach_m.size());
  return {share, 0.5 / static_cast<double>(reach_m.size()) / share};
}

LocalDensity CausticLight::in_space(const Vec3& p, const Vec3& n, Worker& worker) const {
  const SurfacePoint at = receiver(rays_.scene(), p, n);
  // Off the surface that the sensor may lie on.
  const Vec3 middle = p + 2 * at.error_m * n;
  const auto free = [&](const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const float length = glm::length(way), clear = length - 4 * at.error_m;
    return !(clear > 0) || !rays_.occluded({from, way / length, 0, clear});
  };
  float radius_m = most_m_;
  map_->crossing(middle, n, most_photons_, radius_m, worker.hits);
  if (!(radius_m > 0)) return {};
  std::erase_if(worker.hits, [&](const CausticHit& hit) {
    return hit.photon != CausticHit::kFlight && !free(hit.position, map_->photons().position[hit.photon]);
  });
  if (worker.hits.empty()) return density(radius_m, {}, worker);
  const Frame frame = make_frame(n);
  std::array<float, kDirections> reach_m;
  bool clear = true;
  for (int i = 0; i < kDirections; ++i) {
    Hit hit;
    const Ray ray{middle, frame.to_world(Vec3(on_circle(i, kDirections, 1), 0)), 0, radius_m};
    const bool met = rays_.intersect(ray, hit);
    reach_m[static_cast<std::size_t>(i)] = met ? hit.distance_m : kInfinity;
    clear = clear && !met;
  }
  if (clear) return density(radius_m, {}, worker);
  std::erase_if(worker.hits, [&](const CausticHit& hit) { return !free(middle, hit.position); });
  return density(
      radius_m, [&](double r) { return seen_share(reach_m, r); }, worker);
}

LocalDensity CausticLight::at_sensor(const Vec3& p, const Vec3& n, Worker& worker) const {
  const SurfacePoint at = receiver(rays_.scene(), p, n);
  const Ray down{p + 4 * at.error_m * n, -n, 0, 16 * at.error_m};
  SurfacePoint point;
  if (trace(rays_, down, point) && glm::dot(point.smooth_normal, n) > kSameFacing) {
    if (Bsdf(rays_.scene(), point).takes_light()) return on_surface(p, n, worker);
  }
  return in_space(p, n, worker);
}

Rgb CausticLight::gloss(const LocalDensity& estimate, const Bsdf& bsdf, const Vec3& wo,
                        const Worker& worker) {
  Rgb sum(0);
  if (!(estimate.area_m2 > 0)) return sum;
  const float reach2 = estimate.radius_m * estimate.radius_m;
  for (const CausticHit& hit : worker.hits) {
    if (!(hit.distance2_m2 < reach2)) break;
    sum += hit.flux_lm * bsdf.evaluate_gloss(wo, hit.direction);
  }
  return sum / static_cast<float>(estimate.area_m2);
}

}  // namespace phos::inline estimate
