#include "place/typical_distance.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "direct/direct_light.h"
#include "photon/trace.h"
#include "place/modes.h"
#include "place/placement_options.h"
#include "place/view_candidates.h"
#include "scene/load.h"

namespace phos::inline place {
namespace {

constexpr std::size_t kPlaces = 1024, kFewPlaces = 32;
constexpr int kRays = 64;
constexpr std::int64_t kPixels = 32, kPaths = 4096;
/// Of the scene's diagonal, where no place tells: rooms that fill their scene are about so wide
/// (docs/methods.md#v1); and at most.
constexpr float kUsual = 0.25f, kMost = 0.5f;
constexpr float kOfNoSize_m = 0.25f;

float harmonic_distance_m(const RayScene& rays, const SurfaceSample& place, std::size_t item) {
  RandomStream random(0, Stage::placement, item);
  const SurfacePoint from = receiver(rays.scene(), place.position, place.normal);
  const Frame frame = make_frame(place.normal);
  const Vec2 shift = random.uniform2();
  double inverse = 0;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 direction = frame.to_world(sample_cosine_hemisphere(r2_point(i, shift)));
    Hit hit;
    if (rays.intersect({from.leave(direction), direction}, hit) && hit.distance_m > 0)
      inverse += 1 / static_cast<double>(hit.distance_m);
  }
  return inverse > 0 ? static_cast<float>(kRays / inverse) : kInfinity;
}

/// To three digits, because it is known no finer.
float rounded(float m) {
  const double unit = std::pow(10, std::floor(std::log10(static_cast<double>(m))) - 2);
  return static_cast<float>(unit * std::round(static_cast<double>(m) / unit));
}

/// Leaves about kPlaces of so many.
std::size_t step_over(std::size_t places) { return std::max<std::size_t>(1, places / kPlaces); }

std::vector<SurfaceSample> some_of(const PhotonMap& photons, std::span<const std::uint32_t> rows) {
  const std::size_t step = step_over(rows.size());
  std::vector<SurfaceSample> places;
  for (std::size_t i = step / 2; i < rows.size(); i += step)
    places.push_back({photons.position[rows[i]], decode_octahedral(photons.normal[rows[i]])});
  return places;
}

/// Of kPaths paths; none where nothing shines.
PhotonMap few_photons(const RayScene& rays) {
  PhotonTotals totals;
  Counters unread;
  PhotonOptions few;
  few.paths = kPaths, few.caustic_paths = 0;
  try {
    return PhotonMap::build(trace_photons(rays, few, 0, totals, unread), totals);
  } catch (const Error& e) {
    if (e.code() != ExitCode::bad_input) throw;  // that one: no light shines
    return PhotonMap::build({}, {});
  }
}

}  // namespace

float typical_distance_m(const RayScene& rays, std::span<const SurfaceSample> places) {
  const float diagonal_m = rays.scene().bounds.diagonal_m();
  const float usual_m = diagonal_m > 0 ? kUsual * diagonal_m : kOfNoSize_m;
  if (places.empty()) return rounded(usual_m);
  const std::size_t step = step_over(places.size());
  std::vector<float> distance((places.size() + step - 1) / step);
  parallel_for(distance.size(), 16,
               [&](std::size_t i) { distance[i] = harmonic_distance_m(rays, places[step * i], i); });
  const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() / 2);
  std::nth_element(distance.begin(), middle, distance.end());
  return rounded(*middle < kInfinity ? std::min(*middle, kMost / kUsual * usual_m) : usual_m);
}

std::vector<SurfaceSample> seen_places(const RayScene& rays, const std::string& camera) {
  const Candidates pixels = view_candidates(rays, {find_camera(rays.scene(), camera), kPixels, kPixels});
  std::vector<SurfaceSample> places;
  std::vector<RecordSite> sites;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kPixels * kPixels); ++i) {
    sites.clear();
    pixels.sites(i, sites);
    for (const RecordSite& site : sites) places.push_back({site.position, site.normal});
  }
  return places;
}

std::vector<SurfaceSample> lit_places(const PhotonMap& photons) {
  std::vector<std::uint32_t> scattered, all;
  for (std::uint32_t i = 0; i < photons.size(); ++i) {
    all.push_back(i);
    if (static_cast<PhotonPath>(photons.path[i]) == PhotonPath::indirect) scattered.push_back(i);
  }
  return some_of(photons, scattered.size() < kFewPlaces ? all : scattered);
}

TypicalDistance typical_distance(const RayScene& rays, const PlacementOptions& placement,
                                 const PlacementSource& source) {
  if (placement.place == Place::view) return typical_distance_m(rays, seen_places(rays, placement.camera));
  const float here_m = [&] {
    if (source.photons && source.photons->size() > 0)
      return typical_distance_m(rays, lit_places(*source.photons));
    if (source.points_given) return typical_distance_m(rays, source.points);
    return typical_distance_m(rays, lit_places(few_photons(rays)));
  }();
  if (rays.scene().camera.empty()) return here_m;
  const float seen_m = typical_distance_m(rays, seen_places(rays, ""));
  return {std::min(here_m, seen_m), std::max(here_m, seen_m)};
}

}  // namespace phos::inline place
