// One irradiance record from photons (thesis chapter 6, with the corrections of FORMULAS-irradiance C and D).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "cache/gradients.h"
#include "cache/irradiance_cache.h"
#include "core/counters.h"
#include "photon/density.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos {

enum class Quantity { indirect, all };

struct RecordOptions {
  double accuracy = 0.2;                             ///< a: zone of influence = a x radius
  std::optional<double> min_radius_m, max_radius_m;  ///< empty: resolve() sets them from the scene's size
  Quantity paths = Quantity::indirect;
  GradientMode gradients = GradientMode::photon;
  std::int64_t hemisphere_rings = 8;
  std::int64_t near_photons = 128;                     ///< k of the first query
  std::int64_t min_photons = 100, max_photons = 1000;  ///< aimed at in a zone
  std::int64_t distance_rays = 32;                     ///< 0: distances from photons alone
  std::int64_t probes = 128;

  /// Fills in absent radii: diagonal/100 and diagonal/4 (1/100 m and 1/4 m for a scene of no size). Throws
  /// Error(usage) if the smaller exceeds the larger.
  void resolve(float diagonal_m);
};

/// What happened while records were made; counts per record made.
struct RecordEvents {
  enum Event { few, full, hull, dark, degenerate, shrunk, unlit, probed, at_edge, parted, count_ };
  std::array<std::uint64_t, count_> n{};
  void add_to(Counters& counters) const;
};

class RecordMaker {
 public:
  static constexpr std::uint32_t kNoPhoton = ~0u;

  RecordMaker(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
              std::uint64_t seed);
  ~RecordMaker();

  /// Memory of one worker.
  struct Scratch {
    std::vector<std::uint32_t> rows;
    std::vector<float> distance2;
    std::vector<Vec3> directions;
    std::vector<float> weights, distances, radii;
    ZonePhotons zone;
    std::vector<float> height_m;
    DensityScratch density;
    RecordEvents events;
  };

  /// The record at p with unit normal n; `item` numbers its random rays; `seed_row` is the photon that it
  /// sits on, which is left out (Palm), or kNoPhoton. radius_m is the distance after the gradient and edge
  /// limits, NOT clamped to [min, max] and not yet to its neighbours'. Always finite and positive.
  /// least_radius_m: neighbours need not clamp it further, since records nearer to each other than their
  /// photons reach would tell the same photons' tale.
  struct Made {
    IrradianceRecord record;
    float least_radius_m = 0;
  };
  Made make(const Vec3& p, const Vec3& n, std::uint64_t item, std::uint32_t seed_row, Scratch& scratch) const;

  /// Does this photon count (DESIGN "path": direct light is computed separately)?
  bool wanted(std::uint32_t row) const;
  const RecordOptions& options() const { return options_; }

 private:
  struct Site;
  float ray_distance_m(const Site& site, std::uint64_t item) const;
  float photon_distance_m(const Site& site, std::uint32_t seed_row, Scratch& scratch, float limit_m) const;
  float zone_radius_m(const Site& site, const Scratch& scratch, float distance_m) const;
  float above_next_surface_m(const Site& site, float radius_m) const;
  void limit_slab(Site& site, float radius_m) const;
  void gather(const Site& site, float radius_m, std::uint32_t seed_row, Scratch& scratch) const;
  bool within_sight(const Site& site, const Vec2& offset_m, float height_m) const;
  bool on_surface(Site& site, const Vec2& offset_m) const;
  void drop_hidden(const Site& site, Scratch& scratch) const;
  ZoneEstimate estimate(Site& site, float& radius_m, std::uint32_t seed_row, Scratch& scratch) const;
  void move_to_centre(const Site& site, const ZoneEstimate& zone, const Scratch& scratch,
                      IrradianceRecord& record) const;
  void fill(const Site& site, const ZoneEstimate& zone, float zone_radius_m, const Scratch& scratch,
            IrradianceRecord& record) const;

  const PhotonMap& photons_;
  const RayScene& rays_;
  RecordOptions options_;
  std::uint64_t seed_;
  Rgb one_photon_lm_{0};
};

}  // namespace phos
