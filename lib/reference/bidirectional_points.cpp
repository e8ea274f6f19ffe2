#include "reference/bidirectional_points.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/progress.h"
#include "reference/moments.h"
#include "reference/passes.h"
#include "reference/sensor_disc.h"
#include "scene/material/sharp_materials.h"

namespace phos::inline reference {
namespace {

/// Passes that tell an error, at least; and sensor paths of a pass, at most.
constexpr std::int64_t kLeastPasses = 16, kUsualPasses = 32, kMostOfPass = 256;
/// Light paths of a pass where there is light by way of mirrors and glass: they cost one sensor little, and
/// many nothing.
constexpr std::size_t kLightPaths = 8192;
/// Light paths that tell the radius of the discs, and the random stream of the first.
constexpr std::size_t kProbingPaths = 65536;
constexpr std::uint64_t kProbingItem = kLightItem | std::uint64_t{1} << 56;
/// Radius of the largest disc over the radius of the scene.
constexpr float kLargestDisc = 0.25f;
constexpr std::size_t kPathsPerChunk = 64;

struct Part {
  DVec3 lux{0}, bias{0};
  std::uint64_t taken = 0, rejected = 0;
};

struct Sensor {
  SurfacePoint point;
  std::unique_ptr<SensorDisc> disc;
  double radius_m = 0;  // of the disc that weights are of
  DiscLight light;
  Moments bias[3], luminous_bias;  // of merging
  std::uint64_t samples = 0, rejected = 0;
  bool done = false;
};

class Measurement {
 public:
  Measurement(const RayScene& rays, const Luminaires& luminaires, std::span<const SensorPoint> sensors,
              const PointOptions& options)
      : lamps_(rays.scene(), luminaires),
        light_(rays, luminaires, lamps_, options.path),
        eyes_(rays, luminaires, lamps_, options.path),
        options_(options),
        caustic_(has_caustic_ways(rays.scene())),
        merge_radius_m_(caustic_ ? first_merge_radius_m(rays.scene()) : 0) {
    each_ = std::clamp(options.samples / kUsualPasses, std::int64_t{1}, kMostOfPass);
    passes_ = (options.samples + each_ - 1) / each_;
    light_paths_ =
        caustic_ ? std::max(kLightPaths, static_cast<std::size_t>(each_)) : static_cast<std::size_t>(each_);
    sensors_.resize(sensors.size());
    for (std::size_t i = 0; i < sensors.size(); ++i)
      sensors_[i].point = sensor_at(rays.scene(), sensors[i].position, sensors[i].normal);
    if (caustic_) set_discs(rays);
  }

  std::vector<PointIrradiance> run();

 private:
  void set_discs(const RayScene& rays);
  void take_pass(std::uint64_t pass);
  double eta_of(const Sensor& sensor) const {
    const double each = static_cast<double>(light_paths_) / static_cast<double>(each_);
    return sensor.disc ? sensor.disc->eta(sensor.radius_m, each) : 0;
  }
  Part sample(std::size_t sensor, const LightPass& light, std::uint64_t pass, std::size_t begin,
              std::size_t end) const;

  LightStarts lamps_;
  LightTracer light_;
  BidirectionalTracer eyes_;
  PointOptions options_;
  bool caustic_;
  float merge_radius_m_;
  std::int64_t each_ = 1, passes_ = 1;
  std::size_t light_paths_ = 1;
  std::vector<Sensor> sensors_;
};

void Measurement::set_discs(const RayScene& rays) {
  const LightPaths probe = trace_light(light_, options_.seed, kProbingItem, kProbingPaths, 0, true);
  // Where noise and bias are alike, the radius falls as the sixth root of the number of paths.
  const double fewer =
      std::pow(static_cast<double>(kProbingPaths) / static_cast<double>(light_paths_), 1.0 / 6);
  const float most_m = kLargestDisc * bounding_radius_m(rays.scene());
  parallel_for(sensors_.size(), 1, [&](std::size_t i) {
    Sensor& s = sensors_[i];
    s.disc = std::make_unique<SensorDisc>(rays, s.point, most_m);
    s.radius_m = std::min(static_cast<double>(most_m), fewer * s.disc->balanced_radius_m(probe));
    s.light = DiscLight(s.disc->areas_m2());
  });
}

Part Measurement::sample(std::size_t sensor, const LightPass& light, std::uint64_t pass, std::size_t begin,
                         std::size_t end) const {
  const Sensor& s = sensors_[sensor];
  const double eta = eta_of(s);
  Part part;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint64_t number = pass * static_cast<std::uint64_t>(each_) + i;
    RandomStream random(options_.seed, Stage::reference, ((options_.item + sensor) << 32) | number);
    const BidirectionalSample sample = eyes_.irradiance(s.point, eta, light, i, random);
    const Rgb lux = sample.sum.total();
    ++part.taken;
    if (!is_finite(lux) || !is_finite(sample.bias)) {
      ++part.rejected;
      continue;
    }
    part.lux += DVec3(lux), part.bias += DVec3(sample.bias);
  }
  return part;
}

void Measurement::take_pass(std::uint64_t pass) {
  const double shrunk = std::sqrt(shrunk_area(pass));
  const LightPass light =
      make_pass(light_, options_.seed, pass, light_paths_, merge_radius_m_ * static_cast<float>(shrunk));
  const auto each = static_cast<std::size_t>(each_);
  const std::size_t chunks = (each + kPathsPerChunk - 1) / kPathsPerChunk;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    if (!sensors_[i].done) open.push_back(i);
  std::vector<Part> parts(open.size() * chunks);
  std::vector<DiscPass> discs(open.size());
  parallel_for(parts.size(), 1, [&](std::size_t k) {
    const Sensor& s = sensors_[open[k / chunks]];
    const std::size_t chunk = k % chunks, begin = chunk * kPathsPerChunk;
    parts[k] = sample(open[k / chunks], light, pass, begin, std::min(each, begin + kPathsPerChunk));
    if (chunk == 0 && s.disc)
      discs[k / chunks] = s.disc->light(light.paths, eta_of(s), options_.path.bounces);
  });
  for (std::size_t k = 0; k < open.size(); ++k) {
    Sensor& s = sensors_[open[k]];
    Part sum;
    for (std::size_t c = 0; c < chunks; ++c) {
      const Part& p = parts[k * chunks + c];
      sum.lux += p.lux, sum.bias += p.bias, sum.taken += p.taken, sum.rejected += p.rejected;
    }
    s.samples += sum.taken, s.rejected += sum.rejected;
    if (sum.taken == sum.rejected) continue;
    const auto n = static_cast<double>(sum.taken - sum.rejected);
    s.light.add(sum.lux / n, discs[k]);
    for (int c = 0; c < 3; ++c) s.bias[c].add(sum.bias[c] / n);
    s.luminous_bias.add(static_cast<double>(luminance(Rgb(sum.bias / n))));
  }
}

std::vector<PointIrradiance> Measurement::run() {
  std::int64_t check = kLeastPasses;
  Progress progress("reference", static_cast<std::uint64_t>(passes_), "passes");
  for (std::int64_t pass = 0; pass < passes_; ++pass) {
    take_pass(static_cast<std::uint64_t>(pass));
    progress.advance();
    if (!options_.relative_error || pass + 1 < check) continue;
    check *= 2;
    bool all = true;
    for (Sensor& s : sensors_) {
      const DiscLight::Estimate e = s.light.estimate();
      s.done =
          s.done || with_bias(e.stderr_lx, s.luminous_bias) <= *options_.relative_error * e.illuminance_lx;
      all = all && s.done;
    }
    if (all) break;
  }
  std::vector<PointIrradiance> result;
  for (const Sensor& s : sensors_) {
    PointIrradiance e;
    const DiscLight::Estimate all = s.light.estimate();
    for (int c = 0; c < 3; ++c) {
      e.irradiance_lx[c] = static_cast<float>(all.lux[c]);
      e.stderr_lx[c] = static_cast<float>(with_bias(all.error[c], s.bias[c]));
    }
    e.illuminance_lx = all.illuminance_lx;
    e.illuminance_stderr_lx = with_bias(all.stderr_lx, s.luminous_bias);
    e.samples = s.samples, e.rejected = s.rejected;
    result.push_back(e);
  }
  return result;
}

}  // namespace

std::vector<PointIrradiance> estimate_bidirectionally(const RayScene& rays, const Luminaires& luminaires,
                                                      std::span<const SensorPoint> sensors,
                                                      const PointOptions& options) {
  if (sensors.empty()) return {};
  return Measurement(rays, luminaires, sensors, options).run();
}

}  // namespace phos::inline reference
