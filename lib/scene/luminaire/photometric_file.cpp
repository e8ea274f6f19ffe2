#include "scene/luminaire/photometric_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/text/append_item.h"
#include "file/atomic_file.h"
#include "file/lfs_pointer.h"
#include "scene/gltf/uri.h"
#include "scene/luminaire/eulumdat.h"
#include "scene/luminaire/ies.h"
#include "scene/luminaire/photometric_lines.h"

namespace phos::inline scene {
namespace {

/// Of relative photometry, the share of the lamps' light that leaves the luminaire cannot be above 1 (by more
/// than rounding and the interpolation between angles make) and is hardly ever below this.
constexpr double kMostOutput = 1.05, kLeastOutput = 0.05;

/// Formats are told from so many bytes.
constexpr std::size_t kHead = std::size_t{1} << 16;

enum class Format { none, ies, eulumdat };

Format format_of(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kHead);
  if (head.find('\0') != std::string_view::npos) return Format::none;
  const std::vector<PhotometricLine> lines = photometric_lines(head);
  for (const PhotometricLine& line : lines)
    if (line.words.starts_with("TILT=") || line.words.starts_with("IESNA") ||
        line.words.starts_with("IES:LM-63"))
      return Format::ies;
  if (lines.size() < 8) return Format::none;
  // Type, symmetry, number of planes, their distance, and so on.
  for (std::size_t k = 1; k <= 5; ++k) {
    double value = 0;
    std::string word(lines[k].words);
    std::replace(word.begin(), word.end(), ',', '.');
    if (!photometric_number(word, value)) return Format::none;
  }
  return Format::eulumdat;
}

void check_lumens(PhotometricFile& file) {
  const double lm = file.photometry->flux_lm();
  if (!(lm > 0)) {
    file.warnings.emplace_back("all intensities are 0: the luminaire gives no light");
    return;
  }
  // EULUMDAT states the share, and its reader has compared it.
  if (file.absolute || !(file.lamp_lm > 0) || file.format == "EULUMDAT") return;
  const double share = lm / file.lamp_lm;
  if (share > kMostOutput || share < kLeastOutput)
    file.warnings.push_back(text(
        "the intensities add up to ", static_cast<float>(lm), " lm, ", std::round(1000 * share) / 10,
        " % of the ", static_cast<float>(file.lamp_lm), " lm of its lamps; are multiplier and lamps right?"));
}

std::string figure(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, v >= 1e4 && v < 1e9 ? "%.0f" : "%.4g", v);
  return buffer;
}

const Json& at(const Json& json, const char* key) { return *json.find(key); }

}  // namespace

double TiltTable::factor(double tilt_deg) const {
  if (factor_at_deg.empty()) return 1;
  if (!(tilt_deg > factor_at_deg.front().first)) return factor_at_deg.front().second;
  for (std::size_t i = 1; i < factor_at_deg.size(); ++i) {
    const auto& [a, fa] = factor_at_deg[i - 1];
    const auto& [b, fb] = factor_at_deg[i];
    if (tilt_deg <= b) return fa + (tilt_deg - a) / (b - a) * (fb - fa);
  }
  return factor_at_deg.back().second;
}

std::string PhotometricFile::title(const std::string& absent) const {
  std::string out = maker;
  for (const std::string* part : {&luminaire, &catalogue})
    if (!part->empty() && out.find(*part) == std::string::npos) append_item(out, *part);
  return out.empty() ? absent : out;
}

bool looks_like_photometry(std::string_view bytes) {
  const Format format = format_of(bytes);
  if (format != Format::eulumdat) return format == Format::ies;
  // A column of a table may look alike, but not with a type, a symmetry and two counts in their ranges.
  const std::vector<PhotometricLine> lines = photometric_lines(bytes.substr(0, kHead));
  constexpr double kMost[] = {3, 4, 1000, 360, 1000};
  for (std::size_t k = 0; k < std::size(kMost); ++k) {
    double value = 0;
    photometric_number(lines[k + 1].words, value);
    if (!(value >= 0 && value <= kMost[k]) || (k != 3 && value != std::floor(value))) return false;
  }
  return true;
}

bool is_photometry(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream in(path, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return looks_like_photometry(head);
}

PhotometricFile parse_photometry(std::string_view bytes, const std::string& where, const ReadBeside& beside) {
  const Format format = format_of(bytes);
  if (is_lfs_pointer(bytes))
    throw Error(ExitCode::bad_input, where,
                text("is neither an IES (LM-63) nor a EULUMDAT file of photometry, but ", kLfsPointer));
  if (format == Format::none)
    throw Error(ExitCode::bad_input, where,
                "is neither an IES (LM-63) nor a EULUMDAT file of photometry; give the .ies or .ldt file of "
                "the luminaire");
  PhotometricFile file =
      format == Format::ies ? parse_ies(bytes, where, beside) : parse_eulumdat(bytes, where);
  check_lumens(file);
  return file;
}

PhotometricFile read_photometry(const std::string& path) {
  return parse_photometry(read_text(path), path, [&](const std::string& name) {
    const std::optional<std::string> file = file_below(path, name);
    if (!file)
      throw Error(ExitCode::bad_input, path,
                  text("TILT= names the file \"", name,
                       "\", which lies neither beside this file nor in a folder below; put it there"));
    return read_referred(*file);
  });
}

std::vector<std::string> photometric_files(const std::string& path) {
  std::vector<std::string> files{path};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return files;
  const std::string tilt = ies_tilt_file(read_text(path));
  const std::optional<std::string> file = tilt.empty() ? std::nullopt : file_below(path, tilt);
  if (file && std::filesystem::is_regular_file(*file, ignored)) files.push_back(*file);
  return files;
}

Json describe_photometry(const PhotometricFile& file) {
  const Photometry& p = *file.photometry;
  Json j;
  j["format"] = file.format;
  j["maker"] = file.maker;
  j["luminaire"] = file.luminaire;
  j["catalogue"] = file.catalogue;
  j["lamp"] = file.lamp;
  j["lumens"] = p.flux_lm();
  j["absolute"] = file.absolute;
  if (file.lamp_lm > 0) j["lamp_lumens"] = file.lamp_lm;
  if (file.lamp_lm > 0 && !file.absolute) j["light_output_ratio"] = p.flux_lm() / file.lamp_lm;
  if (file.watts > 0) j["watts"] = file.watts;
  if (file.watts > 0) j["lumens_per_watt"] = p.flux_lm() / file.watts;
  j["downward_share"] = p.downward_share();
  const Vec3& d = p.peak_direction();
  const double gamma = glm::degrees(std::atan2(std::hypot(d.x, d.y), -d.z));
  const double c = glm::degrees(std::atan2(d.y, d.x));
  j["maximum_cd"] = p.peak_cd();
  j["maximum_c_deg"] =
      std::hypot(d.x, d.y) > 1e-6 ? std::round(100 * (c < -0.005 ? c + 360 : c)) / 100 + 0.0 : 0.0;
  j["maximum_gamma_deg"] = std::round(100 * gamma) / 100;
  for (const int plane : {0, 90}) {
    const BeamAngles beam = beam_angles(p, plane);
    j[text("beam_c", plane, "_deg")] = beam.half_deg;
    j[text("field_c", plane, "_deg")] = beam.tenth_deg;
  }
  j["opening"] = file.opening.describe();
  Json warnings = Json::Array{};
  for (const std::string& w : file.warnings) warnings.push_back(w);
  j["warnings"] = warnings;
  return j;
}

std::string photometry_text(const Json& j) {
  const auto number = [&](const char* key) { return figure(at(j, key).as_number()); };
  std::string out;
  for (const char* key : {"maker", "luminaire", "catalogue", "lamp"})
    if (const std::string& s = at(j, key).as_string(); !s.empty()) out += text(key, ": ", s, "\n");
  out += text(at(j, "format").as_string(), at(j, "absolute").as_bool() ? ", absolute photometry" : "", "\n");
  out += text(number("lumens"), " lm");
  if (j.find("light_output_ratio"))
    out += text(", ", figure(100 * at(j, "light_output_ratio").as_number()), " % of its lamps' ",
                number("lamp_lumens"), " lm");
  out += text(", ", figure(100 * at(j, "downward_share").as_number()), " % downwards\n");
  if (j.find("watts")) out += text(number("watts"), " W, ", number("lumens_per_watt"), " lm/W\n");
  out += text("maximum ", number("maximum_cd"), " cd at C ", number("maximum_c_deg"), ", gamma ",
              number("maximum_gamma_deg"), " deg\n");
  out += text("beam angle (half of the maximum): C0-C180 ", number("beam_c0_deg"), " deg, C90-C270 ",
              number("beam_c90_deg"), " deg\n");
  out += text("field angle (a tenth): C0-C180 ", number("field_c0_deg"), " deg, C90-C270 ",
              number("field_c90_deg"), " deg\n");
  out += text("luminous opening: ", at(j, "opening").as_string(), "\n");
  for (const Json& w : at(j, "warnings").as_array()) out += text("warning: ", w.as_string(), "\n");
  return out;
}

}  // namespace phos::inline scene
