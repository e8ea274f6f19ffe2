// Radiance records: the light that arrives from each direction, as hemispherical harmonics; their file, and
// interpolation between them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "file/container.h"
#include "radiance/brdf/table.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"

namespace phos::inline radiance {

/// One record. Radiance L(w) that arrives along w is the sum of c_i H_i(w), HSH of hsh/basis.h, w in the
/// record's frame; light that comes straight from a lamp is not in it. Numbers of RGB stand side by side.
struct RadianceRecord {
  Vec3 position{0};              ///< m
  Frame frame;                   ///< z: unit normal on the side it lights; y = z x x
  float distance_m = kInfinity;  ///< mean distance to the surrounding surfaces, unclamped
  float radius_m = 0;            ///< R of the weight; the zone of influence is accuracy * radius
  float weight = 1;              ///< as IrradianceRecord::weight
  std::vector<float> light;      ///< [order^2][3] c_i = integral of L H_i dw, cd/m2 sqrt(sr)
  /// [order^2][3] their change per metre along frame.x and frame.y; empty: not known, taken as 0.
  std::vector<float> gradient_x, gradient_y;
  /// [order][3] standard error of one coefficient of each band (root mean square over the band, which turns
  /// about the normal do not change). Errors of different coefficients are about independent.
  std::vector<float> stderr_light;
  float shared = kSharedByZones;  ///< as IrradianceRecord::shared

  int order() const { return static_cast<int>(stderr_light.size() / 3); }
};

/// The order itself; throws Error(usage) unless 1 <= order <= HshRotator::kMaxOrder.
int require_radiance_order(int order);

/// Change of a record's coefficients per metre relative to their own size, 1/m: steps by more than 1/this are
/// shortened to that (step_share). 0: it takes no steps, having no gradients, or no light of its own.
float steepness_per_m(const RadianceRecord& record);

/// Are all its numbers finite? The distance may be infinite.
bool is_finite(const RadianceRecord& record);

/// Irradiance of light [order^2][3], lx: exactly the first two zonal coefficients, E = sqrt(pi/2) c_00 +
/// sqrt(pi/6) c_10 (docs/methods.md#j1). May be below 0 by ringing.
Rgb irradiance_of(std::span<const float> light);

/// What a radiance record says of irradiance, its gradient of translation from theirs, none of rotation.
/// Place, radius and distance are the record's own: what settles radii of irradiance records settles these
/// too.
IrradianceRecord irradiance_of(const RadianceRecord& record);

struct RadianceCache {
  std::vector<RadianceRecord> records;  ///< of any orders; all with gradients or all without
  double accuracy = 0.2;                ///< a that placed them
  std::string scene_hash;
  std::shared_ptr<const CausticPhotons> caustics{};  ///< as IrradianceCache::caustics
  int order() const;                                 ///< the greatest; 0: there are no records
};

/// All of it, in order.
IrradianceCache irradiance_of(const RadianceCache& cache);

/// reading_accuracy() of radiance records: what leaves through a lobe gathers the noise of many coefficients.
inline double reading_accuracy(const RadianceCache& cache) {
  return phos::reading_accuracy(cache.accuracy, 0.6);
}

/// For reading a record at `accuracy`: of band l, slopes keep exp(-t^2 / 2), t = l sqrt(0.3) accuracy x
/// max(1, R / D). A record's radius R is where its light is about another one (at most the mean distance D,
/// but where it has been raised): on a step s, what it sees turns by about s / R, and harmonics of band l by
/// l times that. They change like a sine, of which this is the best linear part where steps are spread
/// normally; sqrt(0.3) of its reach is the rms step of those that a record serves (its weight counted). Full
/// slopes overshoot in the higher bands, and bring in more noise than change.
void settle_slopes(RadianceRecord& record, double accuracy);

/// The `.radiance` file, n records, the greatest order N: position f32[n,3] m, frame f32[n,2,3] (x axis,
/// normal), coefficients f32[n,3,N^2], gradient_x and gradient_y likewise per metre (absent where there are
/// none), stderr f32[n,3,N] by band, shared f32[n] (unless kSharedByZones for all), distance and radius
/// f32[n] m. Where orders differ, order u8[n] holds them, and numbers beyond a record's own are 0. Its header
/// names the basis. Of a film there are `more` columns.
void write_radiance(const std::string& path, const RadianceCache& cache, Provenance provenance,
                    ContainerWriter more = {});
/// Throws Error(bad_input) for a damaged file (checksums verified, the first bad record named), one of
/// another kind, or unless its records are of what is wanted.
RadianceCache read_radiance(const Container& file, RecordsOf of = RecordsOf::cache);

/// Light that leaves a point by its glossy lobe.
struct GlossyLight {
  Rgb radiance{0};   ///< cd/m2; what harmonics ring below the least is cut off
  Rgb stderr_cd{0};  ///< cd/m2, of the mean of records (blended_error)
  float weight = 0;  ///< sum of weights; 0: a miss
};

/// Lookup structure over radiance records, with the weights and the acceptance of RecordTree. Point queries
/// in any order and from any thread; records are added serially.
class RadianceTree {
 public:
  /// Of records of one order; throws Error(usage) unless 1 <= order <= HshRotator::kMaxOrder. With
  /// `leak_test`, a record is valid only where no surface stands between it and the point (the tree holds a
  /// reference).
  RadianceTree(const Bounds& bounds, double accuracy, int order, const RayScene* leak_test = nullptr);
  ~RadianceTree();
  RadianceTree(RadianceTree&&) noexcept;
  int order() const;
  std::size_t size() const;
  const RadianceRecord& operator[](std::size_t record) const;
  void insert(RadianceRecord record);
  /// Their irradiance, radii and what they cover.
  const RecordTree& irradiance() const;

  /// Memory of one thread, and what the last lookup found.
  struct Worker {
    std::vector<const IrradianceRecord*> found;
    std::vector<float> sum, turned;
    std::vector<float> light;  ///< interpolate(): [order^2][3] of the order and in the frame asked for
    std::vector<float>
        stderr_light;  ///< [order][3], as far as it does not average out (disagreement left out)
  };
  /// Sets worker.light to the light that arrives at p in `frame` (z its normal, unit), to `order` bands (at
  /// most those of the records; bands above are cut off before records are turned, which is exact between
  /// equal normals and costs about 1% of the light that leaves where they differ by 20 degrees): the sum of w
  /// R (c + dx g_x + dy g_y) / sum of w, where a step towards p that would change a record by more than its
  /// own energy is shortened to that. Returns the sum of weights; 0: no record is valid, all is 0.
  float interpolate(const Vec3& p, const Frame& frame, int order, Worker& worker) const;
  /// Light that leaves p through a lobe, [order^2][3] in `frame`: the lobe times what interpolate() finds.
  /// The least is `least` (1/sr, 0 or below) times the irradiance. Where records are turned it is the lobe
  /// that is turned to each of them (transposed), at half the cost where it has no colour.
  GlossyLight outgoing(const Vec3& p, const Frame& frame, std::span<const float> lobe, const Rgb& least,
                       Worker& worker) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline radiance
