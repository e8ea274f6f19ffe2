// Sky, sun and ground of a scene, as its options say.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/sky/daylight_options.h"
#include "scene/sky/environment.h"
#include "scene/sky/shape.h"

namespace phos::inline scene {

/// What the options mean. Directions are the scene's: +Y up.
struct Daylight {
  std::optional<SkyShape> sky;
  double sky_lx = 0;                 ///< on a horizontal surface, by the sky alone
  std::optional<DVec3> towards_sun;  ///< unit
  double sun_lx = 0;                 ///< on a surface that faces the sun, by the sun alone
  double sun_radius_rad = 0;         ///< half the angle of its disc
  double ground_albedo = 0;
  std::string recipe;                 ///< states the light in numbers; equal where the light is
  std::vector<std::string> warnings;  ///< one line each
};

/// End of the warning about more light than the sun gives outside of the atmosphere; lint looks for it.
inline constexpr const char* kMoreThanInSpace =
    " of the sun outside of the atmosphere; is it in another unit?";

/// Nothing where no option is given. Throws Error(usage) where options are missing, contradict each other or
/// cannot be read, where the sun is below the horizon, or where there would be no light at all.
Daylight resolve(const DaylightOptions& options);

/// Is the sky one of those that daylight factors are of by the norm: overcast, the same all around?
bool is_overcast(const DaylightOptions& options);

/// Its light: the sky's luminance as the means of texels of a third of a degree, scaled to its
/// illuminance; below the horizon the ground's, albedo times illuminance by sky and sun / pi; the sun as it
/// is. On surfaces of any slope the texels change illuminance by less than a thousandth
/// (tests/unit/scene_daylight.cpp).
Environment make_environment(const Daylight& daylight);

}  // namespace phos::inline scene
