// Where the sun stands, by place and time.
#pragma once

#include <string>

namespace phos::inline scene {

struct SunPosition {
  double azimuth_rad = 0;    ///< clockwise from north, 0 .. 2 pi
  double elevation_rad = 0;  ///< of its centre above the horizon, as seen: lifted by refraction
  double distance_au = 1;
};

/// Seconds since 1970-01-01T00:00Z of `2026-06-21T14:00+02:00`: date, T, hours and minutes, seconds if given,
/// and the zone, Z or hours and minutes ahead of UTC. Throws Error(usage) under the name of `option` for
/// anything else, for days that the calendar lacks, and for years outside 1900 .. 2100.
double parse_instant(const std::string& option, const std::string& text);

/// Low-accuracy position of the sun of Meeus (Astronomical Algorithms, 2nd ed., ch. 25: 0.01 degrees from
/// 1900 to 2100), seen from a latitude (north above 0) and longitude (east above 0) at sea level: parallax
/// (8.794") and refraction of a standard atmosphere (Saemundsson 1986, from -1 degree on) included. The
/// difference of ephemeris and civil time, 70 s, is taken as none: 0.001 degrees.
SunPosition sun_position(double latitude_rad, double longitude_rad, double unix_s);

}  // namespace phos::inline scene
