#include "sense/sensors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "direct/direct_reader.h"
#include "estimate/caustic_light.h"
#include "estimate/gather.h"
#include "place/placement.h"
#include "place/two_level.h"
#include "place/typical_distance.h"
#include "radiance/cache.h"
#include "record/tree.h"
#include "scene/inside_solid.h"

namespace phos::inline sense {
namespace {

constexpr std::size_t kChunk = 256;

bool beyond(const Bounds& bounds, const Vec3& p) {
  return bounds.empty() || glm::any(glm::lessThan(p, bounds.lo)) || glm::any(glm::greaterThan(p, bounds.hi));
}

struct Direct {
  float value_lx = 0, stderr_lx = 0;
  Rgb components_lx{0};
};

/// How direct light is read at each sensor.
struct DirectAt {
  bool wanted = true;
  double known_lx = 0;        // as in DirectTarget
  bool holds_direct = false;  // as there
};

/// Direct light at every sensor that wants it, and where sensors are.
std::vector<Direct> read_direct(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorOptions& options, const std::function<DirectAt(std::size_t)>& how,
                                SensorReport& report) {
  const std::size_t n = sensors.points.size();
  const DirectReader reader(rays, lights);
  std::vector<Direct> direct(n);
  Progress progress("direct light", n, "sensors");
  const SensorReport sum = parallel_reduce<SensorReport>(
      n, kChunk, {},
      [&](std::size_t begin, std::size_t end) {
        SensorReport part;
        for (std::size_t i = begin; i < end; ++i) {
          const auto& [p, normal] = sensors.points[i];
          const SurfacePoint at = receiver(rays.scene(), p, normal);
          if (inside_solid(rays, at)) part.inside.push_back(i);
          part.outside += beyond(rays.scene().bounds, p);
          const DirectAt wish = how(i);
          if (!wish.wanted) continue;
          const auto samples = static_cast<int>(options.light_samples.value_or(0));
          const DirectReading e =
              samples > 0 ? reader.read(at, samples, options.seed, sensors.first + i)
                          : reader.read(at, DirectTarget{options.error, wish.known_lx, wish.holds_direct},
                                        options.seed, sensors.first + i);
          direct[i] = {luminance(e.irradiance), luminance(e.stderr_lx), e.irradiance};
          part.shadow_rays += e.rays, part.above_error += !e.met;
        }
        progress.advance(end - begin);
        return part;
      },
      [](SensorReport& all, const SensorReport& part) {
        all.inside.insert(all.inside.end(), part.inside.begin(), part.inside.end());
        all.outside += part.outside;
        all.shadow_rays += part.shadow_rays, all.above_error += part.above_error;
      });
  report.inside = sum.inside, report.outside = sum.outside;
  report.shadow_rays = sum.shadow_rays, report.above_error = sum.above_error;
  return direct;
}

Reading together(const Direct& direct, const Rgb& indirect, float stderr_lx) {
  const float indirect_lx = luminance(indirect);
  return {direct.value_lx + indirect_lx, std::hypot(direct.stderr_lx, stderr_lx), direct.value_lx,
          indirect_lx, direct.components_lx + indirect};
}

/// The direct light in a whole that holds it: the rest is indirect, or noise. Null: it is not known.
Reading apart(float whole_lx, const Rgb& whole, float stderr_lx, const Direct* direct_or_null) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  if (!direct_or_null) return {whole_lx, stderr_lx, kUnknown, kUnknown, whole};
  const Direct& direct = *direct_or_null;
  return {whole_lx, stderr_lx, direct.value_lx, std::max(whole_lx - direct.value_lx, 0.f), whole};
}

/// Records at the sensors that no cache covers, and the light that they state there.
std::vector<Reading> read_fresh(const std::vector<SurfaceSample>& open, const RayScene& rays,
                                const Luminaires& lights, const SensorCaches& caches,
                                const std::shared_ptr<const CausticMap>& caustics,
                                const SensorOptions& options, SensorReport& report) {
  RecordOptions resolved;
  resolved.estimate = Estimate::gather;
  resolved.accuracy = options.accuracy;
  resolved.rays = options.rays;
  resolved.leak_test = options.leak_test;
  resolved.caustics_apart = caustics != nullptr;
  resolved.resolve(typical_distance_m(rays, open));
  const std::unique_ptr<RecordTree> tree = caches.tree(rays.scene());
  GatherSource source;
  source.indirect = tree.get();
  source.holds_direct = caches.holds_direct();
  source.lacks_images = !source.holds_direct;
  std::optional<CausticLight> where_rays_land;
  if (caustics) source.caustics = &where_rays_land.emplace(rays, caustics, kGatherCaustics);
  if (tree) {
    const EquivalentPhotons equivalent = equivalent_photons(tree->records(), caches.accuracy());
    source.photon_lm = equivalent.photon_lm, source.zone_photons = equivalent.of_a_zone;
    source.common = equivalent.common, source.tell_common = equivalent.common > 0;
  }
  const GatherEstimator estimator(rays, lights, source, resolved, options.seed);
  IrradianceCache fresh;
  fresh.accuracy = resolved.accuracy;
  place_records(fresh, estimator, rays, resolved, {}, point_candidates(open), report.counters);
  report.records_made = fresh.records.size();

  RecordTree records(rays.scene().bounds, reading_accuracy(fresh.accuracy),
                     options.leak_test == LeakTest::ray ? &rays : nullptr);
  for (const IrradianceRecord& r : fresh.records) records.insert(r);
  std::vector<Reading> readings(open.size());
  parallel_chunks(open.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    const auto worker = estimator.make_worker();
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [p, normal] = open[i];
      const Interpolated e = records.interpolate(p, normal);
      Rgb value = e.irradiance, error = e.stderr_lx;
      if (!(e.weight > 0)) {  // its neighbours shrank away from it: a record of its own
        const IrradianceRecord own = estimator.make({p, normal, kPointItems + i}, *worker).record;
        value = own.irradiance, error = own.stderr_lx;
      }
      readings[i].components_lx = value, readings[i].stderr_lx = luminance(error);
    }
  });
  return readings;
}

/// Adds caustic light to the readings of sensors.
void add_caustics(const Sensors& sensors, const RayScene& rays,
                  const std::shared_ptr<const CausticMap>& caustics, std::vector<Reading>& readings) {
  if (!caustics) return;
  const CausticLight light(rays, caustics, kSensorCaustics);
  Progress progress("caustic light", readings.size(), "sensors");
  parallel_chunks(readings.size(), 1, [&](std::size_t begin, std::size_t end) {
    CausticLight::Worker worker;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [p, normal] = sensors.points[i];
      const LocalDensity e = light.at_sensor(p, normal, worker);
      Reading& r = readings[i];
      r.components_lx += e.irradiance;
      const float lux = luminance(e.irradiance);
      r.illuminance_lx += lux, r.indirect_lx += lux;
      r.stderr_lx = std::hypot(r.stderr_lx, luminance(e.stderr_lx()));
    }
    progress.advance(end - begin);
  });
}

/// How high over a record a sensor may be that it serves, of its radius. Gradients of surface records tell of
/// light along the surface: the light at a sensor in the air over a desk or at the edge of a screen is not
/// theirs.
float most_height(double accuracy) { return static_cast<float>(0.2 * accuracy); }

}  // namespace

void declare_options(Options& options, SensorOptions& s) {
  options.integer("light-samples", s.light_samples, "N",
                  "number of shadow rays to each area light (default: as many as --error takes); 0, for "
                  "caches that hold all light: none, and direct_lx and indirect_lx stay empty",
                  {0, 1e6});
  options.choice<LeakTest>(
      "leak-test", s.leak_test, {{"none", LeakTest::none}, {"ray", LeakTest::ray}},
      "ray: a record serves a sensor only if the two see each other; none: no test, which is faster");
  options.flag("direct-only", s.direct_only, "no indirect light");
  options.integer("rays", s.rays, "N",
                  "number of rays of each record that is made where the caches have none", {4, 1e8});
  options.number("accuracy", s.accuracy, "A",
                 "accuracy of the records that are made where the caches have none: zone of influence = A x "
                 "mean distance",
                 {0, 10, true});
}

SensorCaches::SensorCaches(std::span<const Container> files, const RayScene* leak_test)
    : leak_test_(leak_test) {
  for (const Container& file : files) {
    if (file.kind() == FileKind::radiance) {
      add(irradiance_of(read_radiance(file)), file.path());
      continue;
    }
    RecordLookup lookup(file, leak_test);
    require_light(lookup.records().quantity() == Quantity::all, caustics_of(file), file.path());
    lookups_.push_back(std::move(lookup));
  }
}

void SensorCaches::add(const IrradianceCache& cache, const std::string& name) {
  require_light(cache.quantity == Quantity::all, cache.caustics, name);
  Bounds bounds;
  for (const IrradianceRecord& r : cache.records) bounds.include(r.position);
  const double accuracy = reading_accuracy(cache.accuracy);
  InMemory& made = trees_.emplace_back(InMemory{accuracy, {bounds, accuracy, leak_test_}});
  for (const IrradianceRecord& r : cache.records) made.tree.insert(r);
}

void SensorCaches::replace_last(const IrradianceCache& cache, const std::string& name) {
  PHOS_CHECK(!trees_.empty(), "no cache in memory");
  trees_.pop_back();
  add(cache, name);
}

void SensorCaches::require_light(bool direct, const std::shared_ptr<const CausticPhotons>& caustics,
                                 const std::string& name) {
  if (!empty()) require_same_caustics(caustics != nullptr, caustics_ != nullptr, name);
  if (!caustics_) caustics_ = caustics;
  if (!empty() && direct != holds_direct_)
    throw Error(ExitCode::mismatch, name,
                text("holds ", direct ? "all" : "indirect", " light, and the cache before it holds ",
                     direct ? "indirect" : "all", " light; give caches made with the same --paths"));
  holds_direct_ = direct;
}

Interpolated SensorCaches::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated sum;
  for (const RecordLookup& lookup : lookups_) lookup.add_few(p, n, sum, most_height(lookup.accuracy()));
  for (const InMemory& cache : trees_) cache.tree.add_few(p, n, sum, most_height(cache.accuracy));
  sum.finish();
  return sum;
}

double SensorCaches::accuracy() const {
  return lookups_.empty() ? trees_[0].accuracy : lookups_[0].accuracy();
}

std::unique_ptr<RecordTree> SensorCaches::tree(const Scene& scene) const {
  if (empty()) return nullptr;
  const double accuracy = this->accuracy();
  auto tree = std::make_unique<RecordTree>(scene.bounds, accuracy, leak_test_);
  const auto add = [&](IrradianceRecord r, double own_accuracy) {
    r.radius_m *= static_cast<float>(own_accuracy / accuracy);
    tree->insert(r);
  };
  for (const RecordLookup& lookup : lookups_)
    for (std::size_t i = 0; i < lookup.records().size(); ++i) add(lookup.records()[i], lookup.accuracy());
  for (const InMemory& cache : trees_)
    for (const IrradianceRecord& r : cache.tree.records()) add(r, cache.accuracy);
  return tree;
}

namespace {

/// Light besides direct light, or all light (`whole`), at a sensor.
struct Cached {
  Rgb light{0};
  float stderr_lx = 0;
  bool whole = false;
};

/// Of the caches, and of records made where they have none.
std::vector<Cached> read_cached(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorCaches& caches, const std::shared_ptr<const CausticMap>& caustics,
                                const SensorOptions& options, SensorReport& report) {
  const std::size_t n = sensors.points.size();
  std::vector<Cached> cached(n);
  if (options.direct_only) return cached;
  report.covered.assign(n, 0);
  parallel_for(n, kChunk, [&](std::size_t i) {
    const auto& [p, normal] = sensors.points[i];
    const Interpolated e = caches.interpolate(p, normal);
    report.covered[i] = e.weight > 0;
    cached[i] = {e.irradiance, luminance(e.stderr_lx), caches.holds_direct()};
  });
  std::vector<std::size_t> uncovered;
  std::vector<SurfaceSample> open;
  for (std::size_t i = 0; i < n; ++i)
    if (!report.covered[i]) uncovered.push_back(i), open.push_back(sensors.points[i]);
  report.uncovered = open.size();
  if (open.empty()) return cached;
  if (!options.whole_run)
    throw Error(ExitCode::mismatch, "--part",
                text("the caches have no record for ", open.size(),
                     " sensors of this part, the first is number ", sensors.first + uncovered[0],
                     "; make their records first: phos-irradiance --place every --at POINTS"));
  const std::vector<Reading> fresh = read_fresh(open, rays, lights, caches, caustics, options, report);
  for (std::size_t k = 0; k < uncovered.size(); ++k)
    cached[uncovered[k]] = {fresh[k].components_lx, fresh[k].stderr_lx, false};
  return cached;
}

}  // namespace

std::vector<Reading> read_light(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorCaches& caches, const SensorOptions& options,
                                SensorReport& report) {
  const std::size_t n = sensors.points.size();
  PHOS_CHECK(options.sends_rays() || caches.holds_direct(), "no light but of caches that lack direct light");
  std::shared_ptr<const CausticMap> caustics;
  if (caches.caustics()) caustics = std::make_shared<CausticMap>(*caches.caustics());
  const std::vector<Cached> cached = read_cached(sensors, rays, lights, caches, caustics, options, report);
  const std::vector<Direct> direct = read_direct(
      sensors, rays, lights, options,
      [&](std::size_t i) {
        const auto known_lx = static_cast<double>(luminance(cached[i].light));
        return DirectAt{options.sends_rays() || !cached[i].whole, known_lx, cached[i].whole};
      },
      report);
  std::vector<Reading> readings(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [light, stderr_lx, whole] = cached[i];
    readings[i] = whole
                      ? apart(luminance(light), light, stderr_lx, options.sends_rays() ? &direct[i] : nullptr)
                      : together(direct[i], light, stderr_lx);
  }
  if (!options.direct_only) add_caustics(sensors, rays, caustics, readings);
  return readings;
}

std::vector<Reading> read_light_exactly(const Sensors& sensors, const RayScene& rays,
                                        const Luminaires& lights, std::span<const Whole> whole,
                                        const SensorOptions& options, SensorReport& report) {
  PHOS_CHECK(whole.size() == sensors.points.size(), whole.size(), " estimates for ", sensors.points.size(),
             " sensors");
  const std::vector<Direct> direct = read_direct(
      sensors, rays, lights, options,
      [&](std::size_t i) {
        return DirectAt{true, whole[i].illuminance_lx, true};
      },
      report);
  std::vector<Reading> readings(direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i)
    readings[i] = apart(static_cast<float>(whole[i].illuminance_lx), whole[i].components_lx,
                        static_cast<float>(whole[i].stderr_lx), &direct[i]);
  return readings;
}

}  // namespace phos::inline sense
