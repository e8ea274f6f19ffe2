// Wavelength bands, and the measure of light in them.
//
// Light in N bands is computed in ceil(N / 3) ordinary runs, in each of which the three components of Rgb are
// not red, green and blue but three neighbouring bands, a triplet; bands do not mix in transport. Then
//   - a reflectance is its mean over the band;
//   - light (lm, lx, cd, cd/m2) of component c is the luminous share of the light that lies in the band,
//     over the weight of component c in luminance() (0.2126, 0.7152, 0.0722).
// So luminance() of a triplet is the photometric quantity of the light in its bands, and the sum over
// triplets is the quantity of all light: lux stay lux. Within a band the colour matching functions count by
// their means under D65 (as the weights of ASTM E308 do), so that white light on grey surfaces is white for
// every N.
#pragma once

#include <vector>

#include "core/vector.h"
#include "scene/spectral/spectrum.h"

namespace phos::inline scene {

/// N equal bands of 380 to 780 nm, counted from 0, in triplets, counted from 1. Of a last triplet that N does
/// not fill the rest is empty: no light, no reflectance.
class Bands {
 public:
  static constexpr int kLeast = 3, kMost = 400;
  /// kLeast <= n <= kMost.
  explicit Bands(int n);

  int size() const { return static_cast<int>(white_xyz_.size()); }
  int triplets() const { return (size() + 2) / 3; }
  double lo_nm(int band) const;
  double hi_nm(int band) const { return lo_nm(band + 1); }

  /// CIE XYZ of the part in a band of white light (D65) with Y = 1; the sum over all bands is the white of
  /// Rec.709 exactly.
  const DVec3& white_xyz(int band) const { return white_xyz_[static_cast<std::size_t>(band)]; }
  /// Luminous share of each band in light of a relative power; sums to 1.
  std::vector<double> luminous_shares(const Spectrum& power) const;
  /// Mean of a spectrum over each band.
  std::vector<double> means(const Spectrum& spectrum) const;
  /// Mean of the colour matching functions over a band, under D65.
  const DVec3& matching(int band) const { return matching_[static_cast<std::size_t>(band)]; }

  /// Linear Rec.709 of 1 in component c of a triplet. Its luminance() is the weight of c; 0 for an empty
  /// band.
  DVec3 rgb_of(int triplet, int c) const;
  /// The band of component c of a triplet, or -1.
  int band_of(int triplet, int c) const {
    const int band = 3 * (triplet - 1) + c;
    return band < size() ? band : -1;
  }
  /// Three components of a triplet from values of every band; 0 where it has none.
  DVec3 triplet_of(const std::vector<double>& of_bands, int triplet) const;

 private:
  std::vector<DVec3> white_xyz_, matching_;
};

/// Weights of luminance().
inline constexpr double kLuminanceWeight[3] = {0.2126, 0.7152, 0.0722};
/// Light in a triplet's bands from its luminous shares there: over the weights.
inline DVec3 light_of_shares(const DVec3& shares) {
  return {shares.x / kLuminanceWeight[0], shares.y / kLuminanceWeight[1], shares.z / kLuminanceWeight[2]};
}

/// CIE XYZ of linear Rec.709, with a Y that is luminance(), and back.
DVec3 xyz_of_rgb(const DVec3& rgb);
DVec3 rgb_of_xyz(const DVec3& xyz);

}  // namespace phos::inline scene
