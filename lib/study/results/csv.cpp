#include "study/results/csv.h"

#include <cmath>

#include "study/results/results.h"

namespace phos::inline study {

namespace {

/// A cell of a CSV file; quoted where it must be (RFC 4180).
std::string cell(const std::string& s) {
  if (s.find_first_of(",\"\n") == std::string::npos) return s;
  std::string quoted = "\"";
  for (const char c : s) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}
std::string cell(double v) { return std::isfinite(v) ? shortest(v) : std::isgreater(v, 0) ? "inf" : ""; }
std::string cell(const std::optional<double>& v) { return v ? cell(*v) : ""; }
std::string cell(bool v) { return v ? "1" : "0"; }

using Cells = std::vector<std::pair<const char*, std::string>>;

/// Columns of a kind of result, without the kind's name; every cell empty where it is absent.
Cells cells_of(const std::optional<Summary>& summary) {
  static const Summary none;
  const Summary& s = summary ? *summary : none;
  Cells cells{{"error", cell(s.error.mean)},
              {"error_lo", cell(s.error.lo)},
              {"error_hi", cell(s.error.hi)},
              {"bias", cell(s.bias.mean)},
              {"bias_lo", cell(s.bias.lo)},
              {"bias_hi", cell(s.bias.hi)},
              {"p99", cell(s.p99.mean)},
              {"p99_lo", cell(s.p99.lo)},
              {"p99_hi", cell(s.p99.hi)},
              {"rmse", cell(s.rmse)},
              {"unit", s.unit},
              {"psnr_db", cell(s.psnr_db)},
              {"ssim", cell(s.ssim)},
              {"stated", cell(s.stated)},
              {"inside", cell(s.inside)},
              {"reference_noise", cell(s.noise)},
              {"resolution", cell(s.resolution)},
              {"resolved", cell(s.resolved)},
              {"non_finite", std::to_string(s.non_finite)},
              {"seconds", cell(s.seconds.mean)},
              {"seconds_lo", cell(s.seconds.lo)},
              {"seconds_hi", cell(s.seconds.hi)},
              {"cpu_s", cell(s.cpu_s.mean)},
              {"peak_bytes", cell(s.peak_bytes)},
              {"file_bytes", cell(s.file_bytes)},
              {"best_in_time", cell(s.best_in_time)},
              {"best_in_memory", cell(s.best_in_memory)},
              {"best_in_bytes", cell(s.best_in_bytes)}};
  if (!summary)
    for (auto& [name, value] : cells) value.clear();
  return cells;
}

}  // namespace

std::string results_csv(const StudyFile& study, const StudyWork& work, const StudyResults& results) {
  std::vector<std::pair<const char*, std::optional<Summary> PointResult::*>> kinds;
  if (study.makes_pictures()) kinds.emplace_back("picture_", &PointResult::picture);
  if (study.reads_sensors()) kinds.emplace_back("lux_", &PointResult::lux);
  std::string csv = "point,scene,camera";
  for (const Factor& f : study.factors) csv.append(",").append(cell(f.name()));
  csv += ",seeds";
  for (const auto& [prefix, kind] : kinds)
    for (const auto& [name, value] : cells_of(std::nullopt)) csv.append(",").append(prefix).append(name);
  csv += ",failed\n";
  for (const PointResult& p : results.points) {
    const Setting& s = work.settings[p.setting];
    csv.append(std::to_string(p.setting)).append(",").append(cell(study.scenes[s.scene]));
    csv.append(",").append(cell(study.cameras[s.camera]));
    for (std::size_t i = 0; i < study.factors.size(); ++i)
      csv.append(",").append(cell(study.factors[i].labels[s.level[i]]));
    csv.append(",").append(std::to_string(study.seeds.size()));
    for (const auto& [prefix, kind] : kinds)
      for (const auto& [name, value] : cells_of(p.*kind)) csv.append(",").append(value);
    csv.append(",").append(cell(p.failed)).append("\n");
  }
  return csv;
}

}  // namespace phos::inline study
