#include "sense/sensor_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "file/csv.h"
#include "scene/spectral/bands.h"
#include "sense/sensors.h"

namespace phos::inline sense {
namespace {

constexpr std::size_t kLines = 4096;

}  // namespace

std::vector<std::string> sensor_csv(const Sensors& sensors, std::span<const Reading> readings,
                                    std::optional<double> open_lx, const BandTriplet& bands) {
  const std::size_t n = readings.size();
  std::vector<std::string> pieces(1 + (n + kLines - 1) / kLines);
  pieces[0] = "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx";
  if (open_lx) pieces[0] += ",daylight_factor_percent,daylight_factor_stderr_percent";
  const int filled = std::clamp(bands.number - 3 * (bands.triplet - 1), 0, 3) * (bands.number > 0);
  for (int c = 0; c < filled; ++c)
    pieces[0] += text(",band_", 3 * (bands.triplet - 1) + c + 1, "_of_", bands.number, "_lx");
  pieces[0] += '\n';
  parallel_chunks(n, kLines, [&](std::size_t begin, std::size_t end) {
    std::string& out = pieces[1 + begin / kLines];
    out.reserve((end - begin) * 112);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [p, normal] = sensors.points[i];
      const Reading& r = readings[i];
      out += sensors.ids.empty() ? std::to_string(sensors.first + i) : csv_cell(sensors.ids[i]);
      for (int c = 0; c < 3; ++c) out += ',', out += world_text(sensors.origin_m[c], p[c]);
      for (const float v :
           {normal.x, normal.y, normal.z, r.illuminance_lx, r.stderr_lx, r.direct_lx, r.indirect_lx})
        out += ',', out += std::isnan(v) ? std::string() : shortest(v);
      if (open_lx)
        for (const float lx : {r.illuminance_lx, r.stderr_lx}) {
          const auto percent = static_cast<float>(100 * static_cast<double>(lx) / *open_lx);
          out += ',', out += std::isnan(lx) ? std::string() : shortest(percent);
        }
      for (int c = 0; c < filled; ++c)
        out += ',', out += shortest(kLuminanceWeight[c] * static_cast<double>(r.components_lx[c]));
      out += '\n';
    }
  });
  return pieces;
}

Json summarise(std::span<const Reading> readings) {
  Json summary;
  summary["number"] = readings.size();
  if (readings.empty()) return summary;
  double sum = 0, least = static_cast<double>(kInfinity), most = 0;
  for (const Reading& r : readings) {
    const auto e = static_cast<double>(r.illuminance_lx);
    sum += e, least = std::min(least, e), most = std::max(most, e);
  }
  const double mean = sum / static_cast<double>(readings.size());
  summary["mean_lx"] = static_cast<float>(mean);
  summary["min_lx"] = static_cast<float>(least);
  summary["max_lx"] = static_cast<float>(most);
  if (mean > 0) summary["U0"] = static_cast<float>(least / mean);
  if (most > 0) summary["Ud"] = static_cast<float>(least / most);
  return summary;
}

std::string summary_line(const Json& summary) {
  std::string line;
  const auto add = [&](const char* key, const char* before, const char* after) {
    if (const Json* value = summary.find(key)) line += before + value->dump() + after;
  };
  add("number", "", " sensors"), add("level_m", " at the level of ", " m");
  add("mean_lx", ": mean ", " lx"), add("min_lx", ", min ", " lx"), add("max_lx", ", max ", " lx");
  add("U0", ", U0 ", ""), add("Ud", ", Ud ", "");
  return line;
}

}  // namespace phos::inline sense
