// One irradiance record from photons (thesis chapter 6, with the corrections of FORMULAS-irradiance C and D).
#pragma once

#include <cstdint>
#include <memory>

#include "cache/estimator.h"
#include "cache/gradients.h"
#include "cache/record_options.h"
#include "photon/density.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos {

/// Does this photon count (direct light is computed apart)?
inline bool is_wanted(const PhotonMap& photons, std::uint32_t row, Quantity paths) {
  return paths == Quantity::all || photons.path[row] != static_cast<std::uint8_t>(PhotonPath::direct);
}

/// Records from photons, by hull or kernel. Its make() leaves a record's photon out (Palm). radius_m is the
/// distance after the gradient and edge limits, not clamped.
class RecordMaker : public Estimator {
 public:
  RecordMaker(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
              std::uint64_t seed);
  ~RecordMaker() override;

  struct Scratch : Worker {
    std::vector<std::uint32_t> rows;
    std::vector<float> distance2;
    std::vector<Vec3> directions;
    std::vector<float> weights, distances, radii;
    ZonePhotons zone;
    std::vector<float> height_m;
    DensityScratch density;
  };
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Scratch>(); }
  Made make(const RecordSite& site, Worker& worker) const override;

  /// Does this photon count?
  bool wanted(std::uint32_t row) const { return is_wanted(photons_, row, options_.paths); }
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
