#include "direct/direct_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "direct/ray_shares.h"

namespace phos::inline direct {
namespace {

/// Rays of a pilot to each lamp of an extent, and where these are more than that. Powers of 4 (sobol_set()).
constexpr int kPilotRays = 64, kPilotRaysOfMany = 16, kManyLamps = 16;
/// A sky gets a larger pilot where fewer than kFewArrive of the pilot's rays arrive: the point sees it
/// through gaps, or not at all.
constexpr int kFewArrive = 16, kSkyPilotRays = 1024;
/// With so few arriving rays, one set of points does not tell the error.
constexpr int kTooFewArrive = 4;
/// No lamp gets fewer: the error of fewer points is not told well by themselves. Where lamps are many, their
/// errors' scatter evens out.
constexpr int kLeastRays = 64, kLeastRaysOfMany = 16;
/// More lamps than these that stand somewhere are sampled by a cut: 1 % of a hall with partitions takes 300
/// to 1000 rays, and a ray to each is exact.
constexpr std::size_t kFewLamps = 1000;
/// Nodes of a cut: of the pilot, and at most. Its standard error falls as this power of them, measured in
/// halls: 1 without partitions; with them 0.85 up to 64 nodes, 0.7 above (docs/methods.md#t2: 1.05).
constexpr int kPilotNodes = 32, kMostNodes = 4096;
constexpr double kCutFall = 0.8, kCutMargin = 0.9;
/// A cut of more than this part of all lamps had better be all of them.
constexpr double kNearlyAll = 1 / 3.;
/// The stated error of the final rays scatters about the error that the pilot predicts.
constexpr double kMargin = 0.8;

double lux(const DVec3& e) { return static_cast<double>(luminance(Rgb(e))); }

std::uint64_t number_of(const std::vector<LightSamples>& counts) {
  std::uint64_t sum = 0;
  for (const LightSamples& count : counts) sum += static_cast<std::uint64_t>(count.samples);
  return sum;
}

}  // namespace

/// What it found of each aimed light, and of the cut.
struct DirectReader::Pilot {
  std::vector<LightSamples> counts;
  std::vector<LampSum> found;
  std::vector<int> arrived;
  CutLight cut;
  std::uint64_t rays = 0;
  int least = kLeastRays;  // of the final ones, to each lamp
};

DirectReader::DirectReader(const RayScene& rays, const Luminaires& lights) : rays_(rays), lights_(lights) {
  std::size_t standing = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) standing += LightTree::holds(lights[i]);
  if (standing > kFewLamps && lights.mirrors().empty()) tree_.emplace(rays.scene(), lights);
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (!tree_ || !LightTree::holds(lights[i])) aimed_.push_back(i);
}

DirectReader::Pilot DirectReader::send_pilot(const SurfacePoint& at, std::uint64_t seed,
                                             std::uint64_t item) const {
  Pilot pilot;
  int extended = 0;
  for (const std::uint32_t i : aimed_) extended += lights_[i].extended();
  const int each = extended > kManyLamps ? kPilotRaysOfMany : kPilotRays;
  if (extended > kManyLamps) pilot.least = kLeastRaysOfMany;
  for (const std::uint32_t i : aimed_) pilot.counts.push_back({i, lights_[i].extended() ? each : 0});
  RandomStream random(seed, Stage::direct_light, item);
  random.start_bounce(1);
  std::vector<LampSample> lamps;
  sample_lamps(rays_, lights_, at, pilot.counts, PointOrder::Kind::sobol, random, lamps);
  pilot.found = sums_of(lamps, pilot.counts, lights_);
  pilot.rays = number_of(pilot.counts);
  pilot.arrived.assign(aimed_.size(), 0);
  for (std::size_t k = 0; k < aimed_.size(); ++k)
    for (const LampSample& lamp : lamps) pilot.arrived[k] += lamp.light == aimed_[k];
  if (tree_) {
    random.start_bounce(3);
    pilot.cut = light_by_cut(rays_, lights_, *tree_, at, kPilotNodes, random);
    pilot.rays += pilot.cut.rays;
  }
  for (std::size_t k = 0; k < aimed_.size(); ++k) {
    if (lights_[aimed_[k]].kind != Light::Kind::environment || pilot.arrived[k] >= kFewArrive) continue;
    const std::vector<LightSamples> more{{aimed_[k], kSkyPilotRays}};
    pilot.counts[k] = more[0];
    random.start_bounce(2);
    sample_lamps(rays_, lights_, at, more, PointOrder::Kind::sobol, random, lamps);
    pilot.rays += number_of(more);
    pilot.found[k] = sums_of(lamps, more, lights_)[0];
    pilot.arrived[k] = static_cast<int>(lamps.size());
  }
  return pilot;
}

DirectReading DirectReader::read(const SurfacePoint& at, int samples, std::uint64_t seed,
                                 std::uint64_t item) const {
  RandomStream random(seed, Stage::direct_light, item);
  const DirectIrradiance e = direct_irradiance(rays_, lights_, at, samples, random);
  std::uint64_t rays = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    rays += lights_[i].extended() ? static_cast<std::uint64_t>(std::max(samples, 1)) : 1;
  return {e.irradiance, e.stderr_lx, rays, true};
}

/// A cut of all lamps without area has no error.
CutLight DirectReader::read_cut(const SurfacePoint& at, double stderr_lx, const CutLight& pilot,
                                RandomStream& random) const {
  const double ratio = lux(glm::sqrt(pilot.variance)) / (kCutMargin * stderr_lx);
  double nodes = ratio > 0 ? kPilotNodes * std::pow(ratio, 1 / kCutFall) : kPilotNodes;
  if (!(nodes < kMostNodes)) nodes = kMostNodes;
  nodes = std::max(std::ceil(nodes), double{kPilotNodes});
  const auto all = static_cast<double>(tree_->lamps());
  if (nodes > kNearlyAll * all) nodes = all;
  return light_by_cut(rays_, lights_, *tree_, at, static_cast<std::size_t>(nodes), random);
}

DirectReading DirectReader::read(const SurfacePoint& at, const DirectTarget& target, std::uint64_t seed,
                                 std::uint64_t item) const {
  const Pilot pilot = send_pilot(at, seed, item);
  // Of lamps without an extent the light is known once it is looked for: their rays come first.
  RandomStream random(seed, Stage::direct_light, item);
  std::vector<LampSample> lamps;
  std::vector<LightSamples> counts;
  for (const std::uint32_t i : aimed_) counts.push_back({i, !lights_[i].extended()});
  sample_lamps(rays_, lights_, at, counts, PointOrder::Kind::sobol, random, lamps);
  std::uint64_t sent = pilot.rays + number_of(counts);
  LampSum sum;
  sum.irradiance = light_of(lamps);

  double direct_lx = lux(sum.irradiance + pilot.cut.irradiance);
  std::vector<PilotNoise> noise;
  std::vector<std::uint32_t> of;
  bool noisy = false;
  for (std::size_t k = 0; k < aimed_.size(); ++k) {
    const std::uint32_t i = aimed_[k];
    if (!lights_[i].extended()) continue;
    direct_lx += lux(pilot.found[k].irradiance);
    const double stderr_lx = lux(glm::sqrt(pilot.found[k].variance));
    const int pilot_rays = pilot.counts[k].samples;
    const bool unsure = pilot.arrived[k] < kTooFewArrive && lights_[i].kind == Light::Kind::environment;
    const bool sets =
        points_of(rays_.scene(), lights_, i, PointOrder::Kind::sobol) == PointOrder::Kind::sobol;
    noise.push_back({stderr_lx * stderr_lx, pilot_rays, unsure ? pilot_rays : pilot.least, sets});
    of.push_back(i), noisy = noisy || stderr_lx > 0;
  }
  double stderr_lx =
      kMargin * target.relative_error * (target.known_lx + (target.holds_direct ? 0 : direct_lx));
  if (noisy && tree_ && !pilot.cut.exact) stderr_lx *= std::numbers::sqrt2 / 2;  // half the variance each
  const std::vector<int> shares = share_rays(noise, stderr_lx, kMostRays);
  counts.clear();
  for (std::size_t k = 0; k < of.size(); ++k) counts.push_back({of[k], shares[k]});
  random.start_bounce(0);
  sample_lamps(rays_, lights_, at, counts, PointOrder::Kind::sobol, random, lamps);
  sent += number_of(counts);
  for (const LampSum& found : sums_of(lamps, counts, lights_))
    sum.irradiance += found.irradiance, sum.variance += found.variance;
  if (tree_) {
    random.start_bounce(4);
    const CutLight cut = read_cut(at, stderr_lx, pilot.cut, random);
    sum.irradiance += cut.irradiance, sum.variance += cut.variance;
    sent += cut.rays;
  }
  const double read_lx = lux(sum.irradiance), found_lx = lux(glm::sqrt(sum.variance)),
               of_lx = target.known_lx + (target.holds_direct ? 0 : read_lx);
  return {Rgb(sum.irradiance), Rgb(glm::sqrt(sum.variance)), sent, found_lx <= target.relative_error * of_lx};
}

}  // namespace phos::inline direct
