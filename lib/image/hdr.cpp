#include "image/hdr.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "image/primaries.h"

namespace phos::inline image {

namespace {

/// Radiance's luminous efficacy of its standard white, lm/W (Radiance color.h, WHTEFFICACY).
constexpr float kLumensPerWatt = 179;

using Rgbe = std::array<std::uint8_t, 4>;

[[noreturn]] void damaged(const std::string& where, const std::string& why) {
  throw Error(ExitCode::bad_input, where,
              "damaged or truncated Radiance .hdr file (" + why + "); make it again");
}

/// The bytes still to be read.
class Cursor {
 public:
  Cursor(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}
  std::uint8_t byte() {
    if (at_ >= bytes_.size()) damaged(where_, "the file ends too early");
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }
  Rgbe pixel() {
    Rgbe p;
    for (std::uint8_t& b : p) b = byte();
    return p;
  }
  std::string_view line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) damaged(where_, "the header has no end");
    std::string_view s = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (s.ends_with('\r')) s.remove_suffix(1);
    return s;
  }
  /// The next four bytes are not consumed; zeros past the end.
  Rgbe peek() const {
    Rgbe p{};
    for (std::size_t i = 0; i < 4 && at_ + i < bytes_.size(); ++i)
      p[i] = static_cast<std::uint8_t>(bytes_[at_ + i]);
    return p;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  const std::string& where() const { return where_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  const std::string& where_;
};

struct HdrHeader {
  double exposure = 1;
  glm::dvec3 correction{1};
  Primaries primaries = kRadiance;
  bool xyz = false;
  std::map<std::string, std::string> attributes;
};

std::vector<double> numbers(std::string_view s) {
  const std::string copy(s);
  std::vector<double> values;
  for (const char* p = copy.c_str();;) {
    char* end = nullptr;
    const double v = std::strtod(p, &end);
    if (end == p) return values;
    values.push_back(v);
    p = end;
  }
}

void read_exposure(HdrHeader& h, std::string_view value, const std::string& where) {
  const std::vector<double> v = numbers(value);
  if (v.empty() || !(v[0] > 0) || !std::isfinite(v[0])) damaged(where, "EXPOSURE is not a positive number");
  h.exposure *= v[0];
}

void read_correction(HdrHeader& h, std::string_view value, const std::string& where) {
  const std::vector<double> v = numbers(value);
  if (v.size() < 3) damaged(where, "COLORCORR is not three numbers");
  for (int i = 0; i < 3; ++i) {
    const double c = v[static_cast<std::size_t>(i)];
    if (!(c > 0) || !std::isfinite(c)) damaged(where, "COLORCORR is not positive");
    h.correction[i] *= c;
  }
}

void read_primaries(HdrHeader& h, std::string_view value, const std::string& where) {
  const std::vector<double> v = numbers(value);
  if (v.size() < 8) damaged(where, "PRIMARIES is not eight numbers");
  const auto xy = [&](std::size_t i) { return Vec2(glm::dvec2(v[i], v[i + 1])); };
  const Primaries given{xy(0), xy(2), xy(4), xy(6)};
  if (given.not_given()) return;
  h.primaries = given;
  if (!is_valid(h.primaries)) damaged(where, "PRIMARIES is not a colour space");
}

void read_format(HdrHeader& h, std::string_view value, const std::string& where) {
  while (value.ends_with(' ') || value.ends_with('\t')) value.remove_suffix(1);
  h.xyz = value == "32-bit_rle_xyze";
  if (!h.xyz && value != "32-bit_rle_rgbe")
    throw Error(ExitCode::bad_input, where,
                text("has the FORMAT \"", value,
                     "\", which phos does not read; convert it to 32-bit_rle_rgbe or 32-bit_rle_xyze"));
}

/// Header lines are NAME=value; a line that starts with a blank or has no '=' is a remark (Radiance,
/// filefmts.pdf).
HdrHeader read_header(Cursor& in) {
  HdrHeader h;
  if (!in.line().starts_with("#?")) damaged(in.where(), "the first line is not #?RADIANCE");
  for (std::string_view s = in.line(); !s.empty(); s = in.line()) {
    const std::size_t equals = s.find('=');
    if (equals == std::string_view::npos || equals == 0 || s[0] == '\t' || s[0] == ' ' || s[0] == '#')
      continue;
    const std::string name(s.substr(0, equals));
    const std::string_view value = s.substr(std::min(s.size(), s.find_first_not_of(' ', equals + 1)));
    if (name == "EXPOSURE") {
      read_exposure(h, value, in.where());
    } else if (name == "COLORCORR") {
      read_correction(h, value, in.where());
    } else if (name == "PRIMARIES") {
      read_primaries(h, value, in.where());
    } else if (name == "FORMAT") {
      read_format(h, value, in.where());
    } else {
      h.attributes[name] = value;
    }
  }
  return h;
}

/// "-Y 768 +X 512": the order in which pixels are stored. Positive Y is up, positive X to the right.
struct Order {
  int width = 0, height = 0;
  bool rows = true, y_down = true, x_right = true;
  std::size_t scans() const { return static_cast<std::size_t>(rows ? height : width); }
  std::size_t length() const { return static_cast<std::size_t>(rows ? width : height); }
  std::size_t index(std::size_t scan, std::size_t i) const {
    const std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    const std::size_t x = rows ? i : scan, y = rows ? scan : i;
    return (y_down ? y : h - 1 - y) * w + (x_right ? x : w - 1 - x);
  }
};

Order read_order(Cursor& in) {
  const std::string s(in.line());
  char sign[2]{}, axis[2]{};
  int count[2]{};
  if (std::sscanf(s.c_str(), "%c%c %9d %c%c %9d", &sign[0], &axis[0], &count[0], &sign[1], &axis[1],
                  &count[1]) != 6)
    damaged(in.where(), "the line with the picture's size is missing");
  Order o;
  o.rows = axis[0] == 'Y';
  if (axis[o.rows ? 0 : 1] != 'Y' || axis[o.rows ? 1 : 0] != 'X')
    damaged(in.where(), "the picture has no X or no Y");
  for (const char c : sign)
    if (c != '+' && c != '-') damaged(in.where(), "an axis has no sign");
  o.height = count[o.rows ? 0 : 1], o.width = count[o.rows ? 1 : 0];
  o.y_down = sign[o.rows ? 0 : 1] == '-', o.x_right = sign[o.rows ? 1 : 0] == '+';
  // Run lengths reach 16 pixels a byte in whole pictures; the rest is room for old, shifted runs.
  if (o.width < 1 || o.height < 1 ||
      std::uint64_t(o.width) * std::uint64_t(o.height) > (1u << 20) + 64 * std::uint64_t{in.left()})
    damaged(in.where(), text("too short for ", o.width, " x ", o.height, " pixels"));
  return o;
}

/// Each component by itself: a count above 128 repeats one value, else so many values follow.
void read_new_runs(Cursor& in, std::vector<Rgbe>& scan) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t i = 0; i < scan.size();) {
      std::size_t count = in.byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > scan.size() - i) damaged(in.where(), "a run is longer than its row");
      const std::uint8_t value = run ? in.byte() : std::uint8_t{0};
      for (const std::size_t end = i + count; i < end; ++i) scan[i][component] = run ? value : in.byte();
    }
  }
}

/// Flat pixels; (1,1,1,n) repeats the one before n times, and next to another such one n * 256 times, and so
/// on.
void read_old_runs(Cursor& in, std::vector<Rgbe>& scan) {
  unsigned shift = 0;
  for (std::size_t i = 0; i < scan.size();) {
    const Rgbe p = in.pixel();
    if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
      scan[i++] = p;
      shift = 0;
      continue;
    }
    if (shift > 24) damaged(in.where(), "a run is longer than its row");
    const std::size_t count = std::size_t{p[3]} << shift;
    if (i == 0 || count > scan.size() - i) damaged(in.where(), "a run is longer than its row");
    for (const std::size_t end = i + count; i < end; ++i) scan[i] = scan[i - 1];
    shift += 8;
  }
}

void read_scan(Cursor& in, std::vector<Rgbe>& scan) {
  const Rgbe start = in.peek();
  const bool is_new =
      scan.size() >= 8 && scan.size() <= 0x7fff && start[0] == 2 && start[1] == 2 && start[2] < 128;
  if (!is_new) return read_old_runs(in, scan);
  in.pixel();
  if (((std::size_t{start[2]} << 8) | start[3]) != scan.size())
    damaged(in.where(), "a row of another length");
  read_new_runs(in, scan);
}

/// Mantissas are truncated when written, so half a step is added (Ward 1991).
glm::dvec3 decode(const Rgbe& p) {
  if (p[3] == 0) return glm::dvec3(0);
  return std::ldexp(1.0, p[3] - 136) * (glm::dvec3(p[0], p[1], p[2]) + 0.5);
}

Rgbe encode(Rgb c) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(c[i]) || c[i] < 0) c[i] = 0;
  const float largest = max_component(c);
  if (largest < 1e-32f) return {};
  int exponent = 0;
  const float mantissa = std::frexp(largest, &exponent);
  if (exponent > 127) return {255, 255, 255, 255};
  const float scale = mantissa * 256 / largest;
  Rgbe p;
  for (int i = 0; i < 3; ++i)
    p[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::fmin(c[i] * scale, 255.0f));
  p[3] = static_cast<std::uint8_t>(exponent + 128);
  return p;
}

void write_component(const std::vector<Rgbe>& scan, std::size_t component, std::string& out) {
  constexpr std::size_t kShortestRun = 4, kLongest = 127;
  const auto run_at = [&](std::size_t i) {
    std::size_t n = 1;
    while (n < kLongest && i + n < scan.size() && scan[i + n][component] == scan[i][component]) ++n;
    return n;
  };
  for (std::size_t i = 0; i < scan.size();) {
    std::size_t run = run_at(i);
    if (run >= kShortestRun) {
      out += static_cast<char>(128 + run);
      out += static_cast<char>(scan[i][component]);
      i += run;
      continue;
    }
    std::size_t count = 0;
    while (i + count < scan.size() && count < kLongest && (run = run_at(i + count)) < kShortestRun)
      count = std::min(count + run, kLongest);
    out += static_cast<char>(count);
    for (const std::size_t end = i + count; i < end; ++i) out += static_cast<char>(scan[i][component]);
  }
}

void write_scan(const std::vector<Rgbe>& scan, std::string& out) {
  if (scan.size() < 8 || scan.size() > 0x7fff) {
    for (const Rgbe& p : scan) out.append(reinterpret_cast<const char*>(p.data()), 4);
    return;
  }
  out += '\2', out += '\2';
  out += static_cast<char>(scan.size() >> 8), out += static_cast<char>(scan.size() & 255);
  for (std::size_t component = 0; component < 4; ++component) write_component(scan, component, out);
}

bool is_header_line(const std::string& name, const std::string& value) {
  for (const char* with_meaning : {"FORMAT", "EXPOSURE", "COLORCORR", "PRIMARIES"})
    if (name == with_meaning) return false;
  return !name.empty() && name.find_first_of("=\n \t#") == std::string::npos &&
         value.find('\n') == std::string::npos;
}

}  // namespace

Image decode_hdr(std::string_view bytes, const std::string& where) {
  Cursor in(bytes, where);
  const HdrHeader header = read_header(in);
  const Order order = read_order(in);
  // XYZE is photometric already; its white is Radiance's equal-energy one.
  const double scale = (header.xyz ? 1.0 : double{kLumensPerWatt}) / header.exposure;
  Mat3 colour = convert_primaries(header.primaries, kRec709);
  if (header.xyz) colour = convert_primaries(kRadiance, kRec709) * glm::inverse(rgb_to_xyz(kRadiance));
  const glm::dmat3 m(colour);
  std::vector<Rgb> pixels(static_cast<std::size_t>(order.width) * static_cast<std::size_t>(order.height));
  std::vector<Rgbe> scan(order.length());
  for (std::size_t s = 0; s < order.scans(); ++s) {
    read_scan(in, scan);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Rgb value(scale * (m * (decode(scan[i]) / header.correction)));
      if (!is_finite(value)) damaged(where, "EXPOSURE makes the light infinite");
      pixels[order.index(s, i)] = value;
    }
  }
  Image image(order.width, order.height);
  image.set_rgb("", pixels);
  image.attributes = header.attributes;
  return image;
}

std::string encode_hdr(const Image& image) {
  PHOS_CHECK(image.pixels() > 0 && image.has_layer(""), image.width(), " x ", image.height());
  std::string out = "#?RADIANCE\n";
  for (const auto& [name, value] : image.attributes)
    if (is_header_line(name, value)) out += text(name, "= ", value, "\n");
  out += text("FORMAT=32-bit_rle_rgbe\n\n-Y ", image.height(), " +X ", image.width(), "\n");
  const Mat3 m = (1 / kLumensPerWatt) * convert_primaries(kRec709, kRadiance);
  const std::vector<Rgb> pixels = image.rgb("");
  std::vector<Rgbe> scan(static_cast<std::size_t>(image.width()));
  for (std::size_t begin = 0; begin < pixels.size(); begin += scan.size()) {
    for (std::size_t x = 0; x < scan.size(); ++x) scan[x] = encode(m * pixels[begin + x]);
    write_scan(scan, out);
  }
  return out;
}

}  // namespace phos::inline image
