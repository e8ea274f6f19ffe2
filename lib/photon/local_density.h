// Irradiance from photons by their own local radius: where light is uneven beyond all measure, as in
// caustics.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/vector.h"

namespace phos::inline photon {

/// Share of the disc of this radius (m) about the place that is on the measured surface, in (0, 1], and its
/// relative standard error.
struct DiscShare {
  double share = 1, error = 0;
};
using ShareOfDisc = std::function<DiscShare(double radius_m)>;

struct LocalDensity {
  Rgb irradiance{0};  ///< lx
  /// Poisson noise of the photons counted; where there are none, the light of one photon.
  Rgb noise_lx{0};
  Rgb bias_lx{0};  ///< bound on how far the disc's mean is off its middle, as larger and smaller discs tell
  float radius_m = 0;
  double area_m2 = 0;       ///< that the flux was divided by
  std::size_t photons = 0;  ///< that were counted
  bool settled = false;     ///< a smaller disc was called for than the largest one

  /// Both together.
  Rgb stderr_lx() const { return glm::sqrt(noise_lx * noise_lx + bias_lx * bias_lx); }
};

/// Sum of flux over the area of a disc whose radius follows the light (docs/methods.md#g7-2). Among nested
/// discs, each of half the area of the one before, it is the second largest one at most, and the largest one
/// that agrees with all smaller ones within their noise (intersection of confidence intervals, Goldenshluger
/// and Nemirovski 1997, Katkovnik 1999): an edge, a fold or a focus that the disc meets makes it smaller.
/// Where light bends, E(r) - E(r / sqrt 2) is the bias of the smaller disc.
///
/// `distance2_m2` are the squared distances of all photons nearer than `radius_m`, nearest first, `flux_lm`
/// their fluxes per unit of area of the disc's plane; `one_photon_lm` is the flux of a photon where there is
/// none. The photon that decided on `radius_m` must not be among them. `share`: empty, where all is measured.
/// No photons: 0, with the noise of one photon in the largest disc. Always finite for finite input.
LocalDensity local_density(std::span<const float> distance2_m2, std::span<const Rgb> flux_lm, float radius_m,
                           const Rgb& one_photon_lm, const ShareOfDisc& share = {});

}  // namespace phos::inline photon
