// Photons in memory and in files, and the neighbour search over them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/column.h"
#include "core/vector.h"
#include "file/container.h"

namespace phos::inline photon {

/// How a photon came to where it was stored.
enum class PhotonPath : std::uint8_t {
  direct = 0,    ///< straight from a light
  indirect = 1,  ///< last left a non-specular surface, or further back did so
  caustic = 2,   ///< light, then only specular surfaces
  mirrored = 3,  ///< the same over flat mirrors in which the light has images: shadow rays find it too
};

/// Caustic light: the caustic map takes these photons, and records leave them out where there is such a map.
/// The one place that decides it.
constexpr bool is_caustic(PhotonPath path) { return path == PhotonPath::caustic; }

/// Stretches of caustic light that end at no stored photon: at a mirror, at glass, or nowhere. With those
/// that end at one, a virtual disc anywhere outside of solid glass meets all caustic light that crosses it.
/// Stretches within solid glass are left out. Columns, one row a stretch.
struct Flights {
  std::vector<Vec3> from;                ///< m, where it begins: the surface before
  std::vector<Rgb> flux;                 ///< lm
  std::vector<std::uint32_t> direction;  ///< octahedral, along the flight
  std::vector<float> length;             ///< m; infinity: it leaves the scene
  std::size_t size() const { return from.size(); }
};

/// Columns, one row per stored photon. Directions and normals are octahedral (core/vector.h).
struct Photons {
  Column<Vec3> position;            ///< m
  Column<Rgb> flux;                 ///< lm
  Column<std::uint32_t> direction;  ///< towards where it came from
  Column<std::uint32_t> normal;     ///< smooth (SurfacePoint::smooth_normal), on the side it landed on
  Column<float> distance;  ///< m, to the previous surface or light; infinity from a directional light
  Column<std::uint32_t>
      source_normal;  ///< geometric, of that surface or area light, on the side it left; the photon's own
                      ///< flight direction where there is none (point, spot, directional)
  Column<std::uint8_t> path;    ///< PhotonPath
  Column<std::uint8_t> bounce;  ///< reflections and transmissions since the light (255: or more)
  /// Number of its path, the lowest 32 bits: photons of one path are not independent. Empty where paths do
  /// not part (PortalSplit): what they have in common follows from `bounce` there.
  Column<std::uint32_t> family;
  Flights flights{};  ///< in path order; none without mirrors and glass
  std::size_t size() const { return position.size(); }
};

/// Calls act(column...) with the same column of every argument, for each column that all photons have in
/// turn.
template <class Act, class... P>
void for_columns(const Act& act, P&... photons) {
  act(photons.position...), act(photons.flux...), act(photons.direction...), act(photons.normal...);
  act(photons.distance...), act(photons.source_normal...), act(photons.path...), act(photons.bounce...);
}

/// Read-only columns of flights, wherever they lie.
struct FlightColumns {
  std::span<const Vec3> from;
  std::span<const Rgb> flux;
  std::span<const std::uint32_t> direction;
  std::span<const float> length;
  std::size_t size() const { return from.size(); }
};

/// A sum of fluxes in units of 2^exponent lm, kept in integers: the same in any order, and over shards in any
/// number.
struct FluxSum {
  std::array<std::int64_t, 3> units{0, 0, 0};
  FluxSum& operator+=(const FluxSum& o) {
    for (std::size_t c = 0; c < 3; ++c) units[c] += o.units[c];
    return *this;
  }
  FluxSum& operator-=(const FluxSum& o) {
    for (std::size_t c = 0; c < 3; ++c) units[c] -= o.units[c];
    return *this;
  }
  /// Nearest whole number of units, of which there are `units_per_lm` = 2^-exponent. `flux` must be finite.
  static FluxSum of(const Rgb& flux_lm, double units_per_lm) {
    const auto units = [&](float v) {
      return std::int64_t{std::lrint(static_cast<double>(v) * units_per_lm)};
    };
    return {{units(flux_lm.x), units(flux_lm.y), units(flux_lm.z)}};
  }
  Rgb lm(int exponent) const;
};

/// Totals that travel with a map.
struct PhotonTotals {
  std::uint64_t emitted = 0;  ///< paths started (by all shards together)
  std::uint64_t stored = 0;
  std::uint64_t first_path = 0, paths = 0;  ///< the shard's range of path numbers; the whole is [0, emitted)
  /// stored counts a photon once at every surface it was stored on; emitted = escaped + absorbed exactly (in
  /// the sums).
  Rgb emitted_flux_lm{0}, stored_flux_lm{0}, escaped_flux_lm{0}, absorbed_flux_lm{0};
  int flux_exponent = 0;  ///< of the sums below, from which the four above follow (see settle)
  FluxSum emitted_sum, stored_sum, escaped_sum, absorbed_sum;
  /// Sets the four *_flux_lm from the sums.
  void settle();
};

/// Photons with their kd-tree (FLANN). Rows are in space_order(). Queries are const and thread-safe.
class PhotonMap {
 public:
  /// Reorders the photons and builds the tree; rows of equal input give equal bytes. Zero
  /// photons are allowed: every query is empty. Throws Error(numerical) for a non-finite position.
  static PhotonMap build(Photons photons, const PhotonTotals& totals);
  /// Opens a file; columns stay memory-mapped, the tree is loaded (not rebuilt) after its checksum and those
  /// of the positions were verified. A shard is an error that says to run phos-merge.
  static PhotonMap open(const std::string& path);
  ~PhotonMap();
  PhotonMap(PhotonMap&&) noexcept;
  PhotonMap& operator=(PhotonMap&&) noexcept;

  std::size_t size() const { return position.size(); }
  std::span<const Vec3> position;
  std::span<const Rgb> flux;
  std::span<const std::uint32_t> direction, normal, source_normal;
  std::span<const float> distance;
  std::span<const std::uint8_t> path, bounce;
  FlightColumns flights;
  PhotonTotals totals;
  std::span<const std::uint32_t> family;  ///< as Photons::family

  /// Does caustic light reach anything here?
  bool has_caustics() const;

  /// Rows within radius_m of p (any order that depends only on the map), replacing `rows`.
  void in_sphere(const Vec3& p, float radius_m, std::vector<std::uint32_t>& rows) const;
  /// The k nearest rows within most_m of p and their squared distances (m2), nearest first.
  void nearest(const Vec3& p, std::size_t k, std::vector<std::uint32_t>& rows,
               std::vector<float>& distance2_m2, float most_m = kInfinity) const;

  /// The file it came from, or nullptr if built here.
  const Container* container() const;
  /// Tree, columns and totals to a file.
  void write(const std::string& path, Provenance provenance) const;

 private:
  PhotonMap();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline photon
