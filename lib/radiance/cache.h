// Radiance records: the light that arrives from each direction, as hemispherical harmonics; their file, and
// interpolation between them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "file/container.h"
#include "radiance/store.h"
#include "record/irradiance_cache.h"

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
  /// Lengths of the axes of an AdaptiveFootprint, the first along frame.x; radius_m belongs to the longest.
  /// None: it serves a disc.
  std::optional<AdaptiveFootprint::Lengths> footprint_m{};

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

/// The irradiance record of a radiance record: its translation gradient comes from the gradients of the
/// coefficients, and it has no rotation gradient. Place, radius, distance and footprint are the record's own,
/// so that rules for zones of irradiance records serve radiance records too. Light along the axes of a
/// footprint changes by that gradient.
IrradianceRecord irradiance_of(const RadianceRecord& record);

struct RadianceCache {
  std::vector<RadianceRecord> records;  ///< of any orders; all with gradients or all without
  double accuracy = 0.2;                ///< a that placed them
  std::string scene_hash;
  std::shared_ptr<const CausticPhotons> caustics{};  ///< as IrradianceCache::caustics
  int order() const;                                 ///< the greatest; 0: there are no records
};

/// All records, in order.
IrradianceCache irradiance_of(const RadianceCache& cache);

/// reading_accuracy() of radiance records that were placed with accuracy `placed`: light that leaves through
/// a lobe has the noise of many coefficients.
inline double radiance_reading_accuracy(double placed) { return phos::reading_accuracy(placed, 0.6); }
inline double reading_accuracy(const RadianceCache& cache) {
  return radiance_reading_accuracy(cache.accuracy);
}

/// For reading a record at `accuracy`: of band l, slopes keep exp(-t^2 / 2), t = l sqrt(0.3) accuracy x
/// max(1, R / D). A record's radius R is where its light is about another one (at most the mean distance D,
/// but where it has been raised): on a step s, the light that it sees turns by about s / R, and harmonics of
/// band l by l times that. They change like a sine, of which this is the best linear part where steps are
/// spread normally; sqrt(0.3) of its reach is the rms step of those that a record serves (its weight
/// counted). Full slopes overshoot in the higher bands, and bring in more noise than change. R / D counts as
/// 1 where a footprint has lengths of its own for near and far surroundings.
void settle_slopes(RadianceRecord& record, double accuracy);

/// The `.radiance` file (file/kinds/tables.cpp). The header names the basis. Of a film there are `more`
/// columns.
void write_radiance(const std::string& path, const RadianceCache& cache, Provenance provenance,
                    Store store = Store::floats, TensorWriter more = TensorWriter(FileKind::radiance));
/// Throws Error(bad_input) for a damaged file (checksums verified, the first bad record named), one of
/// another kind or form.
RadianceCache read_radiance(const Container& file, FileForm form = FileForm::whole);

}  // namespace phos::inline radiance
