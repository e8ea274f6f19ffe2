// What all photons of a map have to do with each other: how far their number alone tells their noise.
#pragma once

#include <algorithm>

#include "photon/photon_map.h"

namespace phos::inline photon {

struct PhotonNoise {
  double photons = 0;  ///< that count
  /// Luminance that a usual one of them carries, weighted by itself: sum of squares / sum, lm. The few that
  /// carry far more than the median are left out: with portals, they are of places out of doors.
  double photon_lm = 0;
  /// Photons of one path are not independent: sum over paths of N (N - 1), over the square of all photons.
  /// Of a map with families each photon counts by the luminance that it carries, and those that are not usual
  /// do not count: (sum over paths of (sum of lm)^2 - sum of lm^2) / (sum of lm)^2.
  double pairs = 0;
  /// Relative variance that all light over many places has in common: the variance of the number of photons
  /// that paths leave, for their own number is no chance. 1 / paths below pairs, and below 0 where each path
  /// leaves as many.
  double common = 0;

  /// Factor on the variance of the light of a zone of n photons of a map without families, where paths land
  /// anywhere (a room, an atrium): pairs of one path add pairs x n, and that as many paths leave the lamps
  /// each time takes away n / paths. At least 1.
  double spread(double n) const { return 1 + std::max(common, 0.0) * n; }
};

/// Of all photons, or of those that did not come straight from a lamp. Without families in one pass over the
/// map: the photons that a path left before one are known from its number of bounces, if no surface on the
/// way was purely specular (else they are fewer, and `pairs` errs on the high side). Beyond 254 bounces, of
/// which maps tell no more, paths are taken to end as often as there.
PhotonNoise photon_noise(const PhotonMap& photons, bool with_direct);

}  // namespace phos::inline photon
