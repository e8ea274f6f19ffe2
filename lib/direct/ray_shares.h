// How many shadow rays each lamp gets for a stated error of their sum.
#pragma once

#include <span>
#include <vector>

namespace phos::inline direct {

/// What a pilot found of one lamp.
struct PilotNoise {
  double variance_lx2 = 0;  ///< variance of the light that its rays brought together
  int rays = 1;             ///< of the pilot
  int least = 1;            ///< rays that it is to have in any case
  bool sets = false;        ///< its points are Sobol's: numbers are rounded up to sets of them
};

/// The variance of n low-discrepancy samples of a lamp falls as n to this power, or faster: measured 1.27 of
/// windows in a room from 64 to 512 rays; 1.5 for edges, 2 for smooth light, 1 for independent samples.
inline constexpr double kNoiseFall = 1.25;

/// The least set of Sobol' points whose stated variance is the one that n would leave by kNoiseFall, n itself
/// being compared with sets of 4^k: these state the least for their size, and sets of 1.5, 2 and 3 x 4^k
/// little less than in proportion to their number.
int sobol_set(double n);

/// Rays of each lamp: the fewest in all whose variances add up to stderr_lx^2, and at most `most` to a lamp.
/// The variance of a lamp is a / n^q, so n grows as a^(1/(1 + q)). Each number is rounded up to 2^k or 3 x
/// 2^k: low-discrepancy sequences of such lengths are even. A lamp without noise has `least`; all have `most`
/// where stderr_lx is 0.
std::vector<int> share_rays(std::span<const PilotNoise> lamps, double stderr_lx, int most);

}  // namespace phos::inline direct
