// Spectra for colours that are given as RGB.
#pragma once

#include <array>
#include <vector>

#include "core/vector.h"
#include "scene/spectral/bands.h"

namespace phos::inline scene {

/// The smooth reflectances of Jakob and Hanika, "A low-dimensional function space for efficient spectral
/// upsampling" (2019): a sigmoid of a quadratic of wavelength, always between 0 and 1, that under D65 has the
/// linear Rec.709 colour asked for. It is fitted in the bands themselves (a band's reflectance is that at its
/// middle), so that light that is reflected once has the RGB result at every number of bands; greys are
/// constant exactly. Colours that no reflectance of this form has in so few bands come out nearest to it
/// (tests/unit/scene_bands.cpp says how near).
class ReflectanceFit {
 public:
  explicit ReflectanceFit(const Bands& bands);
  /// Reflectance in every band. Components of `rgb` are clamped to 0 .. 1.
  std::vector<double> fit(const Rgb& rgb) const;
  /// Linear Rec.709 under D65 of a reflectance in every band.
  DVec3 rgb_of(const std::vector<double>& reflectance) const;

 private:
  using Coefficients = DVec3;  // of 1, t, t^2; t from -1 to 1
  DVec3 evaluate(const Coefficients& c, glm::dmat3* slopes) const;
  std::vector<DVec3> weight_;  // Rec.709 of each band's white light
  std::vector<double> t_;
};

/// RGB colours in the bands of one triplet.
class BandColours {
 public:
  BandColours(const Bands& bands, int triplet);
  int triplet() const { return triplet_; }
  const Bands& bands() const { return *bands_; }

  /// Reflectance in the three bands. Above 1 it is the reflectance of the colour over its largest component,
  /// times that component.
  Rgb reflectance(const Rgb& rgb) const;
  /// Light of that colour: D65 through a filter of half the largest component's strength (which is smoother
  /// than the colour at its full strength).
  Rgb light(const Rgb& rgb) const;
  /// White light (D65) of luminance 1.
  Rgb white_light() const { return white_; }

 private:
  const Bands* bands_;
  int triplet_;
  ReflectanceFit fit_;
  Rgb white_;
};

/// The same for many colours, by a table (kSide^3 spectra for each largest component). Between spectra it is
/// linear, as colours are, so that it gives colours back as exactly; greys are constant exactly.
class BandColourTable {
 public:
  explicit BandColourTable(const BandColours& exact);
  Rgb reflectance(const Rgb& rgb) const;
  Rgb light(const Rgb& rgb) const;

 private:
  static constexpr int kSide = 16;
  Rgb relative(const Rgb& rgb, float largest) const;
  const BandColours* exact_;
  std::vector<Rgb> node_;  // reflectance over the largest component: [which][its size][one other][the next]
};

}  // namespace phos::inline scene
