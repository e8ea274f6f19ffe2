#include "place/radiance_placement.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "place/modes.h"

namespace phos::inline place {
namespace {

const Names<Estimate> kEstimates{
    {"gather", Estimate::gather}, {"hull", Estimate::hull}, {"raster", Estimate::raster}};
const Names<RadianceGradient> kGradients{{"hybrid", RadianceGradient::hybrid},
                                         {"analytic", RadianceGradient::analytic},
                                         {"numeric", RadianceGradient::numeric},
                                         {"none", RadianceGradient::none}};

}  // namespace

void declare_options(Options& options, RadianceOptions& r) {
  options.section("Records");
  options.choice<Estimate>(
      "estimate", r.records.estimate, kEstimates,
      "method: gather: rays over the hemisphere, lit where they land; hull: photons over their convex hull; "
      "raster: the scene drawn on a plane above the record",
      Adopted::estimate);
  declare_reach_options(options, r.records);
  options.choice<RadianceGradient>(
      "gradients", r.gradients, kGradients,
      "method for the change of light about a record: hybrid: from each ray or pixel, with the edges of "
      "occluders (with photons, without these edges); analytic: from each ray or pixel, without edges; "
      "numeric: by moved rays; none: no change",
      Adopted::estimate);
  options.section("Estimates from photons");
  declare_photon_options(options, r.records);
  options.section("Estimates from rays");
  declare_gather_options(options, r.records);
}

std::vector<RadianceRun> place_radiance(RadianceCache& cache, const GlossTables& tables,
                                        const RadianceEstimatorOf& estimator_of, const RayScene& rays,
                                        const RecordOptions& resolved, const PlacementOptions& placement,
                                        PlacementSource source, Counters& counters) {
  std::vector<RadianceRun> runs;
  for (const int order : tables.orders()) {
    IrradianceCache own;
    own.accuracy = cache.accuracy;
    for (const RadianceRecord& r : cache.records)
      if (r.order() == order) own.records.push_back(irradiance_of(r));
    source.wanted = [&tables, order](std::uint32_t material) { return tables.order(material) == order; };
    RadianceRun& run = runs.emplace_back(RadianceRun{order, {}});
    run.report = extend_cache(own, *estimator_of(order), rays, resolved, placement, source, counters);
    std::vector<RadianceRecord>& made = run.report.radiance;
    PHOS_CHECK(made.size() == run.report.kept, made.size(), " of ", run.report.kept, " hold radiance");
    std::move(made.begin(), made.end(), std::back_inserter(cache.records));
    made.clear();
  }
  return runs;
}

void require_same_orders(const RadianceCache& earlier, const GlossTables& tables, const std::string& path) {
  const std::vector<int> wanted = tables.orders();
  for (const RadianceRecord& r : earlier.records) {
    if (std::find(wanted.begin(), wanted.end(), r.order()) != wanted.end()) continue;
    std::string all;
    for (const int order : wanted) all += text(all.empty() ? "" : ", ", order);
    throw Error(ExitCode::mismatch, path,
                text("holds records of order ", r.order(), ", and materials need ",
                     all.empty() ? "none" : "order " + all,
                     "; give the .brdf file and --gloss that it was made with, or make a new file without "
                     "--add-to"));
  }
}

}  // namespace phos::inline place
