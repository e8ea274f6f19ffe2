// Options that give a scene a sky and a sun.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/options.h"

namespace phos::inline scene {

struct DaylightOptions {
  std::string sky;       ///< overcast, clear, cie:1 .. cie:16, perez; "": none
  std::string sun;       ///< AZIMUTH,ELEVATION in degrees; "": not told so
  std::string location;  ///< LATITUDE,LONGITUDE in degrees
  std::string when;      ///< date, time and zone
  std::optional<double> sky_lx, sun_lx, sun_diameter_deg, direct_w_m2, diffuse_w_m2, dew_point_c,
      ground_albedo, north_deg;

  bool any() const { return !sky.empty() || !sun.empty() || !location.empty() || !when.empty(); }
};
void declare_options(Options& options, DaylightOptions& daylight);
/// The words of a command line that mean the same.
std::vector<std::string> daylight_words(const DaylightOptions& options);
/// Takes over word i of a command line and its value at i + 1, where it is of daylight. The values must have
/// been read by declare_options() before.
void read_daylight_word(const std::string& word, const std::string& value, DaylightOptions& options);

}  // namespace phos::inline scene
