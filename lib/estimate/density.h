// One irradiance record from photons (Gautron 2006, chapter 6, as mended: docs/methods.md#c, #d).
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>

#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "estimate/zone/gradients.h"
#include "estimate/zone/path_squares.h"
#include "estimate/zone/photon_zone.h"
#include "estimate/zone/surroundings.h"
#include "photon/density.h"
#include "photon/photon_map.h"
#include "photon/photon_noise.h"
#include "scene/rays.h"

namespace phos::inline estimate {

/// Records from photons, by hull or kernel. radius_m is the distance after the gradient and edge limits, not
/// clamped.
///
/// Of the photon that a record sits on, a part counts. About a photon chosen at random, the others are as
/// dense as everywhere (Palm, Slivnyak): there it must be left out. But a record serves a region, which gets
/// one record however many photons fell into it. Of a Poisson number of them with mean mu, one at least, any
/// one has mu / (1 - exp(-mu)) - 1 others about it; with 1 - mu / (exp(mu) - 1) of itself they are mu. That
/// part, mu being the candidates that the record covers, is 0 for few candidates far apart and 1 for many.
///
/// The kernel is the classical estimate, for comparison: zone, gradients and limits of the radius are the
/// hull's, but its photons are divided by the whole disc. It looks for no border, no shadow edge, no wall
/// and no caustic: half of the light is lost at a border, and half of the light leaks over a shadow's edge.
class DensityEstimator : public Estimator {
 public:
  DensityEstimator(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
                   std::uint64_t seed);
  ~DensityEstimator() override;

  struct Scratch : Worker {
    NearPhotons near;
    GatheredPhotons gathered;
    bool others = false;  ///< are there photons in the zone but the record's own?
    DensityScratch density;
    Frame frame;              ///< of the last make()
    ZoneEstimate zone;        ///< of the last record; of its photons, density.used counted
    Vec2 moved_m{0};          ///< of the last record: how far its light was moved along its gradient
    std::vector<float> bend;  ///< of the last record: the part taken from each flux for curvature
    ZonePaths paths;          ///< of the last record: of its photons
  };
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Scratch>(); }
  Made make(const RecordSite& site, Worker& worker) const override;
  /// Of a zone without a photon nothing else is looked for.
  Rgb irradiance_lx(const RecordSite& site, Worker& worker) const override;

  /// Does this photon count?
  bool wanted(std::uint32_t row) const { return is_wanted(photons_, row, Counted(options_)); }
  const RecordOptions& options() const { return options_; }

 private:
  /// Where a record's photons are.
  struct Zone {
    ZonePlace place;
    float radius_m;
    LeftOut left_out;
    float distance_m;  ///< of the surroundings
  };
  /// Its photons are left in scratch.gathered, where later steps expect them.
  Zone zone_about(const RecordSite& at, Scratch& scratch) const;
  void gather(Zone& zone, Scratch& scratch) const;
  Made make_of(const RecordSite& at, Zone zone, Scratch& scratch) const;
  ZoneEstimate by_hull(Zone& zone, Scratch& scratch) const;
  ZoneEstimate by_kernel(const Zone& zone, Scratch& scratch) const;
  void count_own(const RecordSite& at, const ZonePlace& place, float zone_radius_m, float reach_m,
                 ZoneEstimate& zone, Scratch& scratch) const;
  double move_to_centre(const ZonePlace& place, const ZoneEstimate& zone, float zone_radius_m,
                        Scratch& scratch, IrradianceRecord& record) const;
  static double share_of_bend(double bend, double noise, const ZoneEstimate& zone, float zone_radius_m,
                              const Scratch& scratch);
  ComparedGradients compared(const ZonePlace& place, const ZoneEstimate& zone, float zone_radius_m,
                             const Scratch& scratch) const;
  void fill(const ZonePlace& place, const ZoneEstimate& zone, float zone_radius_m, Scratch& scratch,
            IrradianceRecord& record) const;

  const PhotonMap& photons_;
  const RayScene& rays_;
  RecordOptions options_;
  ZoneGatherer gatherer_;
  Surroundings surroundings_;
  PhotonNoise noise_;
  Rgb one_photon_lm_{0};
};

}  // namespace phos::inline estimate
