#include "cache/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cache/caustic_light.h"
#include "cache/direct_light.h"
#include "cache/gather.h"
#include "cache/inside_solid.h"
#include "cache/placement.h"
#include "cache/radiance_cache.h"
#include "cache/two_level.h"
#include "cache/typical_distance.h"
#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "scene/bands.h"

namespace phos {
namespace {

constexpr std::size_t kChunk = 256;
constexpr std::size_t kLines = 4096;

bool beyond(const Bounds& bounds, const Vec3& p) {
  return bounds.empty() || glm::any(glm::lessThan(p, bounds.lo)) || glm::any(glm::greaterThan(p, bounds.hi));
}

struct Direct {
  float value_lx = 0, stderr_lx = 0;
  Rgb components_lx{0};
};

/// At sensor i.
Direct direct_at(const SurfacePoint& at, std::size_t i, std::int64_t samples, const RayScene& rays,
                 const Luminaires& lights, std::uint64_t seed) {
  RandomStream random(seed, Stage::direct_light, i);
  const DirectIrradiance e = direct_irradiance(rays, lights, at, static_cast<int>(samples), random);
  return {luminance(e.irradiance), luminance(e.stderr_lx), e.irradiance};
}

/// Direct light at every sensor (if rays are to be sent), and where sensors are.
std::vector<Direct> read_direct(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorOptions& options, SensorReport& report) {
  const std::size_t n = sensors.points.size();
  std::vector<Direct> direct(n);
  Progress progress("direct light", n, "sensors");
  struct Lost {
    std::uint64_t inside = 0, outside = 0;
  };
  const Lost lost = parallel_reduce<Lost>(
      n, kChunk, {},
      [&](std::size_t begin, std::size_t end) {
        Lost part;
        for (std::size_t i = begin; i < end; ++i) {
          const auto& [p, normal] = sensors.points[i];
          const SurfacePoint at = receiver(rays.scene(), p, normal);
          if (options.light_samples > 0)
            direct[i] = direct_at(at, i, options.light_samples, rays, lights, options.seed);
          part.inside += inside_solid(rays, at);
          part.outside += beyond(rays.scene().bounds, p);
        }
        progress.advance(end - begin);
        return part;
      },
      [](Lost& sum, const Lost& part) { sum.inside += part.inside, sum.outside += part.outside; });
  report.inside = lost.inside, report.outside = lost.outside;
  return direct;
}

Reading together(const Direct& direct, const Rgb& indirect, float stderr_lx) {
  const float indirect_lx = luminance(indirect);
  return {direct.value_lx + indirect_lx, std::hypot(direct.stderr_lx, stderr_lx), direct.value_lx,
          indirect_lx, direct.components_lx + indirect};
}

/// Of a whole that holds the direct light: what is left is indirect, or noise. Null: that is not known.
Reading apart(float whole_lx, const Rgb& whole, float stderr_lx, const Direct* direct_or_null) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  if (!direct_or_null) return {whole_lx, stderr_lx, kUnknown, kUnknown, whole};
  const Direct& direct = *direct_or_null;
  return {whole_lx, stderr_lx, direct.value_lx, std::max(whole_lx - direct.value_lx, 0.f), whole};
}

/// Records at the sensors that no cache covers, and what they say there.
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

/// Adds caustic light to what sensors read.
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

/// A name as CSV has it.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

void declare_options(Options& options, SensorOptions& s) {
  options.integer(
      "light-samples", s.light_samples, "N",
      "shadow rays to each area light; 0, for caches that hold all light: none, and direct_lx and "
      "indirect_lx stay empty",
      {0, 1e6});
  options.choice<LeakTest>(
      "leak-test", s.leak_test, {{"none", LeakTest::none}, {"ray", LeakTest::ray}},
      "ray: a record serves a sensor only if the two can see each other; none is faster");
  options.flag("direct-only", s.direct_only, "no indirect light");
  options.integer("rays", s.rays, "N", "rays of a record made where the caches have none", {4, 1e8});
  options.number("accuracy", s.accuracy, "A", "of those records: zone of influence = A x mean distance",
                 {0, 10, true});
}

SensorCaches::SensorCaches(std::span<const Container> files, const RayScene* leak_test)
    : leak_test_(leak_test) {
  for (const Container& file : files) {
    if (file.provenance().kind == "radiance") {
      add(irradiance_of(read_radiance(file)), file.path());
      continue;
    }
    RecordLookup lookup(file, leak_test);
    require_light(lookup.records().quantity() == "all", caustics_of(file), file.path());
    lookups_.push_back(std::move(lookup));
  }
}

void SensorCaches::add(const IrradianceCache& cache, const std::string& name) {
  require_light(cache.quantity == "all", cache.caustics, name);
  Bounds bounds;
  for (const IrradianceRecord& r : cache.records) bounds.include(r.position);
  const double accuracy = reading_accuracy(cache.accuracy);
  InMemory& made = trees_.emplace_back(InMemory{accuracy, {bounds, accuracy, leak_test_}});
  for (const IrradianceRecord& r : cache.records) made.tree.insert(r);
}

void SensorCaches::require_light(bool direct, const std::shared_ptr<const CausticPhotons>& caustics,
                                 const std::string& name) {
  if (!empty()) require_same_caustics(caustics != nullptr, caustics_ != nullptr, name);
  if (!caustics_) caustics_ = caustics;
  if (!empty() && direct != holds_direct_)
    throw Error(ExitCode::mismatch, name,
                text("holds ", direct ? "all" : "indirect", " light, the cache before it ",
                     direct ? "indirect" : "all", "; give caches made with the same --paths"));
  holds_direct_ = direct;
}

Interpolated SensorCaches::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated sum;
  for (const RecordLookup& lookup : lookups_) lookup.add(p, n, sum);
  for (const InMemory& cache : trees_) cache.tree.add(p, n, sum);
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

std::vector<Reading> read_light(const Sensors& sensors, const RayScene& rays, const Luminaires& lights,
                                const SensorCaches& caches, const SensorOptions& options,
                                SensorReport& report) {
  const std::size_t n = sensors.points.size();
  PHOS_CHECK(options.light_samples > 0 || caches.holds_direct(),
             "no light but of caches that lack direct light");
  const std::vector<Direct> direct = read_direct(sensors, rays, lights, options, report);
  std::vector<Reading> readings(n);
  if (options.direct_only) {
    for (std::size_t i = 0; i < n; ++i) readings[i] = together(direct[i], Rgb(0), 0);
    return readings;
  }
  std::vector<std::uint8_t> covered(n);
  parallel_for(n, kChunk, [&](std::size_t i) {
    const auto& [p, normal] = sensors.points[i];
    const Interpolated e = caches.interpolate(p, normal);
    covered[i] = e.weight > 0;
    const float error = luminance(e.stderr_lx);
    readings[i] = caches.holds_direct() ? apart(luminance(e.irradiance), e.irradiance, error,
                                                options.light_samples > 0 ? &direct[i] : nullptr)
                                        : together(direct[i], e.irradiance, error);
  });
  std::vector<std::size_t> uncovered;
  std::vector<SurfaceSample> open;
  for (std::size_t i = 0; i < n; ++i)
    if (!covered[i]) uncovered.push_back(i), open.push_back(sensors.points[i]);
  report.uncovered = open.size(), report.covered = std::move(covered);
  std::shared_ptr<const CausticMap> caustics;
  if (caches.caustics()) caustics = std::make_shared<CausticMap>(*caches.caustics());
  if (open.empty()) {
    add_caustics(sensors, rays, caustics, readings);
    return readings;
  }
  const std::vector<Reading> fresh = read_fresh(open, rays, lights, caches, caustics, options, report);
  parallel_for(uncovered.size(), kChunk, [&](std::size_t k) {
    const std::size_t i = uncovered[k];
    const auto& [p, normal] = sensors.points[i];
    const Direct own = options.light_samples > 0
                           ? direct[i]
                           : direct_at(receiver(rays.scene(), p, normal), i, SensorOptions().light_samples,
                                       rays, lights, options.seed);
    readings[i] = together(own, fresh[k].components_lx, fresh[k].stderr_lx);
  });
  add_caustics(sensors, rays, caustics, readings);
  return readings;
}

std::vector<Reading> read_light_exactly(const Sensors& sensors, const RayScene& rays,
                                        const Luminaires& lights, std::span<const Whole> whole,
                                        const SensorOptions& options, SensorReport& report) {
  const std::vector<Direct> direct = read_direct(sensors, rays, lights, options, report);
  PHOS_CHECK(whole.size() == direct.size(), whole.size(), " estimates for ", direct.size(), " sensors");
  std::vector<Reading> readings(direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i)
    readings[i] = apart(static_cast<float>(whole[i].illuminance_lx), whole[i].components_lx,
                        static_cast<float>(whole[i].stderr_lx), &direct[i]);
  return readings;
}

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
      out += sensors.ids.empty() ? std::to_string(i) : quoted(sensors.ids[i]);
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

}  // namespace phos
