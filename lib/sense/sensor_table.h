// Readings of sensors as a table, and in a few figures.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/json.h"
#include "sense/sensors.h"

namespace phos::inline sense {

/// id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx and a line for each sensor, shortest numbers, in
/// pieces that follow each other. With the illuminance in the open also
/// daylight_factor_percent,daylight_factor_stderr_percent: E and stderr as shares of it. In bands, E and all
/// else are of the light in the triplet's bands, and there is band_K_of_N_lx for each of them (K from 1),
/// their shares of E.
std::vector<std::string> sensor_csv(const Sensors& sensors, std::span<const Reading> readings,
                                    std::optional<double> open_lx = std::nullopt,
                                    const BandTriplet& bands = {});

/// number, mean_lx, min_lx, max_lx, U0 = min/mean, Ud = min/max (absent where everything is dark or there is
/// no sensor).
Json summarise(std::span<const Reading> readings);

/// A summary (which may also hold the level_m of a workplane) in a line for people.
std::string summary_line(const Json& summary);

}  // namespace phos::inline sense
