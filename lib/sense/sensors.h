// Illuminance at sensors: direct light by shadow rays, indirect light from caches, and from records made on
// the spot where these have none.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/counters.h"
#include "core/json.h"
#include "place/candidates.h"
#include "record/index.h"
#include "record/tree.h"
#include "scene/lamp/luminaires.h"

namespace phos::inline sense {

/// Where light is measured, and on which side.
struct Sensors {
  std::vector<SurfaceSample> points;  ///< m; unit normals
  std::vector<std::string> ids;       ///< one each, or empty: sensors are numbered from 0
  std::uint64_t first = 0;            ///< number of the first: of a part of a run, the sensors before it
  std::uint64_t left_out = 0;         ///< points of a grid where nobody could put a sensor
  std::optional<double> level_m;      ///< of a workplane, in the world
  DVec3 origin_m{0};                  ///< of the scene: points are counted from there, tables are not
};

struct Reading {
  float illuminance_lx = 0, stderr_lx = 0;
  float direct_lx = 0, indirect_lx = 0;  ///< their parts; not a number where they are not told apart
  Rgb components_lx{0};                  ///< whose luminance() is illuminance_lx, to rounding
};

struct SensorOptions {
  /// Shadow rays to each area light. 0: none; caches that hold all light tell the whole, but not its parts.
  /// Not given: as many as error takes (DirectReader).
  std::optional<std::int64_t> light_samples;
  double error = 0.01;  ///< standard error of direct light over the illuminance of all light
  LeakTest leak_test = LeakTest::ray;
  bool direct_only = false;
  bool whole_run = true;  ///< false: of a part of it, where no records are made
  // Records made where the caches have none.
  std::int64_t rays = 1024;
  double accuracy = 0.15;
  std::uint64_t seed = 0;

  bool sends_rays() const { return light_samples.value_or(1) > 0; }
};

void declare_options(Options& options, SensorOptions& sensors);

/// What happened besides.
struct SensorReport {
  std::uint64_t uncovered = 0;     ///< sensors that no record of the caches covers
  std::uint64_t records_made = 0;  ///< for those
  /// Sensors inside of solids, in order: rays from there mostly meet back faces. No standard error holds
  /// there.
  std::vector<std::size_t> inside{};
  std::uint64_t outside = 0;      ///< sensors beyond the scene's bounds
  std::uint64_t shadow_rays = 0;  ///< of direct light
  std::uint64_t above_error = 0;  ///< sensors whose direct light is less well known than asked for
  Counters counters;              ///< numerical events of the new records
  std::vector<std::uint8_t>
      covered;  ///< of each sensor: by a record of the caches; empty where none is asked

  bool is_covered(std::size_t sensor) const { return sensor < covered.size() && covered[sensor] != 0; }
};

/// Caches of one scene that are looked up together.
class SensorCaches {
 public:
  /// Files of irradiance, or of radiance, whose records hold irradiance too. Throws Error(bad_input) for one
  /// of another kind, Error(mismatch) if one holds all light and another indirect light, or one caustic light
  /// in its records and another as photons.
  SensorCaches(std::span<const Container> files, const RayScene* leak_test);
  /// The same of a cache in memory; `name` is its own in messages.
  void add(const IrradianceCache& cache, const std::string& name);
  /// The same in place of the cache in memory that was added last.
  void replace_last(const IrradianceCache& cache, const std::string& name);
  bool empty() const { return lookups_.empty() && trees_.empty(); }
  bool holds_direct() const { return holds_direct_; }
  /// Caustic photons of the first, where records hold no caustic light; null: they hold it, or there is none.
  const std::shared_ptr<const CausticPhotons>& caustics() const { return caustics_; }
  /// Of the records valid there, but for those whose surface lies clearly below or above the point.
  Interpolated interpolate(const Vec3& p, const Vec3& n) const;
  /// That at which tree() is read; there must be a cache.
  double accuracy() const;
  /// All records in memory, each with its reach, which gathered rays read.
  std::unique_ptr<RecordTree> tree(const Scene& scene) const;

 private:
  struct InMemory {
    double accuracy;  ///< at which it is read
    RecordTree tree;
  };
  /// Throws unless all hold the same light.
  void require_light(bool direct, const std::shared_ptr<const CausticPhotons>& caustics,
                     const std::string& name);
  std::vector<RecordLookup> lookups_;
  std::vector<InMemory> trees_;
  const RayScene* leak_test_;
  bool holds_direct_ = false;
  std::shared_ptr<const CausticPhotons> caustics_;
};

/// Reads every sensor. Caustic light, where the caches have it as photons, is estimated at each sensor
/// (CausticLight) and is part of the indirect light. Same numbers for any number of threads. Without shadow
/// rays caches must hold all light; sensors that they do not cover get as many as options.error takes. The
/// readings of a part of a run are those of the whole run; throws Error(mismatch) where the caches do not
/// cover a sensor of a part, because records of a whole run depend on each other.
std::vector<Reading> read_light(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorCaches& caches, const SensorOptions& options,
                                SensorReport& report);

/// All light at a sensor, with its standard error, lx: an estimate of the caller's own.
struct Whole {
  double illuminance_lx = 0, stderr_lx = 0;
  Rgb components_lx{0};  ///< whose luminance() is illuminance_lx
};
/// The same from an estimate of the whole light at each sensor in place of caches; direct light as above.
std::vector<Reading> read_light_exactly(const Sensors& sensors, const RayScene& rays,
                                        const Luminaires& lights, std::span<const Whole> whole,
                                        const SensorOptions& options, SensorReport& report);

}  // namespace phos::inline sense
