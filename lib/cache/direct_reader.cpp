#include "cache/direct_reader.h"

#include <algorithm>
#include <numeric>

#include "cache/ray_shares.h"

namespace phos {
namespace {

/// Rays of a pilot to each lamp of an extent, and where these are more than that. Powers of 4 (sobol_set()).
constexpr int kPilotRays = 64, kPilotRaysOfMany = 16, kManyLamps = 16;
/// A sky of which fewer of those arrive is seen through gaps, or not at all: it gets a larger pilot.
constexpr int kFewArrive = 16, kSkyPilotRays = 1024;
/// The error of so few of them is not to be told from one set.
constexpr int kTooFewArrive = 4;
/// No lamp gets fewer: the error of fewer points is not told well by themselves. Where lamps are many, their
/// errors' scatter evens out.
constexpr int kLeastRays = 64, kLeastRaysOfMany = 16;
/// The stated error of the final rays scatters about what the pilot foretells.
constexpr double kMargin = 0.8;

double lux(const DVec3& e) { return static_cast<double>(luminance(Rgb(e))); }

std::uint64_t number_of(const std::vector<int>& rays) {
  return static_cast<std::uint64_t>(std::accumulate(rays.begin(), rays.end(), 0ll));
}

DirectReading reading_of(const std::vector<LampSum>& sums, std::uint64_t rays) {
  LampSum all;
  for (const LampSum& sum : sums) all.irradiance += sum.irradiance, all.variance += sum.variance;
  return {Rgb(all.irradiance), Rgb(glm::sqrt(all.variance)), rays, true};
}

}  // namespace

struct DirectReader::Pilot {
  std::vector<int> samples;
  std::vector<LampSum> found;
  std::vector<int> arrived;
  std::uint64_t rays = 0;
  int least = kLeastRays;  // of the final ones, to each lamp
};

DirectReader::Pilot DirectReader::send_pilot(const SurfacePoint& at, std::uint64_t seed,
                                             std::uint64_t item) const {
  const std::size_t n = lights_.size();
  Pilot pilot{std::vector<int>(n), {}, std::vector<int>(n)};
  int extended = 0;
  for (std::size_t i = 0; i < n; ++i) extended += lights_[i].extended();
  const int each = extended > kManyLamps ? kPilotRaysOfMany : kPilotRays;
  if (extended > kManyLamps) pilot.least = kLeastRaysOfMany;
  for (std::size_t i = 0; i < n; ++i) pilot.samples[i] = lights_[i].extended() ? each : 0;
  RandomStream random(seed, Stage::direct_light, item);
  random.start_bounce(1);
  std::vector<LampSample> lamps;
  sample_lamps(rays_, lights_, at, pilot.samples, PointOrder::Kind::sobol, random, lamps);
  pilot.rays = number_of(pilot.samples);
  pilot.found = sums_of(lamps, pilot.samples, lights_);
  for (const LampSample& lamp : lamps) ++pilot.arrived[lamp.light];
  const std::int32_t sky = lights_.environment();
  const auto s = static_cast<std::size_t>(sky);
  if (sky < 0 || pilot.arrived[s] >= kFewArrive) return pilot;
  std::vector<int> more(n, 0);
  more[s] = pilot.samples[s] = kSkyPilotRays;
  random.start_bounce(2);
  sample_lamps(rays_, lights_, at, more, PointOrder::Kind::sobol, random, lamps);
  pilot.rays += number_of(more);
  pilot.found[s] = sums_of(lamps, more, lights_)[s];
  pilot.arrived[s] = static_cast<int>(lamps.size());
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

DirectReading DirectReader::read(const SurfacePoint& at, const DirectTarget& target, std::uint64_t seed,
                                 std::uint64_t item) const {
  const Pilot pilot = send_pilot(at, seed, item);
  // Of lamps without an extent the light is known once it is looked for: their rays come first.
  RandomStream random(seed, Stage::direct_light, item);
  std::vector<LampSample> lamps;
  std::vector<int> samples(lights_.size());
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = !lights_[i].extended();
  sample_lamps(rays_, lights_, at, samples, PointOrder::Kind::sobol, random, lamps);
  std::vector<LampSum> sums = sums_of(lamps, samples, lights_);

  double direct_lx = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    direct_lx += lux(sums[i].irradiance + pilot.found[i].irradiance);
  const double all_lx = target.known_lx + (target.holds_direct ? 0 : direct_lx);
  std::vector<PilotNoise> noise;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!lights_[i].extended()) continue;
    const double stderr_lx = lux(glm::sqrt(pilot.found[i].variance));
    const bool sky = lights_[i].kind == Light::Kind::environment;
    const bool unsure = sky && pilot.arrived[i] < kTooFewArrive;
    noise.push_back(
        {stderr_lx * stderr_lx, pilot.samples[i], unsure ? pilot.samples[i] : pilot.least,
         points_of(rays_.scene(), lights_, i, PointOrder::Kind::sobol) == PointOrder::Kind::sobol});
    of.push_back(i);
  }
  const std::uint64_t before = pilot.rays + number_of(samples);
  std::ranges::fill(samples, 0);
  const std::vector<int> shares = share_rays(noise, kMargin * target.relative_error * all_lx, kMostRays);
  for (std::size_t k = 0; k < of.size(); ++k) samples[of[k]] = shares[k];
  random.start_bounce(0);
  sample_lamps(rays_, lights_, at, samples, PointOrder::Kind::sobol, random, lamps);
  const std::vector<LampSum> extended = sums_of(lamps, samples, lights_);
  for (const std::size_t i : of) sums[i] = extended[i];

  DirectReading reading = reading_of(sums, before + number_of(samples));
  const auto read_lx = static_cast<double>(luminance(reading.irradiance));
  const double of_lx = target.known_lx + (target.holds_direct ? 0 : read_lx);
  reading.met = static_cast<double>(luminance(reading.stderr_lx)) <= target.relative_error * of_lx;
  return reading;
}

}  // namespace phos
