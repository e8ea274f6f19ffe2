// How the luminance of a sky is spread over it, up to a factor.
#pragma once

namespace phos::inline scene {

/// Luminance over the hemisphere up to a factor that horizontal illuminance decides. CIE S 011:2003 (ISO
/// 15469:2004) and Perez et al. 1993 share the form gradation x indicatrix,
///   (1 + a exp(b / cos Z)) (1 + c (exp(d chi) - f) + e cos^2(chi)),
/// with Z from the zenith and chi from the sun, both in radians.
struct SkyShape {
  double a = 0, b = -1;
  double c = 0, d = -1, e = 0, f = 0;
  bool traditional = false;  ///< (1 + 2 cos Z) / 3 instead of the form (Moon and Spencer 1942; CIE type 16)

  /// Brighter about the sun, so that the sun's position must be known?
  bool has_sun_side() const { return c != 0 || e != 0; }
  /// At cosines of Z (at the horizon, 0, the limit from above) and of chi. Not negative: where measured
  /// coefficients (of Perez) give less than nothing, 0.
  double luminance(double cos_zenith, double cos_sun) const;
};

/// CIE standard general sky of type 1 .. 15, and the traditional overcast sky, 16. Table 1 of CIE S 011.
SkyShape cie_sky(int type);

}  // namespace phos::inline scene
