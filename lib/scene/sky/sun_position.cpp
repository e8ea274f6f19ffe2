#include "scene/sky/sun_position.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline scene {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double radians(double degrees) { return degrees * kPiD / 180; }

/// Reads the parts of an instant from left to right.
class Reader {
 public:
  Reader(const std::string& option, const std::string& text) : option_(option), text_(text) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(
        ExitCode::usage, option_,
        phos::text("\"", text_, "\" ", why, "; give date, time and zone like 2026-06-21T14:00+02:00"));
  }
  bool at(char c) const { return next_ < text_.size() && text_[next_] == c; }
  bool take(char c) {
    if (!at(c)) return false;
    ++next_;
    return true;
  }
  void require(char c) {
    if (!take(c)) fail("is no instant");
  }
  int number(int digits) {
    int value = 0;
    for (int i = 0; i < digits; ++i, ++next_) {
      if (next_ >= text_.size() || text_[next_] < '0' || text_[next_] > '9') fail("is no instant");
      value = 10 * value + (text_[next_] - '0');
    }
    return value;
  }
  /// Hours and minutes, in minutes.
  int clock(int most_hours) {
    const int hours = number(2);
    require(':');
    const int minutes = number(2);
    if (hours > most_hours || minutes > 59) fail("has no such hour");
    return 60 * hours + minutes;
  }
  bool done() const { return next_ == text_.size(); }

 private:
  const std::string &option_, &text_;
  std::size_t next_ = 0;
};

}  // namespace

double parse_instant(const std::string& option, const std::string& text) {
  namespace c = std::chrono;
  Reader in(option, text);
  const int year = in.number(4);
  in.require('-');
  const int month = in.number(2);
  in.require('-');
  const int day = in.number(2);
  const c::year_month_day date{c::year(year), c::month(static_cast<unsigned>(month)),
                               c::day(static_cast<unsigned>(day))};
  if (!date.ok()) in.fail("is no day of the calendar");
  if (year < 1900 || year > 2100) in.fail("is not from 1900 to 2100, for which the sun's position is known");
  in.require('T');
  int minutes = in.clock(23);
  const int seconds = in.take(':') ? in.number(2) : 0;
  if (seconds > 59) in.fail("has no such second");
  if (in.done()) in.fail("has no time zone");
  if (!in.take('Z')) {
    const bool behind = in.at('-');
    if (!behind && !in.at('+')) in.fail("has no time zone");
    in.take(behind ? '-' : '+');
    const int zone = in.clock(14);
    minutes += behind ? zone : -zone;
  }
  if (!in.done()) in.fail("goes on after its zone");
  const auto days = c::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 60.0 * minutes + seconds;
}

SunPosition sun_position(double latitude_rad, double longitude_rad, double unix_s) {
  const double days = unix_s / 86400 - 10957.5, t = days / 36525;  // since J2000.0; in centuries
  const double mean_longitude = radians(280.46646 + t * (36000.76983 + t * 0.0003032));
  const double anomaly = radians(357.52911 + t * (35999.05029 - t * 0.0001537));
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double centre =
      radians((1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
              (0.019993 - t * 0.000101) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly));
  SunPosition sun;
  sun.distance_au =
      1.000001018 * (1 - eccentricity * eccentricity) / (1 + eccentricity * std::cos(anomaly + centre));
  // Apparent longitude: nutation and aberration.
  const double node = radians(125.04 - 1934.136 * t);
  const double nutation = radians(-0.00478) * std::sin(node);
  const double longitude = mean_longitude + centre - radians(0.00569) + nutation;
  const double obliquity =
      radians(23.439291 - t * (0.0130042 + t * (0.00000016 - t * 0.000000504)) + 0.00256 * std::cos(node));
  const double ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double sine = std::sin(obliquity) * std::sin(longitude), cosine = std::sqrt((1 - sine) * (1 + sine));
  const double sidereal =
      radians(280.46061837 + std::fmod(360.98564736629 * days, 360.0) + t * t * 0.000387933) +
      nutation * std::cos(obliquity);
  const double hour = sidereal + longitude_rad - ascension;
  const double north = sine * std::cos(latitude_rad) - cosine * std::sin(latitude_rad) * std::cos(hour);
  const double east = -cosine * std::sin(hour);
  const double up = sine * std::sin(latitude_rad) + cosine * std::cos(latitude_rad) * std::cos(hour);
  sun.azimuth_rad = std::atan2(east, north);
  if (sun.azimuth_rad < 0) sun.azimuth_rad += 2 * kPiD;
  double height = std::atan2(up, std::hypot(north, east));
  height -= radians(8.794 / 3600) / sun.distance_au * std::cos(height);
  const double degrees = height * 180 / kPiD;
  if (degrees > -1) height += radians(1.02 / 60) / std::tan(radians(degrees + 10.3 / (degrees + 5.11)));
  sun.elevation_rad = height;
  return sun;
}

}  // namespace phos::inline scene
