// Radiance records straight from photons.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "estimate/density.h"
#include "estimate/radiance_record.h"
#include "estimate/zone/gradients.h"

namespace phos::inline estimate {

/// Turns the photons of one zone into coefficients; holds memory, for one thread.
class PhotonProjector {
 public:
  /// Throws Error(usage) unless 1 <= order <= HshRotator::kMaxOrder.
  explicit PhotonProjector(int order);
  ~PhotonProjector();

  /// Light, gradients and errors of a record from the photons with used[i] != 0, that landed on `area_m2`
  /// (relative standard error `area_error`); for a place `step_m` away from the middle of that area on the
  /// tangent plane, along the gradient (shortened where that would change the light by its own norm).
  ///
  /// The photons are moments of the light, sum of flux / area H_i(w), and CosineFit makes coefficients of
  /// them: the light that leaves through a lobe f is then sum of flux / area f'(w), f' the fit of f by as
  /// many bands. The irradiance is sum of flux / area. More bands add no noise to light that leaves through a
  /// lobe, which sees as many photons as before; so bands are neither cut off nor damped where their energy
  /// is below their noise. (Measured for 50 to 1,000 photons: that would take up to 40 % of the noise of even
  /// light, and double or quadruple the error of light from one wall or a ceiling. tests/bench measures the
  /// fit.)
  ///
  /// In the gradients each photon's source stays where it is and keeps its luminance (`hybrid` is as
  /// analytic: photons do not show occluders); its cosine is kept above 0.1.
  ///
  /// Errors are those of Poisson photons and of the area. Errors of coefficients from photons are not
  /// independent of each other; stated is the one white noise, of variance 3 / (2 pi) sum of (flux / area)^2
  /// in each coefficient, that through the lobe of irradiance makes exactly the error of irradiance, and
  /// through glossy lobes about theirs. (Marginal errors of coefficients are larger: they are mostly light
  /// along the horizon, of which photons know least and lobes show least.)
  RadianceRecord project(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                         double area_error, const Vec2& step_m, const Frame& frame, RadianceGradient mode);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Radiance records of the zones of influence, photons and areas of hull irradiance records
/// (DensityEstimator): photon density estimation (docs/methods.md#c1) extended to radiance (#j3). Const,
/// usable from any thread, each with a worker of its own; holds references.
class RadianceDensityEstimator : public Estimator {
 public:
  /// `resolved` as for DensityEstimator; the estimate is always hull, and light that comes straight from
  /// lamps is never in it. Throws Error(usage) for an order outside 1 .. HshRotator::kMaxOrder.
  RadianceDensityEstimator(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
                           int order, RadianceGradient gradient, std::uint64_t seed);
  ~RadianceDensityEstimator() override;
  std::unique_ptr<Worker> make_worker() const override;

  /// The record at a site, without the site's own photon, is Made::radiance. Distance and radius come from
  /// the irradiance record, the radius also within_gradient_m, but for as near as zones overlap. Counted as
  /// irradiance records are. Throws Error(numerical) where a value exceeds the range of numbers.
  Made make(const RecordSite& site, Worker& worker) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline estimate
