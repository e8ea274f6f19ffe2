// The standard error of several records at one place.
#pragma once

#include <algorithm>

#include "core/vector.h"

namespace phos::inline record {

/// Of the variance of a record from photons: the part that the others about a place have too, for their zones
/// overlap, and light that is not even in them is mistaken by all alike. (Of two discs whose middles are a
/// radius apart 39 % are common, at 1.5 radii 14 %; records are read up to about 2 radii from where they
/// are.) Measured, with kCommonOfPhotons, so that two stated errors hold 90 to 98 % in scenes of known light.
inline constexpr float kSharedByZones = 0.30f;
/// Noise of a record's value where it is carried to by its gradient, which has noise of its own, over that at
/// the record.
inline constexpr double kCarriedNoise = 1.5;
/// The part of the records' variance beyond noise that is an error of their mean, for records that know their
/// own light exactly, and for records from photons, whose gradients have noise too that averages out.
inline constexpr double kCommonDisagreement = 0.28, kCommonOfPhotons = 0.11;

/// The part of a record's variance that all records have in common, by its shared part: of s^2 (1 + x), paths
/// of photons (PhotonNoise) make x s^2, and zones that overlap share kSharedByZones s^2 besides.
inline double common_part(float shared) {
  return std::max(0.0, 1 - static_cast<double>(1 - shared) / static_cast<double>(1 - kSharedByZones));
}

/// Sums over the records valid at a place, of weight w, besides the sums of w and of w E.
struct BlendSums {
  float weight2 = 0;  ///< of w^2
  float shared = 0;   ///< of w x the part of a record's variance that others have too
  double value2 = 0;  ///< of w (luminance of E)^2, in any unit

  void add(float w, float part_shared, double value) {
    weight2 += w * w, shared += w * part_shared, value2 += static_cast<double>(w) * value * value;
  }
  void add(const BlendSums& o) { weight2 += o.weight2, shared += o.shared, value2 += o.value2; }
};

/// Standard error of the mean E of records, sum of w E / W. `mean` is its luminance in the unit of
/// sums.value2; `value` and `error` are the means of E and of the records' own errors s.
///
/// Of s^2, the part that records share stays, and the rest averages out: s^2 (rho + (1 - rho) q), with
/// q = sum of w^2 / W^2 (1 over the number of records, if all weigh alike; Kish 1965). Where records disagree
/// by more than noise - the weighted variance of E exceeds kCarriedNoise (1 - rho) s^2 (1 - q) - they are
/// carried on too far, or light is not as even as their zones are large. Such errors have partly a sign in
/// common: of the excess kCommonDisagreement to kCommonOfPhotons is added, as measured in scenes of known
/// light. A record alone has nobody to disagree with.
inline Rgb blended_error(const BlendSums& sums, float weight, const Rgb& value, const Rgb& error,
                         double mean) {
  if (!(weight > 0)) return Rgb(0);
  const double w = static_cast<double>(weight), all = w * w;
  const double q = std::min(1.0, static_cast<double>(sums.weight2) / all);
  const double rho = std::min(1.0, static_cast<double>(sums.shared) / w);
  const DVec3 s(error), e(value);
  DVec3 variance = s * s * (rho + (1 - rho) * q);
  const double light = static_cast<double>(luminance(value));
  if (mean > 0 && light > 0) {
    const double relative = static_cast<double>(luminance(error)) / light;
    const double scatter = sums.value2 / w / (mean * mean) - 1;
    const double noise = kCarriedNoise * (1 - rho) * relative * relative * (1 - q);
    const double by_photons = std::min(1.0, rho / static_cast<double>(kSharedByZones));
    const double common = kCommonDisagreement + by_photons * (kCommonOfPhotons - kCommonDisagreement);
    variance += common * std::max(0.0, scatter - noise) * e * e;
  }
  return Rgb(glm::sqrt(variance));
}

}  // namespace phos::inline record
