// The coarse level of two-level caching: indirect light that gathered rays read where they land, and the
// gloss there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "photon/photon_noise.h"

namespace phos::inline scene {
class RayScene;
}
namespace phos::inline photon {
class PhotonMap;
struct CausticPhotons;
}  // namespace phos::inline photon
namespace phos::inline record {
class FarRecords;
class RecordTree;
struct IrradianceCache;
struct IrradianceRecord;
}  // namespace phos::inline record
namespace phos::inline radiance {
class GlossCache;
}
namespace phos::inline estimate {
class CausticLight;
class Estimator;
struct GatherSource;
struct RecordOptions;
}  // namespace phos::inline estimate

namespace phos::inline place {

/// How coarse records are made from photons, where finer ones are made as `fine` says.
RecordOptions coarse_options(const RecordOptions& fine);
/// Photons whose map would have the noise of some records. Of a record's variance, s^2 is what its photons
/// tell one by one, and t^2 what it has in common with all others, beyond what zones share that overlap
/// (kSharedByZones): that of paths (PhotonNoise).
struct EquivalentPhotons {
  /// Luminance of each, lm: sum of s^2 A / sum of E, A the area within a record's reach.
  double photon_lm = 0;
  double of_a_zone = 0;  ///< sum of E^2 / sum of s^2
  double common = 0;     ///< (sum of t A / sum of E A)^2, as GatherSource::common
};
/// Zero of records that are exact. Records of far noisier photons than usual do not count: with portals, they
/// lie out of doors.
EquivalentPhotons equivalent_photons(std::span<const IrradianceRecord> records, double accuracy);
/// Luminance of the mean irradiance over the places that records cover, each by its area; 0 of none.
double mean_irradiance_lx(std::span<const IrradianceRecord> records);
/// Photons tried as places for them: a coarse cache needs far fewer records than that.
inline constexpr std::int64_t kCoarseCandidates = 400'000;

/// Holds the data to which a GatherSource refers. Rays average over many places, so that few, far-reaching
/// records of many photons each serve them (Christensen 1999 precomputes irradiance at photons to the same
/// end); where there is none, the photons there are asked. Holds references to `rays` and `photons`.
class CoarseLevel {
 public:
  /// From photons: records by hull at options.source_accuracy, placed at photons; none with
  /// GatherFrom::photons, whose every ray asks the photons. View-independent: it depends on scene, photons,
  /// options and seed alone.
  CoarseLevel(const RayScene& rays, const PhotonMap& photons, const RecordOptions& resolved,
              std::uint64_t seed);
  /// From an earlier cache; `photons` may be null: then there is no light where it has no record.
  CoarseLevel(const RayScene& rays, const IrradianceCache& earlier, const PhotonMap* photons,
              const RecordOptions& resolved, std::uint64_t seed);
  /// Nothing: rays show surfaces that lamps light directly.
  CoarseLevel();
  ~CoarseLevel();
  CoarseLevel(CoarseLevel&&) noexcept;

  /// Of this scene: read where rays land on gloss; with the caustic photons of its records, if they hold no
  /// such light.
  void add(GlossCache gloss, const RayScene& rays, const std::shared_ptr<const CausticPhotons>& caustics);
  GatherSource source() const;
  std::size_t records() const;

 private:
  void read(const RayScene& rays, const IrradianceCache& cache);
  std::unique_ptr<RecordTree> tree_;
  std::unique_ptr<FarRecords> far_;
  std::unique_ptr<Estimator> photons_;
  std::unique_ptr<GlossCache> gloss_;
  std::unique_ptr<CausticLight> caustics_, gloss_caustics_;
  bool tell_common_ = false;
  bool holds_direct_ = false, lacks_images_ = false;
  PhotonNoise noise_;
  double zone_photons_ = 0, usual_lx_ = 0;
};

}  // namespace phos::inline place
