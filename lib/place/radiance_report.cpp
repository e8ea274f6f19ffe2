#include "place/radiance_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace phos::inline place {
namespace {

/// Records that are there.
struct Summary {
  std::map<int, std::size_t> records;  // by order
  double error = 0;  // of the light, relative: norm of the coefficients' standard errors over their norm
};

Summary summarize(const RadianceCache& cache) {
  Summary summary;
  double light = 0, error = 0;  // of luminance, squared
  const auto square = [](const float* rgb) {
    const auto y = static_cast<double>(luminance({rgb[0], rgb[1], rgb[2]}));
    return y * y;
  };
  for (const RadianceRecord& r : cache.records) {
    ++summary.records[r.order()];
    for (std::size_t i = 0; i < r.light.size(); i += 3) light += square(&r.light[i]);
    for (std::size_t l = 0; 3 * l < r.stderr_light.size(); ++l)
      error += static_cast<double>(2 * l + 1) * square(&r.stderr_light[3 * l]);
  }
  if (light > 0) summary.error = std::sqrt(error / light);
  return summary;
}

Json figures_of(const RadianceRun& run) {
  const PlacementReport& r = run.report;
  Json j;
  j["order"] = run.order, j["records_new"] = r.kept, j["records_made"] = r.made;
  j["candidates"] = r.candidates, j["candidates_uncovered"] = r.uncovered, j["passes"] = r.passes;
  if (r.uncovered_share) j["uncovered_share"] = *r.uncovered_share;
  return j;
}

double rounded(double v) { return std::round(100 * v) / 100; }

}  // namespace

RadianceReport report_of(const RadianceCache& cache, const std::vector<RadianceRun>& runs) {
  PlacementReport all;
  double open_share = 0;
  Json by_order = Json::Array{};
  for (const RadianceRun& run : runs) {
    const PlacementReport& r = run.report;
    all.made += r.made, all.kept += r.kept, all.making_s += r.making_s;
    all.candidates += r.candidates, all.uncovered += r.uncovered;
    open_share = std::max(open_share, r.uncovered_share.value_or(0));
    by_order.push_back(figures_of(run));
  }
  const Summary summary = summarize(cache);
  RadianceReport report;
  report.figures["records"] = cache.records.size();
  report.figures["records_new"] = all.kept;
  report.figures["records_made"] = all.made;
  report.figures["runs"] = by_order;
  report.figures["relative_error"] = summary.error;
  const double ms = all.made > 0 ? 1e3 * all.making_s / static_cast<double>(all.made) : 0;
  if (all.made > 0) report.figures["ms_per_record"] = ms;

  std::string orders;
  for (const auto& [order, count] : summary.records)
    orders += text(orders.empty() ? "" : ", ", count, " of order ", order);
  report.lines.push_back(text("records: ", orders.empty() ? "none" : orders, "; ", all.kept, " new, for ",
                              all.candidates, " candidates",
                              all.made > 0 ? text(", ", rounded(ms), " ms each") : "",
                              "; mean standard error ", rounded(100 * summary.error), " % of the light"));
  if (open_share > 0)
    report.lines.push_back(
        text(rounded(100 * open_share), " % of the glossy surface is out of every record's reach"));
  else if (all.uncovered > 0)
    report.lines.push_back(
        text(all.uncovered, " candidates are left uncovered by neighbour clamping; raise --passes"));
  return report;
}

}  // namespace phos::inline place
