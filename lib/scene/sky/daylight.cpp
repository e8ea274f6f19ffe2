#include "scene/sky/daylight.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "scene/sky/perez.h"
#include "scene/sky/sun_position.h"

namespace phos::inline scene {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr int kRows = 512;

[[noreturn]] void fail(const char* option, const std::string& message) {
  throw Error(ExitCode::usage, option, message);
}

std::array<double, 2> read_pair(const char* option, const std::string& given, const char* form) {
  std::array<double, 2> values{};
  const char *at = given.data(), *const end = at + given.size();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool apart = i == 0 ? next != end && *next == ',' : next == end;
    if (error != std::errc() || !apart || !std::isfinite(values[i]))
      fail(option, text("\"", given, "\" is not of the form ", form));
    if (i == 0) at = next + 1;
  }
  return values;
}

std::string degrees_text(double rad) {
  return shortest(static_cast<float>(std::round(rad * 1.8e5 / kPiD) / 1e3));
}

/// Where the sun stands, if the options say.
std::optional<SunPosition> find_sun(const DaylightOptions& o) {
  if (!o.sun.empty() && (!o.location.empty() || !o.when.empty()))
    fail("--sun", "states the position of the sun, and so do --location and --when; give one of the two");
  if (o.location.empty() != o.when.empty())
    fail(o.location.empty() ? "--location" : "--when",
         "is missing: the sun's position needs both --location and --when; give both");
  SunPosition sun;
  if (!o.sun.empty()) {
    const auto [azimuth, elevation] = read_pair("--sun", o.sun, "AZIMUTH,ELEVATION in degrees, like 180,45");
    if (std::fabs(azimuth) > 360 || std::fabs(elevation) > 90)
      fail("--sun",
           text("\"", o.sun, "\" is no place in the sky: azimuth is in -360 .. 360, elevation up to 90"));
    sun.azimuth_rad = glm::radians(azimuth), sun.elevation_rad = glm::radians(elevation);
  } else if (!o.location.empty()) {
    const auto [latitude, longitude] =
        read_pair("--location", o.location, "LATITUDE,LONGITUDE in degrees, like 52.5,13.4");
    if (std::fabs(latitude) > 90 || std::fabs(longitude) > 180)
      fail("--location",
           text("\"", o.location, "\" is not on earth: latitude is in -90 .. 90, longitude in -180 .. 180"));
    sun = sun_position(glm::radians(latitude), glm::radians(longitude), parse_instant("--when", o.when));
  } else {
    return std::nullopt;
  }
  if (!(sun.elevation_rad > 0))
    fail(o.sun.empty() ? "--when" : "--sun", text("the sun is ", degrees_text(-sun.elevation_rad),
                                                  " degrees below the horizon; skies are for daytime: give a "
                                                  "time or a position with the sun above the horizon"));
  return sun;
}

/// The number of a CIE type; 0: perez.
int sky_type(const std::string& name) {
  if (name == "overcast") return 16;
  if (name == "clear") return 12;
  if (name == "perez") return 0;
  int type = 0;
  const char* const end = name.data() + name.size();
  if (name.starts_with("cie:")) {
    const auto [next, error] = std::from_chars(name.data() + 4, end, type);
    if (error == std::errc() && next == end && type >= 1 && type <= 16) return type;
  }
  fail("--sky", text("\"", name, "\" is not a sky; give overcast, clear, cie:1 to cie:16, or perez"));
}

enum class Cover { overcast, partly, clear };
Cover cover_of(int type) {
  return type <= 6 || type == 16 ? Cover::overcast : type <= 10 ? Cover::partly : Cover::clear;
}

/// Horizontal illuminance of skies in the form of the IES Lighting Handbook, and normal illuminance of the
/// sun by its height (IES, "Recommended practice for the calculation of daylight availability", J. IES 13(4),
/// 1984, which has 127.5 klx outside the atmosphere; its own skies are within a tenth of these).
double usual_sky_lx(Cover cover, const std::optional<SunPosition>& sun) {
  if (!sun) return 10000;
  const double s = std::sin(sun->elevation_rad);
  if (cover == Cover::overcast) return 300 + 21000 * s;
  return cover == Cover::partly ? 300 + 45000 * s : 800 + 15500 * std::sqrt(s);
}
double usual_sun_lx(Cover cover, const SunPosition& sun) {
  if (cover == Cover::overcast) return 0;
  return 127500 * std::exp((cover == Cover::partly ? -0.80 : -0.21) / std::sin(sun.elevation_rad));
}

void check_belongs(const DaylightOptions& o) {
  const auto only = [](bool given, const char* option, const char* why) {
    if (given) fail(option, why);
  };
  const bool sky = !o.sky.empty(), perez = o.sky == "perez", sun = !o.sun.empty() || !o.location.empty();
  const char *needs_sky = "needs a sky; give --sky",
             *needs_sun = "needs the sun; give --sun, or --location and --when",
             *needs_perez = "needs --sky perez; leave it out, or give that sky";
  only(!sky && o.sky_lx.has_value(), "--sky-illuminance", needs_sky);
  only(!sun && o.sun_lx.has_value(), "--sun-illuminance", needs_sun);
  only(!sun && o.sun_diameter_deg.has_value(), "--sun-diameter", needs_sun);
  only(!sun && o.north_deg.has_value(), "--north", needs_sun);
  only(!o.any() && o.ground_albedo.has_value(), "--ground-albedo", needs_sky);
  only(!perez && o.direct_w_m2.has_value(), "--direct-irradiance", needs_perez);
  only(!perez && o.diffuse_w_m2.has_value(), "--diffuse-irradiance", needs_perez);
  only(!perez && o.dew_point_c.has_value(), "--dew-point", needs_perez);
}

/// Sky and illuminances by irradiance.
void resolve_perez(const DaylightOptions& o, const SunPosition& sun, Daylight& d) {
  if (!o.direct_w_m2 || !o.diffuse_w_m2)
    fail(o.direct_w_m2 ? "--diffuse-irradiance" : "--direct-irradiance",
         "is missing: --sky perez needs direct normal and diffuse horizontal irradiance; give both");
  const PerezSky perez = perez_sky(
      {*o.direct_w_m2, *o.diffuse_w_m2, sun.elevation_rad, sun.distance_au, o.dew_point_c.value_or(11)});
  d.sky = perez.shape, d.sky_lx = o.sky_lx.value_or(perez.sky_lx), d.sun_lx = o.sun_lx.value_or(perez.sun_lx);
}

/// What the sun gives outside of the atmosphere, at a distance of 1 au, on a surface that faces it. The
/// irradiance is the solar constant of Kopp and Lean (2011), the illuminance the one of the CIE.
constexpr double kSolarConstant_w_m2 = 1361, kSolarIlluminance_lx = 133800;

/// Warns of more light than the sun gives outside of the atmosphere.
void check_against_space(const DaylightOptions& o, double distance_au, Daylight& d) {
  const double nearer = 1 / (distance_au * distance_au);
  const auto warn = [&](const char* option, double value, double most, const char* unit) {
    if (value > most)
      d.warnings.push_back(text(option, " ", shortest(value), " ", unit, " is more than the ",
                                std::llround(most), " ", unit, kMoreThanInSpace));
  };
  const double most_w_m2 = kSolarConstant_w_m2 * nearer, most_lx = kSolarIlluminance_lx * nearer;
  warn("--direct-irradiance", o.direct_w_m2.value_or(0), most_w_m2, "W/m2");
  warn("--diffuse-irradiance", o.diffuse_w_m2.value_or(0), most_w_m2, "W/m2");
  warn("--sun-illuminance", o.sun_lx.value_or(0), most_lx, "lx");
  warn("--sky-illuminance", o.sky_lx.value_or(0), most_lx, "lx");
}

/// Six digits of each number, which the processor's rounding leaves alone.
std::string recipe_of(const Daylight& d) {
  std::string recipe;
  const auto add = [&](double value) { recipe += text(value + 0.0, ' '); };
  if (d.sky) {
    const SkyShape& s = *d.sky;
    for (const double value : {s.a, s.b, s.c, s.d, s.e, s.f, s.traditional ? 1. : 0., d.sky_lx}) add(value);
  }
  const bool sun_side = d.sky && d.sky->has_sun_side();
  if (d.towards_sun && (sun_side || d.sun_lx > 0)) {
    for (int c = 0; c < 3; ++c) add((*d.towards_sun)[c]);
    add(d.sun_lx), add(d.sun_radius_rad);
  }
  add(d.ground_albedo);
  return recipe;
}

/// Means over the texels of the upper half, per unit of the sky's own luminance.
std::vector<double> sky_means(const SkyShape& sky, const DVec3& towards_sun) {
  constexpr int kColumns = 2 * kRows;
  constexpr double kGauss = 0.28867513459481287;  // of a side, from the middle: exact to cubic terms
  std::vector<double> means(std::size_t{kRows / 2} * kColumns);
  parallel_for(kRows / 2, 8, [&](std::size_t row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      double sum = 0, weights = 0;
      for (const double down : {-kGauss, kGauss}) {
        const double theta = kPiD / kRows * (static_cast<double>(row) + 0.5 + down);
        const double y = std::cos(theta), sine = std::sin(theta);
        for (const double along : {-kGauss, kGauss}) {
          const double phi = kPiD - kPiD / kRows * (static_cast<double>(column) + 0.5 + along);
          const DVec3 w(sine * std::sin(phi), y, sine * std::cos(phi));
          sum += sine * sky.luminance(y, glm::dot(w, towards_sun)), weights += sine;
        }
      }
      means[row * kColumns + column] = sum / weights;
    }
  });
  return means;
}

}  // namespace

Daylight resolve(const DaylightOptions& o) {
  check_belongs(o);
  const std::optional<SunPosition> sun = find_sun(o);
  Daylight d;
  Cover cover = Cover::clear;
  if (!o.sky.empty()) {
    const int type = sky_type(o.sky);
    if (type > 0) d.sky = cie_sky(type), cover = cover_of(type);
    if ((type == 0 || d.sky->has_sun_side()) && !sun)
      fail("--sun", text("is missing: --sky ", o.sky,
                         " is brighter about the sun; give it, or --location and --when"));
    if (type == 0)
      resolve_perez(o, *sun, d);
    else
      d.sky_lx = o.sky_lx.value_or(usual_sky_lx(cover, sun));
  }
  if (sun) {
    const double bearing = sun->azimuth_rad + glm::radians(o.north_deg.value_or(0)), h = sun->elevation_rad;
    d.towards_sun = DVec3(std::cos(h) * std::sin(bearing), std::sin(h), -std::cos(h) * std::cos(bearing));
    if (o.sky != "perez") d.sun_lx = o.sun_lx.value_or(usual_sun_lx(cover, *sun));
    d.sun_radius_rad = glm::radians(o.sun_diameter_deg.value_or(0.533) / 2);
    if (d.sun_lx > 0 && h < d.sun_radius_rad)
      d.warnings.push_back(text("the sun's disc is cut by the horizon (its centre is ", degrees_text(h),
                                " degrees high); all of it shines"));
  }
  if (!o.any()) return d;
  check_against_space(o, sun ? sun->distance_au : 1, d);
  if (!(d.sky_lx > 0) && !(d.sun_lx > 0))
    fail("--sky", "gives no light: neither sky nor sun has any illuminance; give one above 0");
  if (!std::isfinite(static_cast<float>(d.sky_lx)) || !(d.sun_lx < 1e30))
    fail("--sky-illuminance", "is beyond the range of numbers; give a smaller value");
  d.ground_albedo = o.ground_albedo.value_or(0.2);
  d.recipe = recipe_of(d);
  return d;
}

bool is_overcast(const DaylightOptions& options) {
  if (options.sky.empty()) return false;
  const int type = sky_type(options.sky);
  return type == 1 || type == 3 || type == 16;
}

Environment make_environment(const Daylight& d) {
  constexpr std::size_t kUpper = std::size_t{kRows / 2} * 2 * kRows;
  std::vector<Rgb> texels(2 * kUpper, Rgb(0));
  if (d.sky) {
    const std::vector<double> means = sky_means(*d.sky, d.towards_sun.value_or(DVec3(0, 1, 0)));
    // Horizontal illuminance per unit.
    double unit_lx = 0;
    for (std::size_t row = 0; row < kRows / 2; ++row) {
      const auto lifted = [](std::size_t edge) {
        const double sine = std::sin(kPiD / kRows * static_cast<double>(edge));
        return 0.5 * sine * sine;
      };
      double sum = 0;
      for (std::size_t k = 0; k < 2 * kRows; ++k) sum += means[row * 2 * kRows + k];
      unit_lx += sum * kPiD / kRows * (lifted(row + 1) - lifted(row));
    }
    if (!(unit_lx > 0)) fail("--sky", "has no light anywhere by its model; check irradiance, time and place");
    for (std::size_t i = 0; i < kUpper; ++i)
      texels[i] = Rgb(static_cast<float>(d.sky_lx / unit_lx * means[i]));
  }
  std::optional<Environment::Sun> sun;
  double ground_lx = d.sky_lx;
  if (d.towards_sun && d.sun_lx > 0) {
    sun = Environment::Sun{*d.towards_sun, d.sun_radius_rad, Rgb(static_cast<float>(d.sun_lx))};
    ground_lx += d.sun_lx * d.towards_sun->y;
  }
  std::fill(texels.begin() + kUpper, texels.end(),
            Rgb(static_cast<float>(d.ground_albedo * ground_lx / kPiD)));
  Environment light(2 * kRows, kRows, std::move(texels), 0, sun);
  light.set_recipe(d.recipe);
  return light;
}

}  // namespace phos::inline scene
