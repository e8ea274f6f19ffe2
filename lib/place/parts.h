// Parts of one run of records at given places, and their union: exactly the file of the whole run.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/counters.h"
#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "file/container.h"
#include "place/growth.h"
#include "place/placement.h"
#include "record/irradiance_cache.h"

namespace phos::inline place {

/// A share of the records of `--place every`, as made: their neighbours have had no say in their radii yet.
struct IrradiancePart {
  std::string name;                    ///< "k/n"
  std::uint64_t first = 0, total = 0;  ///< number of its first record, and of records of the whole run
  std::vector<Made> made;              ///< in order
  Counters counters;                   ///< of making them
  IrradianceCache whole;               ///< that it is a part of, without records
  RadiusBounds bounds;
  Bounds scene;
};

/// Makes records [(k-1)N/n, kN/n) of N points. `cache` states their quantity and options, and holds no
/// records. Throws Error(usage) if it does, and for a part that is not "k/n", 1 <= k <= n.
IrradiancePart make_part(const IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                         const RecordOptions& resolved, const std::string& part,
                         std::span<const SurfaceSample> points);

/// `provenance` belongs to the run; its counters hold earlier work (a coarse cache), not the part's own.
void write_part(const std::string& path, const IrradiancePart& part, Provenance provenance);

/// A whole run.
struct MergedParts {
  IrradianceCache cache;
  Provenance provenance;
};
/// Throws Error(mismatch) for parts of different runs, a part given twice, or one that is missing (naming
/// it); Error(bad_input) for damaged files and for files that are no parts.
MergedParts read_parts(const std::vector<std::string>& paths);

/// The key of the whole run's file, by the headers alone; makes the same checks that the files belong
/// together.
std::string key_of_merged_parts(const std::vector<std::string>& paths);

}  // namespace phos::inline place
