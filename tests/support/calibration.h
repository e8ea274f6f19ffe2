// How often the truth lies within two stated standard errors, over many seeds.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "estimate/gather.h"
#include "estimate/radiance_density.h"
#include "estimate/radiance_gather.h"
#include "estimate/record_options.h"
#include "file/csv.h"
#include "place/two_level.h"
#include "radiance/cache.h"
#include "radiance/tree.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/lamp/luminaires.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "sense/sensors.h"
#include "support/records.h"
#include "support/run.h"

namespace phos::test {

/// Estimates against the truth, with the errors that they state.
struct Calibration {
  double n = 0, within = 0, exact = 0;
  double off = 0, off2 = 0, stated2 = 0;

  /// Sums of floats are right to `rounding` x truth: an estimate without noise is known to that.
  void add(double value, double stated, double truth, double rounding = 2e-6) {
    const double error = value - truth, least = rounding * std::fabs(truth);
    n += 1, off += error, off2 += error * error, stated2 += stated * stated;
    within += std::fabs(error) <= 2 * stated + least;
    exact += std::fabs(error) <= least && stated <= least;
  }
  void add(const Calibration& o) {
    n += o.n, within += o.within, exact += o.exact;
    off += o.off, off2 += o.off2, stated2 += o.stated2;
  }
  double share() const { return within / n; }
  double exact_share() const { return exact / n; }
  /// Root mean square of the true errors over the root mean square of the stated errors.
  double ratio() const { return std::sqrt(off2 / stated2); }
  /// Mean error, in stated errors.
  double bias() const { return off / n / std::sqrt(stated2 / n); }
};

/// Results of one scene, repeated with other random numbers, by estimator.
using CalibrationTable = std::map<std::string, Calibration>;

struct CalibrationOptions {
  std::int64_t paths = 400'000;  ///< that leave so many photons with an albedo of 0
  std::int64_t candidates = 20000;
  int points = 64;  ///< of a picture at which caches are read
  int records = 8;  ///< points among these at which records are made
  std::int64_t rays = 256;
  bool photons = true, gathering = true, radiance = true, sensors = true;

  /// For tests: seconds for a dozen seeds.
  static CalibrationOptions small() {
    CalibrationOptions options;
    options.paths = 40'000, options.candidates = 1500, options.rays = 128;
    options.points = 40, options.records = 8;
    return options;
  }
  /// The same of a scene of many places that are unlike; all photons are candidates, so that nothing is read
  /// beyond its reach.
  static CalibrationOptions small_of_real_scene() {
    CalibrationOptions options = small();
    options.paths = 100'000, options.candidates = 0;
    options.points = 200, options.records = 40;
    return options;
  }
};

/// Points on surfaces that reflect and are lit, with the irradiance there, lx, and how well that is known.
struct KnownPoints {
  std::vector<SurfaceSample> at;
  std::vector<double> all, direct, all_error, direct_error;

  void add(const SurfaceSample& point, double all_lx, double direct_lx, double all_stderr_lx = 0,
           double direct_stderr_lx = 0) {
    at.push_back(point), all.push_back(all_lx), direct.push_back(direct_lx);
    all_error.push_back(all_stderr_lx), direct_error.push_back(direct_stderr_lx);
  }
};

/// A scene whose light is known.
struct KnownLight {
  std::string name;
  Scene scene;
  std::function<KnownPoints(const RayScene& rays, std::uint64_t seed, int most)> points;
  double paths = 1;                   ///< factor on the paths asked for
  Quantity quantity = Quantity::all;  ///< the quantity that records hold
  bool interreflected = true;         ///< else all light is direct
  bool even = false;                  ///< it comes alike from everywhere
};

/// Seen by the camera of a scene of known light.
inline KnownLight known_light(const AnalyticScene& s) {
  const Material& surface = s.scene.material[0];
  const bool furnace = s.name == "furnace";
  KnownLight known;
  known.name = furnace ? s.name + " " + std::to_string(surface.kd.x).substr(0, 4) : s.name;
  known.scene = s.scene;
  known.paths = std::max(0.02, 1 - double(surface.kd.x));
  known.interreflected = known.even = furnace;
  const double emitted = std::numbers::pi * double(surface.emission.y);
  known.points = [=, lx = s.irradiance_lx](const RayScene& rays, std::uint64_t seed, int most) {
    KnownPoints seen;
    for (std::uint64_t i = 0; seen.at.size() < static_cast<std::size_t>(most) && i < 100000; ++i) {
      RandomStream random(seed, Stage::test, i);
      const Camera::Ray ray = rays.scene().camera[0].ray(random.uniform2(), 1);
      SurfacePoint point;
      if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
      if (!(max_component(rays.scene().material[point.material].kd) > 0)) continue;
      const double truth = lx(point.position, point.normal);
      if (!(truth > 0)) continue;
      seen.add({point.position, point.normal}, truth, furnace ? emitted : truth);
    }
    return seen;
  };
  return known;
}

/// Points of a table that the reference made of a real scene; each seed takes some of them.
inline KnownLight known_light(const std::string& name, Scene scene, const std::string& table) {
  const CsvTable rows = parse_csv(slurp(table), table);
  KnownPoints every;
  const auto number = [&](std::size_t row, const char* column) {
    return rows.number(row, rows.column(column, table));
  };
  const auto vector = [&](std::size_t row, const char* x, const char* y, const char* z) {
    return Vec3(number(row, x), number(row, y), number(row, z));
  };
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    every.add({vector(i, "x", "y", "z"), vector(i, "nx", "ny", "nz")}, number(i, "E_lx"),
              number(i, "direct_lx"), number(i, "stderr_lx"), number(i, "direct_stderr_lx"));
  }
  KnownLight known;
  known.name = name, known.scene = std::move(scene);
  known.quantity = Quantity::indirect;
  known.points = [=](const RayScene&, std::uint64_t seed, int most) {
    KnownPoints some;
    const std::size_t n = every.at.size();
    for (std::size_t k = 0; k < std::min(n, static_cast<std::size_t>(most)); ++k) {
      const std::size_t i = (seed * static_cast<std::size_t>(most) + k) % n;
      some.add(every.at[i], every.all[i], every.direct[i], every.all_error[i], every.direct_error[i]);
    }
    return some;
  };
  return known;
}

/// None where the scene collection is not beside the project.
inline std::optional<KnownLight> sponza() {
  const std::string model = PHOS_SOURCE "/../shared/scenes/sponza.glb";
  if (!std::filesystem::exists(model)) return std::nullopt;
  return known_light("Sponza", load_scene(model), PHOS_SOURCE "/data/golden/sponza-points.csv");
}

class CalibratedScene {
 public:
  CalibratedScene(KnownLight known, const CalibrationOptions& options)
      : known_(std::move(known)), options_(options), rays_(known_.scene), lights_(known_.scene) {}

  const std::string& name() const { return known_.name; }

  void measure(std::uint64_t seed, CalibrationTable& table) const {
    const KnownPoints seen = known_.points(rays_, seed, options_.points);
    const auto paths = static_cast<std::int64_t>(static_cast<double>(options_.paths) * known_.paths);
    const PhotonMap photons = photons_of(rays_, paths, seed);
    std::optional<IrradianceCache> indirect;  // by hulls, if made
    if (options_.photons) {
      for (const Estimate estimate : {Estimate::hull, Estimate::kernel}) {
        RecordOptions options = of_photons(known_.quantity);
        options.estimate = estimate;
        const DensityEstimator maker(photons, rays_, options, seed);
        Placed made = placed(maker, photons, options, seed);
        const bool hull = estimate == Estimate::hull;
        blended(hull ? "hull" : "kernel", maker, made.cache, seen, table);
        if (hull && known_.quantity == Quantity::indirect) indirect = std::move(made.cache);
      }
    }
    if (options_.gathering) gather(photons, seen, seed, table);
    if (options_.sensors) sensors(photons, indirect, seen, seed, table);
    if (options_.radiance && known_.even) radiance(photons, seen, seed, table);
  }

 private:
  RecordOptions of_photons(Quantity quantity) const {
    RecordOptions options;
    options.paths = quantity;
    options.resolve(known_.scene.bounds.diagonal_m() / 4);
    return options;
  }

  /// Records at points, and the light that a cache of these records gives between them.
  void blended(const std::string& name, const Estimator& estimator, const IrradianceCache& cache,
               const KnownPoints& seen, CalibrationTable& table) const {
    const auto add = [&](const std::string& what, std::size_t i, const Rgb& lx, const Rgb& stated_lx) {
      const double truth = seen.all[i] - (cache.quantity == Quantity::all ? 0 : seen.direct[i]);
      table[name + what].add(double(luminance(lx)),
                             std::hypot(double(luminance(stated_lx)), seen.all_error[i]), truth);
    };
    const auto worker = estimator.make_worker();
    for (std::size_t i = 0; i < std::min(seen.at.size(), static_cast<std::size_t>(options_.records)); ++i) {
      const IrradianceRecord r =
          estimator.make({seen.at[i].position, seen.at[i].normal, kPointItems + i}, *worker).record;
      add(" record", i, r.irradiance, r.stderr_lx);
    }
    RecordTree tree(known_.scene.bounds, reading_accuracy(cache.accuracy));
    for (const IrradianceRecord& r : cache.records) tree.insert(r);
    for (std::size_t i = 0; i < seen.at.size(); ++i) {
      const Interpolated e = tree.interpolate(seen.at[i].position, seen.at[i].normal);
      if (e.weight > 0) add(" blended", i, e.irradiance, e.stderr_lx);
    }
  }

  struct Placed {
    IrradianceCache cache;
    std::vector<RadianceRecord> radiance;  ///< of an estimator that makes such records
  };
  Placed placed(const Estimator& estimator, const PhotonMap& photons, const RecordOptions& options,
                std::uint64_t seed) const {
    Placed made;
    made.cache.accuracy = options.accuracy;
    made.cache.quantity = options.paths;
    Counters counters;
    made.radiance =
        place_records(made.cache, estimator, rays_, options, {},
                      photon_candidates(photons, Quantity::all, seed, options_.candidates), counters)
            .radiance;
    return made;
  }

  RecordOptions gathered(Quantity paths) const {
    RecordOptions options;
    options.estimate = Estimate::gather, options.paths = paths;
    options.rays = options_.rays;
    options.resolve(known_.scene.bounds.diagonal_m() / 4);
    return options;
  }

  void gather(const PhotonMap& photons, const KnownPoints& seen, std::uint64_t seed,
              CalibrationTable& table) const {
    const RecordOptions options = gathered(known_.quantity);
    const CoarseLevel coarse(rays_, photons, options, seed);
    const GatherEstimator estimator(rays_, lights_, coarse.source(), options, seed);
    blended("gather", estimator, placed(estimator, photons, options, seed).cache, seen, table);
  }

  void sensors(const PhotonMap& photons, const std::optional<IrradianceCache>& indirect,
               const KnownPoints& seen, std::uint64_t seed, CalibrationTable& table) const {
    const RecordOptions options = of_photons(Quantity::indirect);
    const DensityEstimator maker(photons, rays_, options, seed);
    SensorCaches caches({}, nullptr);
    caches.add(indirect ? *indirect : placed(maker, photons, options, seed).cache, "cache");
    Sensors sensors;
    sensors.points = seen.at;
    SensorOptions reading;
    reading.seed = seed;
    SensorReport report;
    // Without indirect light there is nothing to read in the cache.
    std::vector<Reading> readings;
    if (known_.interreflected) readings = read_light(sensors, rays_, lights_, caches, reading, report);
    reading.direct_only = true;
    const auto direct = read_light(sensors, rays_, lights_, caches, reading, report);
    for (std::size_t i = 0; i < seen.at.size(); ++i) {
      const auto add = [&](const char* what, const Reading& r, double truth, double error) {
        table[what].add(double(r.illuminance_lx), std::hypot(double(r.stderr_lx), error), truth);
      };
      if (known_.interreflected) add("sensor", readings[i], seen.all[i], seen.all_error[i]);
      add("sensor direct", direct[i], seen.direct[i], seen.direct_error[i]);
    }
  }

  /// For even light L, the light that leaves by a lobe f is L times the integral of f, in harmonics
  /// f_00 L sqrt(2 pi).
  void radiance(const PhotonMap& photons, const KnownPoints& seen, std::uint64_t seed,
                CalibrationTable& table) const {
    constexpr int kOrder = 5;
    const RecordOptions options = gathered(Quantity::indirect);
    const CoarseLevel coarse(rays_, photons, options, seed);
    const RadianceEstimator by_rays(rays_, lights_, coarse.source(), options, kOrder,
                                    RadianceGradient::hybrid, seed);
    const RecordOptions by_hull = of_photons(Quantity::indirect);
    const RadianceDensityEstimator by_photons(photons, rays_, by_hull, kOrder, RadianceGradient::analytic,
                                              seed);
    const double indirect = seen.all[0] - seen.direct[0];
    for (const Estimator* estimator :
         {static_cast<const Estimator*>(&by_rays), static_cast<const Estimator*>(&by_photons)}) {
      const bool rays = estimator == &by_rays;
      const std::string name = rays ? "radiance by rays" : "radiance by photons";
      const Placed made = placed(*estimator, photons, rays ? options : by_hull, seed);
      RadianceCache as_read;
      as_read.accuracy = options.accuracy;
      RadianceTree tree(known_.scene.bounds, reading_accuracy(as_read), kOrder);
      for (const RadianceRecord& r : made.radiance) tree.insert(r);
      RadianceTree::Worker memory;
      std::vector<float> lobe(3 * kOrder * kOrder, 0);
      for (std::size_t i = 0; i < seen.at.size(); ++i) {
        // A lobe of bell shape about a direction, by the harmonics there.
        const Frame frame = make_frame(seen.at[i].normal);
        lobe_about(sample_cosine(seed, i), lobe, kOrder);
        const GlossyLight found = tree.outgoing(seen.at[i].position, frame, lobe, Rgb(0), memory);
        if (!(found.weight > 0)) continue;
        const double truth = indirect / std::numbers::pi * double(lobe[0]) * std::sqrt(2 * std::numbers::pi);
        table[name + " through a lobe"].add(double(found.radiance.y), double(found.stderr_cd.y), truth);
      }
      blended(name, *estimator, made.cache, seen, table);
    }
  }
  static Vec3 sample_cosine(std::uint64_t seed, std::size_t i) {
    RandomStream random(seed, Stage::test, 1'000'000 + i);
    const Vec2 u = random.uniform2();
    const float r = std::sqrt(0.8f * u.x), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)};
  }
  static void lobe_about(const Vec3& w, std::vector<float>& lobe, int order) {
    const HarmonicBasis<double> basis(order);
    std::vector<double> value(static_cast<std::size_t>(basis.count()));
    basis.evaluate(BasisKind::hsh, double(w.x), double(w.y), double(w.z), value.data());
    for (int l = 0; l < order; ++l)
      for (int m = -l; m <= l; ++m) {
        const auto i = static_cast<std::size_t>(harmonic_index(l, m));
        for (std::size_t c = 0; c < 3; ++c)
          lobe[3 * i + c] = static_cast<float>(value[i] * std::exp(-0.12 * l * (l + 1)));
      }
  }

  KnownLight known_;
  CalibrationOptions options_;
  RayScene rays_;
  Luminaires lights_;
};

}  // namespace phos::test
