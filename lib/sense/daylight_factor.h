// Illuminance at sensors as shares of that outside, under the same sky.
#pragma once

#include "sense/sensors.h"

namespace phos::inline sense {

/// Horizontal illuminance in the open by the scene's sky or environment map (luminance of RGB), lx, of which
/// daylight factors are shares. Throws Error(usage) where there is none, and where the scene has other
/// light, which they are not of: a sun, or lamps.
double open_sky_lx(const Scene& scene);

/// Adds mean, least and greatest factor, in percent, to a summary of readings; and says them in a line for
/// people. No sensor: nothing, "".
void add_daylight_factors(Json& summary, double open_lx);
std::string daylight_line(const Json& summary);

}  // namespace phos::inline sense
