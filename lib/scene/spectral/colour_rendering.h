// What the colour of a light is, and how it renders others.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/vector.h"
#include "scene/spectral/bands.h"

namespace phos::inline scene {

/// A light as its power in steps of wavelength: colour matching functions, test colours and reference lights
/// are taken in the same steps, so that errors of coarse steps mostly cancel.
class WavelengthSteps {
 public:
  /// The points of the CIE's tables, every 5 nm, as CIE 13.3-1995 asks.
  WavelengthSteps();
  /// Bands, by the means over them.
  explicit WavelengthSteps(const Bands& bands);
  std::size_t size() const { return matching_.size(); }

  /// Power of a spectrum in each step, per nm.
  std::vector<double> power_of(const Spectrum& spectrum) const;
  /// XYZ of a power in each step, through a filter or off a surface where `reflectance` is given; any scale.
  DVec3 xyz_of(const std::vector<double>& power, const std::vector<double>* reflectance = nullptr) const;
  /// Of test colour i, 0 to 7.
  const std::vector<double>& test_colour(std::size_t i) const { return test_[i]; }

 private:
  std::vector<double> taken(const CieTable& table) const;
  std::vector<DVec3> matching_;
  std::vector<double> lo_nm_, hi_nm_;  // equal where a step is a point
  std::array<std::vector<double>, 8> test_;
};

struct ColourRendering {
  double cct_K = 0;  ///< correlated colour temperature (CIE 15: nearest in CIE 1960 u, v)
  double duv = 0;    ///< distance from the Planckian locus, above 0 on the green side
  double ra = 0;     ///< general index, mean of `special`; 100 is as the reference, may be below 0
  std::array<double, 8> special{};  ///< R1 to R8
};

/// By CIE 13.3-1995; the reference is Planck's radiation below 5000 K and CIE daylight from there on. Nothing
/// where the light is black, or so far from the locus (Duv beyond 0.05) or beyond 1000 to 25000 K that no
/// colour temperature is like it.
std::optional<ColourRendering> colour_rendering(const WavelengthSteps& steps,
                                                const std::vector<double>& power);

/// Relative power of a black body, and of CIE daylight of 4000 to 25000 K (CIE 15).
Spectrum planck_spectrum(double temperature_K);
Spectrum daylight_spectrum(double cct_K);

}  // namespace phos::inline scene
