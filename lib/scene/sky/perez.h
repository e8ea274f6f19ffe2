// The all-weather sky of Perez, from measured irradiance.
#pragma once

#include "scene/sky/shape.h"

namespace phos::inline scene {

/// What a weather station measures, and where the sun stands.
struct Irradiances {
  double direct_normal_w_m2 = 0;       ///< of the sun, on a surface that faces it
  double diffuse_horizontal_w_m2 = 0;  ///< of the sky without the sun
  double elevation_rad = 0;            ///< of the sun, above 0
  double distance_au = 1;              ///< of the sun
  double dew_point_c = 11;             ///< of the air at the ground: how much water is above it
};

/// A sky by Perez, Seals and Michalsky (All-weather model for sky luminance distribution, Solar Energy 50,
/// 1993, and its erratum), with illuminances by the luminous efficacies of Perez, Ineichen, Seals, Michalsky
/// and Stewart (Modeling daylight availability and irradiance components, Solar Energy 44, 1990).
struct PerezSky {
  SkyShape shape;
  double clearness = 1;   ///< epsilon: 1 overcast, above 6.2 very clear
  double brightness = 0;  ///< Delta: diffuse irradiance, over the irradiance of the ground without air
  double sky_lx = 0;      ///< on a horizontal surface, by the sky alone
  double sun_lx = 0;      ///< on a surface that faces the sun, by the sun alone
};

/// Throws Error(usage) where brightness is not in 0.01 .. 0.6, which no sky that the model was made from had.
/// Two things are done as in Radiance's gendaylit: between overcast and clear (1.065 < epsilon < 2.8)
/// brightness below 0.2 is taken as 0.2, and relative air mass is Kasten's of 1965. A gradation that would
/// have no finite horizon (b above 0) is taken as none.
PerezSky perez_sky(const Irradiances& measured);

}  // namespace phos::inline scene
