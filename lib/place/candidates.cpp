#include "place/candidates.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "direct/direct_light.h"
#include "estimate/density.h"

namespace phos::inline place {
namespace {

/// Roundings of positions by which a place may lie beside its surface: its own rounding, and the rounding of
/// a CSV file.
constexpr float kBeside = 16;
constexpr int kMostSurfaces = 8;  // looked at about a place: others do not lie so near each other

}  // namespace

std::size_t grid_order(std::size_t j, int k) {
  std::size_t i = 0;
  for (int pair = 0; pair < k; ++pair, j >>= 2) i = i << 2 | (j & 3);
  return i;
}

Candidates photon_candidates(const PhotonMap& photons, const Counted& counted, std::uint64_t seed,
                             std::int64_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  for (std::uint32_t row = 0; row < photons.size(); ++row) {
    if (is_wanted(photons, row, Counted(counted.paths)))
      keyed.emplace_back(RandomStream(seed, Stage::placement, row).bits(), row);
  }
  std::sort(keyed.begin(), keyed.end());
  const auto all = static_cast<float>(std::max<std::size_t>(keyed.size(), 1));
  if (most > 0 && keyed.size() > static_cast<std::size_t>(most)) keyed.resize(static_cast<std::size_t>(most));
  const float tried = static_cast<float>(keyed.size()) / all;
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, row] : keyed) order.push_back(row);
  const std::size_t count = order.size();
  return {count, [&photons, counted, tried, order = std::move(order)](std::size_t i,
                                                                      std::vector<RecordSite>& sites) {
            const std::uint32_t row = order[i];
            const std::uint32_t own = is_wanted(photons, row, counted) ? row : kNoPhoton;
            sites.push_back({photons.position[row], decode_octahedral(photons.normal[row]), row, own, tried});
          }};
}

Candidates point_candidates(std::span<const SurfaceSample> points) {
  return {points.size(), [points](std::size_t i, std::vector<RecordSite>& sites) {
            sites.push_back({points[i].position, points[i].normal, kPointItems + i});
          }};
}

std::optional<std::uint32_t> material_at(const RayScene& rays, const Vec3& p, const Vec3& n) {
  const float beside_m = kBeside * receiver(rays.scene(), p, n).error_m;
  Ray ray{p + beside_m * n, -n, 0, 2 * beside_m};
  std::optional<std::uint32_t> nearest;
  float least_m = kInfinity;
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    if (!rays.intersect(ray, hit)) break;
    const float off_m = std::fabs(hit.distance_m - beside_m);
    if (off_m < least_m) least_m = off_m, nearest = rays.surface(ray, hit).material;
    ray.t_min_m = std::nextafter(hit.distance_m, kInfinity);
  }
  return nearest;
}

Candidates on_materials(const RayScene& rays, MaterialFilter wanted, Candidates all) {
  all.sites = [&rays, wanted = std::move(wanted), sites_of = std::move(all.sites)](
                  std::size_t i, std::vector<RecordSite>& sites) {
    const std::size_t before = sites.size();
    sites_of(i, sites);
    const auto unwanted = [&](const RecordSite& site) {
      const std::optional<std::uint32_t> material = material_at(rays, site.position, site.normal);
      return !material || !wanted(*material);
    };
    sites.erase(std::remove_if(sites.begin() + static_cast<std::ptrdiff_t>(before), sites.end(), unwanted),
                sites.end());
  };
  return all;
}

}  // namespace phos::inline place
