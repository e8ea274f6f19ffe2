// EULUMDAT (Stockmar 1990): one value to a line, in a fixed order.
#include "scene/luminaire/eulumdat.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/limits.h"
#include "scene/luminaire/photometric_lines.h"

namespace phos::inline scene {
namespace {

/// The table and the file's own figures may differ by so much before a warning: efficiency and downward
/// share, both in percent.
constexpr double kTold_percent = 5;
constexpr double kMillimetre_m = 1e-3;

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where)
      : lines_(photometric_lines(bytes)), where_(where) {}

  PhotometricFile read() {
    file_.format = "EULUMDAT";
    file_.maker = words("the company");
    whole("the type of luminaire", 0, 3);
    symmetry_ = whole("the symmetry", 0, 4);
    planes_ = whole("the number of C-planes", 1, kMostAngles);
    words("the distance between C-planes");
    gammas_ = whole("the number of intensities in a plane", 2, kMostAngles);
    words("the distance between intensities");
    words("the report number");
    file_.luminaire = words("the name of the luminaire");
    file_.catalogue = words("the number of the luminaire");
    words("the name of the file");
    words("the date");
    read_sizes();
    const double down_percent = number("the downward flux fraction"),
                 output_percent = number("the light output ratio");
    factor_ = number("the conversion factor");
    if (!(factor_ > 0)) fail(text("the conversion factor is ", factor_, "; it must be above 0"));
    if (const double tilt = number("the tilt during measurement"); tilt != 0)
      warn(text("the luminaire was tilted by ", tilt,
                " deg when it was measured; its intensities are taken as they stand"));
    read_lamps();
    for (int k = 1; k <= 10; ++k) words("a direct ratio");
    c_deg_ = angles(planes_, "C");
    gamma_deg_ = angles(gammas_, "gamma");
    if (gamma_deg_.front() < 0 || gamma_deg_.back() > 180)
      fail(text("gamma runs from ", gamma_deg_.front(), " to ", gamma_deg_.back(),
                "; it lies between 0 and 180"));
    if (c_deg_.front() < 0 || c_deg_.back() > 360)
      fail(text("C runs from ", c_deg_.front(), " to ", c_deg_.back(), "; it lies between 0 and 360"));
    read_candela();
    if (comma_line_ > 0)
      warn(text("line ", comma_line_, " and others have decimal commas: they are read as points"));
    compare(down_percent, output_percent);
    return std::move(file_);
  }

 private:
  static constexpr auto kMostAngles = kMostPhotometryAngles.as<std::size_t>();

  void warn(const std::string& message) { file_.warnings.push_back(message); }
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(where_,
            lines_.empty() ? 1 : lines_[std::min(std::max<std::size_t>(at_, 1), lines_.size()) - 1].number,
            message);
  }

  std::string_view line(const std::string& what) {
    if (at_ >= lines_.size())
      fail(text("ends before ", what, "; the file is cut short, or its counts are wrong"));
    return lines_[at_++].words;
  }
  std::string words(const std::string& what) { return plain_text(line(what)); }

  /// 0 for an empty line: fields that a maker leaves out.
  double number(const std::string& what, bool may_be_empty = true) {
    std::string s(line(what));
    if (s.empty() && may_be_empty) return 0;
    const std::size_t comma = s.find(',');
    if (comma != std::string::npos && comma == s.rfind(',') && s.find('.') == std::string::npos) {
      s[comma] = '.';
      if (comma_line_ == 0) comma_line_ = lines_[at_ - 1].number;
    }
    double value = 0;
    if (!photometric_number(s, value))
      fail(text(what, " is \"", s.substr(0, 24), "\", which is no finite number"));
    return value;
  }

  std::size_t whole(const std::string& what, std::size_t least, std::size_t most) {
    const double v = number(what, false);
    if (!(v >= static_cast<double>(least) && v <= static_cast<double>(most) && v == std::floor(v)))
      fail(text(what, " is ", v, "; it must be a whole number from ", least, " to ", most));
    return static_cast<std::size_t>(v);
  }

  double length_m(const std::string& what) {
    const double mm = number(what);
    if (!(mm >= 0 && mm <= 1e9)) fail(text(what, " is ", mm, " mm"));
    return mm * kMillimetre_m;
  }

  void read_sizes() {
    for (const char* what : {"the length of the luminaire", "its width", "its height"}) number(what);
    const double length = length_m("the length of the luminous area"), width = length_m("its width");
    double height[4], sum = 0, most = 0;
    for (double& h : height) {
      h = length_m("a height of the luminous area");
      sum += h, most = std::max(most, h);
    }
    file_.opening = eulumdat_opening(length, width, 0.25 * sum);
    if (std::any_of(std::begin(height), std::end(height), [&](double h) { return h != most; }))
      warn(text("the luminous sides have different heights: their mean is used for all, ", 0.25 * sum, " m"));
  }

  /// Sets are the lamps that the luminaire may be equipped with. A negative number of lamps is absolute
  /// photometry.
  void read_lamps() {
    const std::size_t sets = whole("the number of lamp sets", 0, 1000);
    for (std::size_t k = 0; k < sets; ++k) {
      const double lamps = number("the number of lamps");
      const std::string type = words("the type of the lamps");
      const double lm = number("the lumens of the lamps");
      for (const char* what : {"the colour of the lamps", "their colour rendering"}) words(what);
      const double watts = number("their watts");
      if (k > 0) continue;
      file_.lamp = type, file_.watts = std::max(0.0, watts);
      file_.absolute = lamps < 0;
      file_.lamp_lm = lm;
      if (!(lm >= 0 && lm <= 1e30)) fail(text("the lumens of the lamps are ", lm));
    }
    if (sets > 1)
      warn(text("the luminaire may have ", sets, " sets of lamps: the first is taken (", file_.lamp_lm,
                " lm)"));
    if (!(file_.lamp_lm > 0))
      fail(
          "states no lumens of lamps, so that its intensities, in cd per 1000 lm, have no scale; enter them");
  }

  std::vector<double> angles(std::size_t n, const char* which) {
    std::vector<double> deg;
    for (std::size_t i = 0; i < n; ++i)
      deg.push_back(number(text("angle ", which, " ", i + 1, " of ", n), false));
    require_ascending(deg, which, where_, lines_[at_ - 1].number);
    return deg;
  }

  /// The planes that are there, from azimuths of which mirrors make the whole circle.
  Planes stored_planes() const {
    Planes planes;
    const auto add = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i <= last; ++i)
        planes.azimuth_deg.push_back(c_deg_[i % planes_]), planes.row.push_back(i - first);
    };
    const auto end_at = [&](double deg) {
      if (std::fabs(planes.azimuth_deg.back() - deg) > kLeastStep_deg)
        fail(text("of symmetry ", symmetry_, " the last plane is C", deg, ", not C",
                  planes.azimuth_deg.back()));
      planes.azimuth_deg.back() = deg;
    };
    const auto begin_at_0 = [&] {
      if (c_deg_.front() != 0) fail(text("the first plane is C", c_deg_.front(), ", not C0"));
    };
    switch (symmetry_) {
      case 1:
        return {{0, 360}, {0, 0}};
      case 2:
        begin_at_0(), add(0, planes_ / 2), end_at(180);
        return planes;
      case 3: {
        const std::size_t first = 3 * planes_ / 4;
        add(first, first + planes_ / 2);
        for (double& deg : planes.azimuth_deg) deg -= deg >= 270 ? 360 : 0;
        if (planes.azimuth_deg.front() != -90) fail("of symmetry 3 the first plane is C270");
        end_at(90);
        return planes;
      }
      case 4:
        begin_at_0(), add(0, planes_ / 4), end_at(90);
        return planes;
      default:
        begin_at_0(), add(0, planes_ - 1);
        if (360 - c_deg_.back() >= kLeastStep_deg) planes.azimuth_deg.push_back(360), planes.row.push_back(0);
        if (planes.azimuth_deg.back() != 360 || planes.azimuth_deg.size() < 2) fail("C must go all around");
        return planes;
    }
  }

  void read_candela() {
    Planes planes = stored_planes();
    const std::size_t stored = *std::max_element(planes.row.begin(), planes.row.end()) + 1;
    CandelaList list;
    for (std::size_t i = 0; i < stored; ++i) {
      for (std::size_t j = 0; j < gammas_; ++j) {
        list.cd.push_back(number(text("intensity ", j + 1, " of plane ", i + 1, " of ", stored), false));
        list.line.push_back(lines_[at_ - 1].number);
      }
    }
    for (; at_ < lines_.size(); ++at_) {
      if (lines_[at_].words.empty()) continue;
      double extra = 0;
      if (photometric_number(lines_[at_].words, extra)) {
        ++at_;
        fail(text("has more numbers than its ", stored, " x ", gammas_,
                  " intensities; counts or symmetry are wrong"));
      }
      warn(text("line ", lines_[at_].number,
                " and what follows the intensities are no numbers: they are ignored"));
      break;
    }
    if (symmetry_ == 3 || symmetry_ == 2 || symmetry_ == 4) planes.mirror_at_end();
    if (symmetry_ == 4) planes.mirror_at_end();
    PhotometricGrid grid;
    grid.azimuth_deg = planes.azimuth_deg, grid.polar_deg = gamma_deg_;
    const std::vector<float> cd = list.finish(factor_ * file_.lamp_lm / 1000, where_, file_.warnings);
    for (const std::size_t row : planes.row)
      for (std::size_t j = 0; j < gammas_; ++j) grid.candela.push_back(cd[row * gammas_ + j]);
    file_.photometry = std::make_shared<const Photometry>(grid);
  }

  void compare(double down_percent, double output_percent) {
    const Photometry& p = *file_.photometry;
    const double output = 100 * p.flux_lm() / (factor_ * file_.lamp_lm), down = 100 * p.downward_share();
    const auto tell = [&](const char* what, double stated, double found) {
      if (stated > 0 && std::fabs(stated - found) > kTold_percent)
        warn(text(what, " is stated as ", stated, " %, but the intensities give ",
                  std::round(10 * found) / 10, " %"));
    };
    tell("the light output ratio", output_percent, output);
    tell("the downward flux fraction", down_percent, down);
  }

  std::vector<PhotometricLine> lines_;
  const std::string& where_;
  PhotometricFile file_;
  std::size_t at_ = 0, comma_line_ = 0;
  std::size_t symmetry_ = 0, planes_ = 0, gammas_ = 0;
  double factor_ = 1;
  std::vector<double> c_deg_, gamma_deg_;
};

}  // namespace

PhotometricFile parse_eulumdat(std::string_view bytes, const std::string& where) {
  return Reader(bytes, where).read();
}

}  // namespace phos::inline scene
