// Radiance records where glossy surfaces want them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/options.h"
#include "estimate/estimator.h"
#include "estimate/radiance_record.h"
#include "estimate/record_options.h"
#include "place/modes.h"
#include "place/placement.h"
#include "place/placement_options.h"
#include "radiance/cache.h"
#include "radiance/gloss_tables.h"

namespace phos::inline place {

/// How radiance records are made. The defaults are the cheapest that leave an error of 2 to 3 % in glossy
/// rooms (place_radiance_table): of fewer rays gradients are noise, and many bands change within short ways.
struct RadianceOptions {
  RadianceOptions() {
    records.estimate = Estimate::gather, records.rays = 4096, records.accuracy = 0.3, records.rho = 0.1;
  }
  RecordOptions records;
  RadianceGradient gradients = RadianceGradient::hybrid;
};
void declare_options(Options& options, RadianceOptions& radiance);

/// One run of placement: records of one order, on the materials that want that.
struct RadianceRun {
  int order = 0;
  PlacementReport report;  ///< without its records
};

/// The estimator of records of an order: its Made hold radiance.
using RadianceEstimatorOf = std::function<std::unique_ptr<Estimator>(int order)>;

/// Adds records to `cache`, whose own stay as they are, first and unchanged: one run for each of the tables'
/// orders, where materials of that order are. `placement` and `source` are resolved; source.wanted is set
/// here. Same records for any number of threads.
std::vector<RadianceRun> place_radiance(RadianceCache& cache, const GlossTables& tables,
                                        const RadianceEstimatorOf& estimator_of, const RayScene& rays,
                                        const RecordOptions& resolved, const PlacementOptions& placement,
                                        PlacementSource source, Counters& counters);

/// May records of these orders be added to the records of a file? Throws Error(mismatch), naming the file,
/// where it holds one of an order that no material wants: nothing would read it.
void require_same_orders(const RadianceCache& earlier, const GlossTables& tables, const std::string& path);

}  // namespace phos::inline place
