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

// Random streams of records, by the kind of their candidates.
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

}  // namespace phos::inline place
