#include "scene/report/describe_text.h"

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "core/vector.h"

namespace phos::inline scene {
namespace {

/// Four significant digits: for people.
std::string figure(const Json& v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", v.is_number() ? v.as_number() : 0.0);
  return buffer;
}

std::string triple(const Json& v) {
  std::string out;
  for (const Json& item : v.as_array()) {
    if (!out.empty()) out += ' ';
    out += figure(item);
  }
  return out;
}

std::string padded(std::string s, std::size_t width) {
  // Counts characters, not bytes, so that names in other scripts line up too.
  std::size_t n = 0;
  for (const char c : s) n += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  if (n < width) s.append(width - n, ' ');
  return s;
}

/// A place; all digits where it lies too far from the world's origin for four to tell it from others.
std::string place(const Json& v, bool far) {
  if (!far) return triple(v);
  std::string out;
  for (const Json& item : v.as_array()) out += text(out.empty() ? "" : " ", shortest(item.as_number()));
  return out;
}

const Json& at(const Json& json, const char* key) {
  static const Json kNull;
  const Json* v = json.find(key);
  return v ? *v : kNull;
}

std::string light_line(const Json& l) {
  std::string line = text("  ", padded(at(l, "name").as_string(), 24), " ",
                          padded(at(l, "kind").as_string(), 12), figure(at(l, "lumens")), " lm");
  if (const Json* area = l.find("area_m2")) {
    line += text(", ", figure(*area), " m2, ", triple(at(l, "luminance_cd_m2")), " cd/m2");
    if (at(l, "two_sided").as_bool()) line += ", both sides";
  }
  if (const Json* cd = l.find("intensity_cd")) line += text(", ", triple(*cd), " cd");
  if (const Json* mean = l.find("mean_luminance_cd_m2")) {
    line += text(", ", at(l, "size").as_array()[0].as_integer(), " x ",
                 at(l, "size").as_array()[1].as_integer(), ", mean ", triple(*mean), " cd/m2, ",
                 triple(at(l, "horizontal_illuminance_lx")), " lx on open ground",
                 l.find("sun_illuminance_lx")
                     ? text("; sun ", triple(at(l, "sun_illuminance_lx")), " lx facing it")
                     : "");
    if (const Json* portals = l.find("portals"))
      line += text("; let in through openings of ", figure(at(l, "portals_m2")), " m2 in ",
                   portals->as_integer(), portals->as_integer() == 1 ? " piece" : " pieces");
  }
  if (const Json* lx = l.find("illuminance_lx")) line += text(", ", triple(*lx), " lx");
  if (const Json* luminaire = l.find("luminaire")) {
    line += text(", ", at(*luminaire, "format").as_string());
    if (const std::string& name = at(*luminaire, "luminaire").as_string(); !name.empty())
      line += " \"" + name + '"';
    line += text(", opening: ", at(*luminaire, "opening").as_string());
  }
  line += '\n';
  return line;
}

/// Luminance of the light that passes: straight along the normal, or scattered.
std::string passes(const Json& m) {
  std::string all;
  for (const auto& [key, how] : {std::pair{"transmittance", ""}, {"diffuse_transmittance", " scattered"}}) {
    const Json* share = m.find(key);
    if (!share) continue;
    const Json::Array& c = share->as_array();
    const auto of = [&](std::size_t i) { return static_cast<float>(c[i].as_number()); };
    all += text(", passes ", figure(Json(static_cast<double>(luminance(Rgb(of(0), of(1), of(2)))))), how);
  }
  return all;
}

std::string material_line(const Json& m) {
  std::string line =
      text("  ", padded(at(m, "name").as_string(), 24), " ", padded(at(m, "model").as_string(), 20),
           "reflects ", figure(at(m, "reflectance")), passes(m), ", ", figure(at(m, "area_m2")), " m2, ",
           at(m, "triangles").as_integer(), " triangles");
  for (const Json& t : at(m, "textures").as_array()) line += text(", ", t.as_string(), " texture");
  line += '\n';
  return line;
}

std::string camera_line(const Json& c, bool far) {
  std::string line = text("  ", padded(at(c, "name").as_string(), 24), " ",
                          padded(at(c, "kind").as_string(), 12), " eye ", place(at(c, "eye_m"), far));
  if (const Json* yfov = c.find("yfov_deg")) line += text(", ", figure(*yfov), " deg high");
  line += text(", aspect ", figure(at(c, "aspect")), "\n");
  return line;
}

/// The first few of them.
std::string moving_values(const Json::Array& targets) {
  constexpr std::size_t kShown = 3;
  std::string out;
  for (std::size_t i = 0; i < std::min(kShown, targets.size()); ++i)
    out.append(i > 0 ? ", " : "").append(targets[i].as_string());
  if (targets.size() > kShown) out += text(" and ", targets.size() - kShown, " more");
  return out;
}

std::string animation_line(const Json& a) {
  return text("  ", padded(at(a, "name").as_string(), 24), " ", figure(at(a, "start_s")), " to ",
              figure(at(a, "end_s")), " s, moves ", moving_values(at(a, "targets").as_array()), "\n");
}

std::string requirement_line(const Json& r) {
  return text("  ", padded(at(r, "what").as_string(), 24), " ", at(r, "why").as_string(), "\n");
}

std::string finding_line(const Json& f) {
  return text("  ", at(f, "level").as_string(), " [", at(f, "code").as_string(), "] ",
              at(f, "message").as_string(), "\n      ", at(f, "mend").as_string(), "\n");
}

template <class Line>
std::string list(const Json& json, const char* key, const std::string& title, const Line& line) {
  const Json::Array& items = at(json, key).as_array();
  std::string out = text("\n", title, " (", items.size(), ")\n");
  for (const Json& item : items) out += line(item);
  return out;
}

}  // namespace

std::string describe_text(const Json& d) {
  const Json::Array& bounds = at(d, "bounds_m").as_array();
  std::string out = text(at(d, "path").as_string(), "\n  ", at(d, "triangles").as_integer(), " triangles, ",
                         at(d, "vertices").as_integer(), " vertices, ", at(d, "instances").as_integer(),
                         " instances, ", figure(at(d, "memory_bytes").as_number() / 1048576.0), " MiB\n");
  const bool far = d.find("origin_m") != nullptr;
  out += text("  from ", place(bounds[0], far), " to ", place(bounds[1], far), " m, ",
              figure(at(d, "diagonal_m")), " m across, ", figure(at(d, "surface_m2")), " m2 of surface\n");
  if (far) out += text("  positions in files are counted from ", place(at(d, "origin_m"), far), " m\n");
  out += text("  hash ", at(d, "hash").as_string(), "\n");
  if (const Json* bands = d.find("bands"))
    out += text("  light of ", figure(at(*bands, "from_nm")), " to ", figure(at(*bands, "to_nm")),
                " nm alone: triplet ", at(*bands, "triplet").as_integer(), " of ",
                at(*bands, "number").as_integer(), " bands\n");
  out += list(d, "lights", text("Lights, ", figure(at(d, "total_lumens")), " lm together"), light_line);
  out += list(d, "materials", "Materials", material_line);
  out += list(d, "cameras", "Cameras", [&](const Json& c) { return camera_line(c, far); });
  if (!at(d, "animations").as_array().empty()) {
    out += list(d, "animations",
                text("Animations, frames 0:", std::max<std::int64_t>(at(d, "frames").as_integer(), 1) - 1,
                     " at ", figure(at(d, "frames_per_s")), " per second"),
                animation_line);
  }
  out += list(d, "requires", "Requires", requirement_line);
  out += list(d, "lint", "Findings", finding_line);
  return out;
}

}  // namespace phos::inline scene
