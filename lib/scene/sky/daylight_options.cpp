#include "scene/sky/daylight_options.h"

#include <cstdlib>

namespace phos::inline scene {
namespace {

struct TextOption {
  const char *name, *unit, *help;
  std::string DaylightOptions::*value;
};
constexpr TextOption kTexts[] = {
    {"sky", "SKY",
     "light of a sky: overcast (luminance as (1 + 2 sin elevation) / 3, the traditional CIE sky), clear (CIE "
     "type 12), cie:1 to cie:15 (CIE S 011 / ISO 15469), cie:16 (the same as overcast) or perez (from "
     "irradiances). Up is +Y. A stage that reads photons or caches takes from them the options of sky, sun, "
     "place, time, bands and portals that are not given; files are to be given to every stage",
     &DaylightOptions::sky},
    {"sun", "AZIMUTH,ELEVATION",
     "position of the sun in degrees: azimuth clockwise from north, and elevation above the horizon",
     &DaylightOptions::sun},
    {"location", "LAT,LON",
     "latitude and longitude of the scene in degrees, north and east above 0; with --when, instead of --sun",
     &DaylightOptions::location},
    {"when", "TIME", "date, time and time zone for --location, like 2026-06-21T14:00+02:00",
     &DaylightOptions::when}};

struct NumberOption {
  const char *name, *unit, *help;
  std::optional<double> DaylightOptions::*value;
  Range range;
};
const NumberOption kNumbers[] = {
    {"sky-illuminance", "LUX",
     "illuminance of open, level ground by the sky alone (default: overcast types 1 to 6 and cie:16: 300 + "
     "21000 sin elevation, or 10000 where no sun is given; partly cloudy types 7 to 10: 300 + 45000 sin "
     "elevation; clear types 11 to 15: 800 + 15500 sqrt(sin elevation); perez: --diffuse-irradiance times "
     "its luminous efficacy)",
     &DaylightOptions::sky_lx, kPositive},
    {"sun-illuminance", "LUX",
     "illuminance by the sun alone of a surface that faces it; 0: no sunlight (default, with s = sin "
     "elevation: 127500 exp(-0.21 / s) under clear skies and without --sky; 127500 exp(-0.8 / s) under "
     "partly cloudy skies; 0 under overcast skies; perez: --direct-irradiance times its luminous efficacy)",
     &DaylightOptions::sun_lx, kNotNegative},
    {"sun-diameter",
     "DEGREES",
     "angular diameter of the sun's disc (default: 0.533)",
     &DaylightOptions::sun_diameter_deg,
     {0.001, 90}},
    {"direct-irradiance", "W/m2",
     "required with --sky perez: irradiance by the sun of a surface that faces it; 0: no sunlight",
     &DaylightOptions::direct_w_m2, kNotNegative},
    {"diffuse-irradiance", "W/m2",
     "required with --sky perez: irradiance of open, level ground by the sky alone",
     &DaylightOptions::diffuse_w_m2, kPositive},
    {"dew-point",
     "CELSIUS",
     "with --sky perez: dew point of the air, which sets the luminous efficacy (default: 11)",
     &DaylightOptions::dew_point_c,
     {-80, 60}},
    {"ground-albedo",
     "SHARE",
     "reflectance of the ground below the horizon, which is lit as open ground; 0: black (default: 0.2)",
     &DaylightOptions::ground_albedo,
     {0, 1}},
    {"north",
     "DEGREES",
     "direction of north: clockwise from -Z seen from above; 90 is +X (default: 0)",
     &DaylightOptions::north_deg,
     {-360, 360}}};

}  // namespace

void declare_options(Options& options, DaylightOptions& daylight) {
  for (const TextOption& o : kTexts)
    options.text(o.name, daylight.*o.value, o.unit, o.help, {Recorded::if_given, Adopted::site});
  for (const NumberOption& o : kNumbers)
    options.number(o.name, daylight.*o.value, o.unit, o.help, o.range, {Recorded::if_given, Adopted::site});
}

std::vector<std::string> daylight_words(const DaylightOptions& options) {
  std::vector<std::string> words;
  for (const TextOption& o : kTexts)
    if (const std::string& value = options.*o.value; !value.empty())
      words.insert(words.end(), {std::string("--") + o.name, value});
  for (const NumberOption& o : kNumbers)
    if (const auto& value = options.*o.value)
      words.insert(words.end(), {std::string("--") + o.name, shortest(*value)});
  return words;
}

void read_daylight_word(const std::string& word, const std::string& value, DaylightOptions& options) {
  for (const TextOption& o : kTexts)
    if (word == std::string("--") + o.name) options.*o.value = value;
  for (const NumberOption& o : kNumbers)
    if (word == std::string("--") + o.name) options.*o.value = std::strtod(value.c_str(), nullptr);
}

}  // namespace phos::inline scene
