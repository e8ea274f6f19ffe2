// IES LM-63: the standard file of photometric data of North America, in its editions of 1986, 1991, 1995,
// 2002 and 2019. Numbers are free of lines; keywords stand above TILT=, one to a line.
#include "scene/luminaire/ies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "scene/luminaire/photometric_lines.h"

namespace phos::inline scene {
namespace {

constexpr double kFoot_m = 0.3048;

/// Numbers one after another, wherever lines end. Blanks and commas part them.
class Numbers {
 public:
  Numbers(const std::vector<PhotometricLine>& lines, std::size_t first, const std::string& where)
      : lines_(lines), at_(first), where_(where) {
    if (at_ < lines_.size()) rest_ = lines_[at_].words;
    skip();
  }

  bool done() const { return at_ >= lines_.size(); }
  std::size_t line() const { return lines_.empty() ? 1 : lines_[std::min(at_, lines_.size() - 1)].number; }
  /// Of the number that was read last.
  std::size_t last_line() const { return last_line_; }
  void require_ascending(const std::vector<double>& deg, const char* which) const {
    phos::require_ascending(
        deg, which, where_, last_line_,
        commas_ ? "are its decimals written with commas? A comma separates numbers here" : kAskTheMaker);
  }

  std::string_view word() {
    last_line_ = line();
    const std::size_t end = std::min(rest_.find_first_of(" \t,"), rest_.size());
    const std::string_view w = rest_.substr(0, end);
    commas_ = commas_ || rest_.substr(end).starts_with(',');
    rest_.remove_prefix(end);
    skip();
    return w;
  }

  double next(const std::string& what) {
    if (done())
      fail(text("ends before ", what, "; the file is cut short, or its counts of angles are wrong"));
    const std::string_view w = word();
    double value = 0;
    if (!photometric_number(w, value))
      fail_at(where_, last_line_,
              text(what, " is \"", std::string(w.substr(0, 24)), "\", which is no finite number"));
    return value;
  }

  std::size_t whole(const std::string& what, std::size_t least) {
    const double v = next(what);
    if (!(v >= static_cast<double>(least) && v == std::floor(v) && v <= 1e9))
      fail_at(where_, last_line_, text(what, " is ", v, "; it must be a whole number of at least ", least));
    return static_cast<std::size_t>(v);
  }

  /// Angles or the like; memory only for the numbers that are there.
  std::vector<double> list(std::size_t n, const std::string& what) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(next(text(what, " ", i + 1, " of ", n)));
    return values;
  }

  /// All that are left, up to the end or a word that is none; and the line of each.
  std::vector<std::pair<double, std::size_t>> rest() const {
    std::vector<std::pair<double, std::size_t>> values;
    Numbers copy = *this;
    double value = 0;
    while (!copy.done() && photometric_number(copy.word(), value))
      values.emplace_back(value, copy.last_line());
    return values;
  }

  [[noreturn]] void fail(const std::string& message) const { fail_at(where_, line(), message); }

 private:
  void skip() {
    while (at_ < lines_.size()) {
      const std::size_t start = rest_.find_first_not_of(" \t,");
      if (start != std::string_view::npos) {
        rest_.remove_prefix(start);
        return;
      }
      if (++at_ < lines_.size()) rest_ = lines_[at_].words;
    }
  }

  const std::vector<PhotometricLine>& lines_;
  std::size_t at_, last_line_ = 1;
  bool commas_ = false;
  std::string_view rest_;
  const std::string& where_;
};

bool starts_with_tilt(std::string_view line) {
  constexpr std::string_view kTilt = "TILT=";
  return line.size() >= kTilt.size() &&
         std::equal(kTilt.begin(), kTilt.end(), line.begin(),
                    [](char a, char b) { return a == std::toupper(static_cast<unsigned char>(b)); });
}

std::optional<std::size_t> tilt_line(const std::vector<PhotometricLine>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (starts_with_tilt(lines[i].words)) return i;
  return {};
}

std::string tilt_value(std::string_view line) {
  std::string_view value = line.substr(line.find('=') + 1);
  value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
  return std::string(value);
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where, const ReadBeside& beside)
      : lines_(photometric_lines(bytes)), where_(where), beside_(beside) {}

  PhotometricFile read() {
    const std::optional<std::size_t> tilt = tilt_line(lines_);
    if (!tilt)
      fail_at(where_, lines_.empty() ? 1 : lines_.back().number,
              "has no line TILT=; the file is cut short, or is no LM-63 file");
    read_edition();
    read_keywords(*tilt);
    Numbers numbers(lines_, *tilt + 1, where_);
    read_tilt(tilt_value(lines_[*tilt].words), lines_[*tilt].number, numbers);
    read_lamps(numbers);
    read_angles(numbers);
    read_candela(numbers);
    return std::move(file_);
  }

 private:
  void warn(const std::string& message) { file_.warnings.push_back(message); }

  void read_edition() {
    const std::string_view first = lines_.front().words;
    for (const int year : {1991, 1995, 2002, 2019}) {
      const bool old = year == 1991 && first.starts_with("IESNA91");
      if (old || first == text("IESNA:LM-63-", year) || first == text("IES:LM-63-", year)) edition_ = year;
    }
    if (edition_ != 0) return;
    if (first.starts_with("IES")) {
      edition_ = first.find("-19") != std::string_view::npos ? 1995 : 2019;
      warn(text("the edition \"", std::string(first.substr(0, 40)), "\" is not known; it is read as LM-63-",
                edition_));
    } else {
      edition_ = 1986;  // which has no line of its own
    }
  }

  void read_keywords(std::size_t end) {
    if (edition_ == 1986) {
      for (std::size_t i = 0; i < end && file_.luminaire.empty(); ++i)
        file_.luminaire = plain_text(lines_[i].words);
      if (!file_.luminaire.starts_with('[')) return;
      file_.luminaire.clear();
    }
    for (std::size_t i = 0; i < end; ++i) {
      const std::string_view line = lines_[i].words;
      const std::size_t close = line.find(']');
      if (!line.starts_with('[') || close == std::string_view::npos) continue;
      const std::string_view key = line.substr(1, close - 1);
      const std::string value = plain_text(line.substr(close + 1));
      if (key == "MANUFAC" && file_.maker.empty()) file_.maker = value;
      if (key == "LUMINAIRE" && file_.luminaire.empty()) file_.luminaire = value;
      if (key == "LUMCAT" && file_.catalogue.empty()) file_.catalogue = value;
      if (key == "LAMP" && file_.lamp.empty()) file_.lamp = value;
    }
  }

  void read_tilt(const std::string& value, std::size_t line, Numbers& numbers) {
    if (value == "NONE") return;
    if (value == "INCLUDE") return read_tilt_table(numbers);
    if (value.empty()) fail_at(where_, line, "TILT= must be NONE, INCLUDE or the name of a file");
    if (!beside_)
      fail_at(where_, line,
              text("TILT= names the file \"", value, "\", which cannot be read here; include its lines"));
    const std::string bytes = beside_(value), where = text(where_, ": TILT=", value);
    const std::vector<PhotometricLine> lines = photometric_lines(bytes);
    Numbers of_file(lines, 0, where);
    read_tilt_table(of_file);
  }

  void read_tilt_table(Numbers& numbers) {
    const std::size_t geometry = numbers.whole("the lamp-to-luminaire geometry", 0);
    if (geometry < 1 || geometry > 3)
      fail_at(where_, numbers.last_line(),
              text("the lamp-to-luminaire geometry is ", geometry, "; it must be 1, 2 or 3"));
    const std::size_t n = numbers.whole("the number of tilt angles", 1);
    const std::vector<double> deg = numbers.list(n, "tilt angle");
    numbers.require_ascending(deg, "tilt");
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = numbers.next(text("tilt factor ", i + 1, " of ", n));
      if (!(factor >= 0 && factor <= 1e6))
        fail_at(where_, numbers.last_line(), text("a tilt factor is ", factor));
      file_.tilt.factor_at_deg.emplace_back(deg[i], factor);
    }
  }

  /// Do angles begin here, which ascend from one of the first angles that LM-63 allows?
  static bool are_angles(const std::vector<std::pair<double, std::size_t>>& all, std::size_t at,
                         std::size_t n) {
    const double first = all[at].first;
    if (first != 0 && first != 90 && first != -90) return false;
    for (std::size_t i = 1; i < n; ++i)
      if (!(all[at + i].first > all[at + i - 1].first)) return false;
    return all[at + n - 1].first <= 360;
  }

  /// Some makers leave out the line of the ballast, or a length of the opening: the numbers after it would
  /// be taken for others. The counts of angles tell how many numbers there should be.
  void require_all_before_angles(const Numbers& numbers) const {
    constexpr std::size_t kBefore = 13, kCounts = 5;  // numbers before the angles; up to the counts of these
    const std::vector<std::pair<double, std::size_t>> all = numbers.rest();
    if (all.size() < kBefore) return;
    const double v = all[3].first, h = all[4].first, needed = kBefore + v + h + v * h;
    const double missing = needed - static_cast<double>(all.size());
    if (!(v >= 2 && h >= 1 && missing >= 1 && missing <= kBefore - kCounts) || missing != std::floor(missing))
      return;
    const auto n = static_cast<std::size_t>(missing);
    const auto vertical = static_cast<std::size_t>(v), horizontal = static_cast<std::size_t>(h);
    const std::size_t begin = kBefore - n;
    if (are_angles(all, kBefore, vertical) || !are_angles(all, begin, vertical) ||
        !are_angles(all, begin + vertical, horizontal))
      return;
    const char* which = n == 3 ? "ballast factor, ballast-lamp factor and input watts"
                               : "there must be 13, the last of them ballast factor, ballast-lamp factor "
                                 "and input watts";
    fail_at(where_, all[begin].second,
            text(n, n == 1 ? " number is" : " numbers are", " missing before the angles: ", which, "; ",
                 kAskTheMaker));
  }

  void read_lamps(Numbers& numbers) {
    require_all_before_angles(numbers);
    const double lamps = numbers.next("the number of lamps"), lm = numbers.next("the lumens per lamp");
    factor_ = numbers.next("the candela multiplier");
    if (!(factor_ > 0))
      fail_at(where_, numbers.last_line(),
              text("the candela multiplier is ", factor_, "; it must be above 0"));
    verticals_ = numbers.whole("the number of vertical angles", 2);
    horizontals_ = numbers.whole("the number of horizontal angles", 1);
    type_ = numbers.whole("the photometric type", 1);
    if (type_ > 3)
      fail_at(where_, numbers.last_line(),
              text("the photometric type is ", type_, "; it must be 1 (C), 2 (B) or 3 (A)"));
    const std::size_t unit = numbers.whole("the unit of lengths", 1);
    if (unit > 2)
      fail_at(where_, numbers.last_line(),
              text("the unit of lengths is ", unit, "; it must be 1 (feet) or 2 (metres)"));
    DVec3 size;
    for (int c = 0; c < 3; ++c) {
      constexpr const char* kSizes[] = {"the width of the opening", "its length", "its height"};
      size[c] = numbers.next(kSizes[c]) * (unit == 1 ? kFoot_m : 1);
      if (!(std::fabs(size[c]) <= 1e6))
        fail_at(where_, numbers.last_line(), "the opening is larger than 1e6 m");
    }
    file_.opening = lm63_opening(size, edition_ >= 2002);
    if (file_.opening.form == LuminousOpening::Form::point && size != DVec3(0))
      warn(text("the opening ", size.x, " x ", size.y, " x ", size.z,
                " m is no shape of LM-63 with an area: it is taken as a point"));
    read_factors(numbers);
    file_.watts = std::max(0.0, numbers.next("the input watts"));
    file_.absolute = lm < 0;
    if (lm < 0 && lm != -1)
      warn(text("the lumens per lamp are ", lm, "; absolute photometry is -1, which is taken"));
    if (!file_.absolute) file_.lamp_lm = std::max(0.0, lamps) * lm;
    if (!std::isfinite(file_.lamp_lm))
      fail_at(where_, numbers.last_line(), "the lumens of the lamps are beyond the range of numbers");
    file_.format = text("LM-63-", edition_, ", type ", "CBA"[type_ - 1]);
  }

  /// Ballast factor, and a number that was the ballast-lamp photometric factor until 1991, then unused, since
  /// 2019 the kind of measurement, coded close to 1.
  void read_factors(Numbers& numbers) {
    const double ballast = numbers.next("the ballast factor");
    if (!(ballast > 0))
      fail_at(where_, numbers.last_line(), text("the ballast factor is ", ballast, "; it must be above 0"));
    const double second = numbers.next("the ballast-lamp factor");
    factor_ *= ballast;
    if (edition_ <= 1991) {
      if (!(second > 0))
        fail_at(where_, numbers.last_line(),
                text("the ballast-lamp factor is ", second, "; it must be above 0"));
      factor_ *= second;
    } else if (second != 1 && edition_ < 2019) {
      warn(text("the number after the ballast factor is ", second, "; LM-63-", edition_,
                " has no use for it: it is ignored"));
    }
    if (!std::isfinite(factor_))
      fail_at(where_, numbers.last_line(), "the factors are beyond the range of numbers");
  }

  void read_angles(Numbers& numbers) {
    vertical_deg_ = numbers.list(verticals_, "vertical angle");
    numbers.require_ascending(vertical_deg_, "vertical");
    const double least = type_ == 1 ? 0 : -90, most = type_ == 1 ? 180 : 90;
    if (vertical_deg_.front() < least || vertical_deg_.back() > most)
      fail_at(where_, numbers.last_line(),
              text("vertical angles run from ", vertical_deg_.front(), " to ", vertical_deg_.back(),
                   "; of type ", "CBA"[type_ - 1], " they lie between ", least, " and ", most));
    horizontal_deg_ = numbers.list(horizontals_, "horizontal angle");
    numbers.require_ascending(horizontal_deg_, "horizontal");
    angles_line_ = numbers.last_line();
  }

  void read_candela(Numbers& numbers) {
    CandelaList list;
    for (std::size_t h = 0; h < horizontals_; ++h) {
      for (std::size_t v = 0; v < verticals_; ++v) {
        list.cd.push_back(
            numbers.next(text("intensity ", v + 1, " of horizontal angle ", horizontal_deg_[h])));
        list.line.push_back(numbers.last_line());
      }
    }
    if (!numbers.done()) {
      double extra = 0;
      const std::string_view w = numbers.word();
      if (photometric_number(w, extra))
        fail_at(where_, numbers.last_line(),
                text("holds more numbers than its ", verticals_, " x ", horizontals_,
                     " angles need; the counts are wrong, or decimals are written with commas"));
      warn(text("line ", numbers.last_line(),
                " and what follows the intensities are no numbers: they are ignored"));
    }
    const std::vector<float> cd = list.finish(factor_, where_, file_.warnings);
    file_.photometry = std::make_shared<const Photometry>(type_ == 1 ? grid_c(cd) : grid_ab(cd));
  }

  std::vector<float> rows(const Planes& planes, const std::vector<float>& cd) const {
    std::vector<float> out;
    for (const std::size_t r : planes.row) {
      const auto from = cd.begin() + static_cast<std::ptrdiff_t>(r * verticals_);
      out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(verticals_));
    }
    return out;
  }

  [[noreturn]] void fail_range(const char* allowed) const {
    fail_at(where_, angles_line_,
            text("horizontal angles run from ", horizontal_deg_.front(), " to ", horizontal_deg_.back(), "; ",
                 allowed));
  }

  /// By the range of horizontal angles: 0: the same all around; 0 to 90: a quarter; 0 to 180, or 90 to 270:
  /// a half; 0 to 360: all.
  PhotometricGrid grid_c(const std::vector<float>& cd) {
    PhotometricGrid grid;
    grid.polar_deg = vertical_deg_;
    Planes planes;
    for (std::size_t i = 0; i < horizontals_; ++i)
      planes.azimuth_deg.push_back(horizontal_deg_[i]), planes.row.push_back(i);
    const double first = horizontal_deg_.front(), last = horizontal_deg_.back();
    if (horizontals_ == 1) {
      if (first != 0)
        warn(text("the only horizontal angle is ", first,
                  ", not 0: the light is taken to be the same all around"));
      planes = {{0, 360}, {0, 0}};
    } else if (first == 90 && last == 270) {
      planes.mirror_at_end();
    } else if (first != 0) {
      fail_range("type C needs them to begin at 0, or to run from 90 to 270");
    } else if (last == 90) {
      planes.mirror_at_end(), planes.mirror_at_end();
    } else if (last == 180) {
      planes.mirror_at_end();
    } else if (last != 360) {
      double step = 0;
      for (std::size_t i = 1; i < horizontals_; ++i)
        step = std::max(step, horizontal_deg_[i] - horizontal_deg_[i - 1]);
      if (!(last > 180 && 360 - last >= kLeastStep_deg && 360 - last <= 1.5 * step))
        fail_range("type C needs them to end at exactly 0, 90, 180 or 360");
      warn(text("horizontal angles end at ", last, ": the plane at 360 is taken to be that at 0"));
      planes.azimuth_deg.push_back(360), planes.row.push_back(0);
    }
    grid.azimuth_deg = planes.azimuth_deg;
    grid.candela = rows(planes, cd);
    return grid;
  }

  /// Type A and B: horizontal angles from -90 to 90, or from 0 on with the other side alike.
  PhotometricGrid grid_ab(const std::vector<float>& cd) {
    if (horizontals_ < 2)
      fail_at(where_, angles_line_, "photometry of type A or B needs two horizontal angles at least");
    const double limit = type_ == 2 ? 90 : 180;
    if (horizontal_deg_.front() < -limit || horizontal_deg_.back() > limit)
      fail_range(text("they must lie between ", -limit, " and ", limit).c_str());
    Planes planes;
    if (horizontal_deg_.front() == 0) {
      for (std::size_t i = horizontals_; i-- > 1;)
        planes.azimuth_deg.push_back(-horizontal_deg_[i]), planes.row.push_back(i);
    }
    for (std::size_t i = 0; i < horizontals_; ++i)
      planes.azimuth_deg.push_back(horizontal_deg_[i]), planes.row.push_back(i);
    PhotometricGrid grid;
    std::vector<double> vertical = vertical_deg_;
    const std::vector<float> all = rows(planes, cd);
    if (type_ == 3) {
      grid.poles = PhotometricGrid::Poles::a;
      grid.azimuth_deg = planes.azimuth_deg;
      for (const double v : vertical) grid.polar_deg.push_back(90 + v);
      grid.candela = all;
      return grid;
    }
    // The poles of type B lie on the horizontal axis: vertical angles run about it.
    grid.poles = PhotometricGrid::Poles::b;
    grid.azimuth_deg = vertical;
    for (const double h : planes.azimuth_deg) grid.polar_deg.push_back(90 + h);
    for (std::size_t v = 0; v < verticals_; ++v)
      for (std::size_t h = 0; h < planes.row.size(); ++h) grid.candela.push_back(all[h * verticals_ + v]);
    return grid;
  }

  std::vector<PhotometricLine> lines_;
  const std::string& where_;
  const ReadBeside& beside_;
  PhotometricFile file_;
  int edition_ = 0;
  double factor_ = 1;
  std::size_t verticals_ = 0, horizontals_ = 0, type_ = 1, angles_line_ = 1;
  std::vector<double> vertical_deg_, horizontal_deg_;
};

}  // namespace

PhotometricFile parse_ies(std::string_view bytes, const std::string& where, const ReadBeside& beside) {
  return Reader(bytes, where, beside).read();
}

std::string ies_tilt_file(std::string_view bytes) {
  const std::vector<PhotometricLine> lines = photometric_lines(bytes);
  const std::optional<std::size_t> tilt = tilt_line(lines);
  if (!tilt) return {};
  const std::string value = tilt_value(lines[*tilt].words);
  return value == "NONE" || value == "INCLUDE" ? "" : value;
}

}  // namespace phos::inline scene
