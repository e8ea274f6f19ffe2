// How often the truth lies within two stated standard errors, over many seeds.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "cache/radiance_density.h"
#include "cache/radiance_gather.h"
#include "cache/sensors.h"
#include "cache/two_level.h"
#include "support/records.h"

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
  /// Root mean square of the true over that of the stated errors.
  double ratio() const { return std::sqrt(off2 / stated2); }
  /// Mean error, in stated errors.
  double bias() const { return off / n / std::sqrt(stated2 / n); }
};

/// One scene, again and again with other random numbers. By estimator, what was found.
using CalibrationTable = std::map<std::string, Calibration>;

struct CalibrationOptions {
  std::int64_t paths = 400'000;  ///< that leave so many photons with an albedo of 0
  std::int64_t candidates = 20000;
  int points = 64;  ///< of a picture at which caches are read
  int records = 8;  ///< of them, those at which records are made
  std::int64_t rays = 256;
  bool photons = true, gathering = true, radiance = true, sensors = true;

  /// For tests: seconds for a dozen seeds.
  static CalibrationOptions small() {
    CalibrationOptions options;
    options.paths = 40'000, options.candidates = 1500, options.rays = 128;
    options.points = 40, options.records = 8;
    return options;
  }
};

/// Points that the scene's camera sees on surfaces that reflect and are lit; `truth` in lx.
struct SeenPoints {
  std::vector<SurfaceSample> at;
  std::vector<double> truth;
};

class CalibratedScene {
 public:
  CalibratedScene(const AnalyticScene& scene, const CalibrationOptions& options)
      : s_(scene), options_(options), rays_(s_.scene), lights_(s_.scene) {}

  const std::string name() const {
    const float albedo = s_.scene.material[0].kd.x;
    return s_.name == "furnace" ? s_.name + " " + std::to_string(albedo).substr(0, 4) : s_.name;
  }

  void measure(std::uint64_t seed, CalibrationTable& table) const {
    const SeenPoints seen = points(seed);
    const float albedo = s_.scene.material[0].kd.x;
    const auto paths =
        static_cast<std::int64_t>(static_cast<double>(options_.paths) * std::max(0.02, 1 - double(albedo)));
    const Lit lit = light_up(s_.scene, paths, seed);
    if (options_.photons) {
      for (const Estimate estimate : {Estimate::hull, Estimate::kernel}) {
        RecordOptions options = all_light(s_.scene);
        options.estimate = estimate;
        const RecordMaker maker(lit.photons, *lit.rays, options, seed);
        blended(estimate == Estimate::hull ? "hull" : "kernel", maker, lit, options, seen, seed, table);
      }
    }
    if (options_.gathering) gather(lit, seen, seed, table);
    if (options_.sensors) sensors(lit, seen, seed, table);
    if (options_.radiance && s_.name == "furnace") radiance(lit, seen, seed, table);
  }

 private:
  SeenPoints points(std::uint64_t seed) const {
    SeenPoints seen;
    for (std::uint64_t i = 0; seen.at.size() < static_cast<std::size_t>(options_.points) && i < 100000; ++i) {
      RandomStream random(seed, Stage::test, i);
      const Camera::Ray ray = s_.scene.camera[0].ray(random.uniform2(), 1);
      SurfacePoint point;
      if (!trace(rays_, {ray.origin, ray.direction}, point)) continue;
      if (!(max_component(s_.scene.material[point.material].kd) > 0)) continue;
      const double truth = s_.irradiance_lx(point.position, point.normal);
      if (!(truth > 0)) continue;
      seen.at.push_back({point.position, point.normal}), seen.truth.push_back(truth);
    }
    return seen;
  }
  double direct_lx() const { return s_.irradiance_lx ? furnace_direct() : 0; }
  double furnace_direct() const {
    return s_.name == "furnace" ? std::numbers::pi * double(s_.scene.material[0].emission.y) : 0;
  }

  /// Records at points, and what a cache of them says between them.
  void blended(const std::string& name, const Estimator& estimator, const Lit& lit,
               const RecordOptions& options, const SeenPoints& seen, std::uint64_t seed,
               CalibrationTable& table, double left_out = 0) const {
    const auto worker = estimator.make_worker();
    for (std::size_t i = 0; i < std::min(seen.at.size(), static_cast<std::size_t>(options_.records)); ++i) {
      const IrradianceRecord r =
          estimator.make({seen.at[i].position, seen.at[i].normal, kPointItems + i}, *worker).record;
      table[name + " record"].add(double(r.irradiance.y), double(r.stderr_lx.y), seen.truth[i] - left_out);
    }
    const IrradianceCache cache = placed(estimator, lit, options, seed);
    RecordTree tree(s_.scene.bounds, reading_accuracy(cache.accuracy));
    for (const IrradianceRecord& r : cache.records) tree.insert(r);
    for (std::size_t i = 0; i < seen.at.size(); ++i) {
      const Interpolated e = tree.interpolate(seen.at[i].position, seen.at[i].normal);
      if (e.weight > 0)
        table[name + " blended"].add(double(e.irradiance.y), double(e.stderr_lx.y), seen.truth[i] - left_out);
    }
  }

  IrradianceCache placed(const Estimator& estimator, const Lit& lit, const RecordOptions& options,
                         std::uint64_t seed) const {
    IrradianceCache cache;
    cache.accuracy = options.accuracy;
    cache.quantity = options.paths == Quantity::all ? "all" : "indirect";
    Counters counters;
    place_records(cache, estimator, *lit.rays, options, {},
                  photon_candidates(lit.photons, Quantity::all, seed, options_.candidates), counters);
    return cache;
  }

  RecordOptions gathered(Quantity paths) const {
    RecordOptions options;
    options.estimate = Estimate::gather, options.paths = paths;
    options.rays = options_.rays;
    options.resolve(s_.scene.bounds.diagonal_m());
    return options;
  }

  void gather(const Lit& lit, const SeenPoints& seen, std::uint64_t seed, CalibrationTable& table) const {
    const RecordOptions options = gathered(Quantity::all);
    const CoarseLevel coarse(*lit.rays, lit.photons, options, seed);
    const GatherEstimator estimator(*lit.rays, lights_, coarse.source(), options, seed);
    blended("gather", estimator, lit, options, seen, seed, table);
  }

  void sensors(const Lit& lit, const SeenPoints& seen, std::uint64_t seed, CalibrationTable& table) const {
    RecordOptions options = all_light(s_.scene);
    options.paths = Quantity::indirect;
    const RecordMaker maker(lit.photons, *lit.rays, options, seed);
    SensorCaches caches({}, nullptr);
    caches.add(placed(maker, lit, options, seed), "cache");
    Sensors sensors;
    sensors.points = seen.at;
    SensorOptions reading;
    reading.seed = seed;
    SensorReport report;
    const auto readings = read_light(sensors, *lit.rays, lights_, caches, reading, report);
    reading.direct_only = true;
    const auto direct = read_light(sensors, *lit.rays, lights_, caches, reading, report);
    for (std::size_t i = 0; i < seen.at.size(); ++i) {
      // Without indirect light there is nothing to read in the cache: all is direct.
      if (s_.name == "furnace")
        table["sensor"].add(double(readings[i].illuminance_lx), double(readings[i].stderr_lx), seen.truth[i]);
      const double truth = s_.name == "furnace" ? direct_lx() : seen.truth[i];
      table["sensor direct"].add(double(direct[i].illuminance_lx), double(direct[i].stderr_lx), truth);
    }
  }

  /// Of even light L: what leaves by a lobe f is L times the integral of f, in harmonics f_00 L sqrt(2 pi).
  void radiance(const Lit& lit, const SeenPoints& seen, std::uint64_t seed, CalibrationTable& table) const {
    constexpr int kOrder = 5;
    const RecordOptions options = gathered(Quantity::indirect);
    const CoarseLevel coarse(*lit.rays, lit.photons, options, seed);
    const RadianceEstimator by_rays(*lit.rays, lights_, coarse.source(), options, kOrder,
                                    RadianceGradient::hybrid, seed);
    RecordOptions by_hull = all_light(s_.scene);
    by_hull.paths = Quantity::indirect;
    const RadianceDensityEstimator by_photons(lit.photons, *lit.rays, by_hull, kOrder,
                                              RadianceGradient::analytic, seed);
    const double indirect = seen.truth[0] - direct_lx();
    for (const Estimator* estimator :
         {static_cast<const Estimator*>(&by_rays), static_cast<const Estimator*>(&by_photons)}) {
      const bool rays = estimator == &by_rays;
      const std::string name = rays ? "radiance by rays" : "radiance by photons";
      IrradianceCache cache;
      cache.accuracy = options.accuracy;
      Counters counters;
      const PlacementReport report =
          place_records(cache, *estimator, *lit.rays, rays ? options : by_hull, {},
                        photon_candidates(lit.photons, Quantity::all, seed, options_.candidates), counters);
      RadianceTree tree(s_.scene.bounds, reading_accuracy(options.accuracy, 0.75), kOrder);
      for (const RadianceRecord& r : report.radiance) tree.insert(r);
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
      blended(name, *estimator, lit, rays ? options : by_hull, seen, seed, table, direct_lx());
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

  AnalyticScene s_;
  CalibrationOptions options_;
  RayScene rays_;
  Luminaires lights_;
};

}  // namespace phos::test
