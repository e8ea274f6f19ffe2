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
     "light of a sky: overcast ((1 + 2 sin elevation) / 3, the traditional one), clear (CIE type 12), cie:1 "
     "to "
     "cie:15 (CIE S 011 / ISO 15469; cie:16 is overcast) or perez (from irradiances); up is +Y. What "
     "is not given of sky, sun, place and time, bands and portals is taken from the photons or caches that a "
     "stage reads; files are to be given to every stage",
     &DaylightOptions::sky},
    {"sun", "AZIMUTH,ELEVATION",
     "where the sun stands, in degrees: clockwise from north, and above the horizon", &DaylightOptions::sun},
    {"location", "LAT,LON",
     "where the scene is, in degrees, north and east above 0: with --when, instead of --sun",
     &DaylightOptions::location},
    {"when", "TIME", "date, time and zone for --location, like 2026-06-21T14:00+02:00",
     &DaylightOptions::when}};

struct NumberOption {
  const char *name, *unit, *help;
  std::optional<double> DaylightOptions::*value;
  Range range;
};
const NumberOption kNumbers[] = {
    {"sky-illuminance", "LUX",
     "on the ground in the open, by the sky alone (default: overcast types 1-6 and 16 300 + 21000 sin "
     "elevation, or 10000 where no sun is given; partly cloudy, 7-10, 300 + 45000 sin elevation; clear, "
     "11-15, "
     "800 + 15500 sqrt(sin elevation); perez by its luminous efficacy)",
     &DaylightOptions::sky_lx, kPositive},
    {"sun-illuminance", "LUX",
     "by the sun alone, on a surface that faces it (default, with s = sin elevation: 127500 exp(-0.21 / s) "
     "under clear skies and without --sky, 127500 exp(-0.8 / s) under partly cloudy ones, 0 under overcast "
     "ones; perez by its luminous efficacy)",
     &DaylightOptions::sun_lx, kNotNegative},
    {"sun-diameter", "DEGREES", "as seen (default: 0.533)", &DaylightOptions::sun_diameter_deg, {0.001, 90}},
    {"direct-irradiance", "W/m2", "for --sky perez: of the sun, on a surface that faces it",
     &DaylightOptions::direct_w_m2, kNotNegative},
    {"diffuse-irradiance", "W/m2", "for --sky perez: of the sky alone, on the ground in the open",
     &DaylightOptions::diffuse_w_m2, kPositive},
    {"dew-point",
     "CELSIUS",
     "for --sky perez: of the air, for its luminous efficacy (default: 11)",
     &DaylightOptions::dew_point_c,
     {-80, 60}},
    {"ground-albedo",
     "SHARE",
     "below the horizon lies ground that reflects so much of what falls on it in the open (default: 0.2)",
     &DaylightOptions::ground_albedo,
     {0, 1}},
    {"north",
     "DEGREES",
     "where north is: clockwise from -Z seen from above, so that 90 is +X (default: 0)",
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
