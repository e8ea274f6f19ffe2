// Places where records may be wanted, in the order in which they are tried.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "estimate/zone/photon_zone.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos::inline scene {
class CameraRays;
}

namespace phos::inline place {

struct SurfaceSample {
  Vec3 position{0}, normal{0, 0, 1};
};

/// Does a material want records?
using MaterialFilter = std::function<bool(std::uint32_t material)>;

/// Places numbered from 0, each of which holds any number of sites: one where a photon landed, several where
/// a pixel sees a mirror.
struct Candidates {
  std::size_t count = 0;
  /// Appends the sites of place i < count. Any thread may call it; the same sites each time.
  std::function<void(std::size_t i, std::vector<RecordSite>& sites)> sites;
  /// Of 4^k places whose first is a multiple of 4^k, one after the other in the order of grid_order(0, k),
  /// grid_order(1, k), ... lies near the one before.
  bool coarse_to_fine = false;
};
/// Number j of 4^k places that are tried coarse to fine, as one walks over them: its pairs of bits, reversed.
std::size_t grid_order(std::size_t j, int k);

// Random streams of records, by what they were placed for.
inline constexpr std::uint64_t kPointItems = std::uint64_t{1} << 40;    ///< + number of the point
inline constexpr std::uint64_t kViewItems = std::uint64_t{1} << 41;     ///< + number of the site
inline constexpr std::uint64_t kSurfaceItems = std::uint64_t{1} << 42;  ///< + number of the site

/// Where photons of the counted paths landed (caustic ones too), in an order that depends on the seed alone;
/// `most` of them (0: all).
Candidates photon_candidates(const PhotonMap& photons, const Counted& counted, std::uint64_t seed,
                             std::int64_t most);

/// Points in the order given. Holds a reference to them.
Candidates point_candidates(std::span<const SurfaceSample> points);

/// Those of them whose sites lie on a material that is wanted (material_at).
Candidates on_materials(const RayScene& rays, MaterialFilter wanted, Candidates all);
/// Material of the surface at p that faces n (unit): the nearest one within some roundings of positions to
/// either side. Nothing: there is none.
std::optional<std::uint32_t> material_at(const RayScene& rays, const Vec3& p, const Vec3& n);

/// A picture whose visible points need records.
struct View {
  Camera camera;
  std::int64_t width = 0, height = 0;  ///< pixels, both positive
  /// Bounds of a record's radius in sides of a pixel's footprint on the surface (docs/methods.md#a7,
  /// "screen"); 0: no bound.
  double least_radius_pixels = 0, most_radius_pixels = 0;
};
inline constexpr int kViewSamples = 4;  ///< of a pixel: those of phos-splat by default

/// What each pixel shows: its visible point and all that mirrors, smooth glass and a few glossy rays show
/// from there, where they have a diffuse part (or are `wanted`, if that is given). Coarse to fine over the
/// whole picture, for each sample of a pixel in turn. Holds a reference to rays.
Candidates view_candidates(const RayScene& rays, const View& view, const MaterialFilter& wanted = {});

/// Side of the patch of surface that one pixel covers: the root of its area, m. `st` is the middle of the
/// pixel in [0,1]^2, `travelled_m` the length of the ray's way (mirrors: all of it), `cosine` that between
/// ray and surface normal. A grazing pixel's patch counts as one seen at a cosine of 0.05.
float pixel_side_m(const View& view, const Vec2& st, float travelled_m, float cosine);
/// The same for many pixels: `eye` sees the view.
float pixel_side_m(const View& view, const CameraRays& eye, const Vec2& st, float travelled_m, float cosine);

}  // namespace phos::inline place
