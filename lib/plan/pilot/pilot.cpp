#include "plan/pilot/pilot.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "estimate/hemisphere/hemisphere.h"
#include "file/atomic_file.h"
#include "plan/calibration.h"
#include "plan/pilot/models.h"
#include "plan/pilot/runs.h"

namespace phos::inline plan {
namespace {

// Settings of the small runs: cheap, and far enough apart to tell the terms from each other.
constexpr double kPhotons[] = {20000, 160000};
constexpr double kAccuracy[] = {0.4, 0.2};
constexpr double kLuxAccuracy = 0.1;  ///< the finer one, without a picture
constexpr int kRings[] = {3, 9, 6};   ///< of records' rays: 27, 252, 114
constexpr int kCountRings = 3;        ///< of records that are made to be counted
struct Samples {
  double pixel, edge, light, gloss;
};
constexpr Samples kSamples[] = {{1, 1, 2, 128}, {1, 1, 256, 4},   {1, 16, 16, 16},
                                {4, 4, 32, 32}, {1, 64, 64, 256}, {32, 64, 32, 32}};
/// Gloss finds lamps by rays of both kinds: few of both; and many of both, shared by many samples.
constexpr Samples kInGloss[] = {{1, 1, 2, 2}, {32, 64, 256, 64}};
constexpr Samples kFine = {32, 64, 32, 32};
constexpr Samples kTimed[] = {{1, 16, 8, 4}, {4, 16, 8, 4}};  ///< at the full size
constexpr double kSensorRays[] = {4, 64};
constexpr double kReferenceSamples = 32;  ///< of the first, of a pixel
constexpr double kReferencePaths = 4096;  ///< and of a sensor
constexpr double kMostSamples = 1 << 22;
constexpr double kReferenceShare = 0.5;  ///< of the pilot's time, for references

Knobs knobs_of(double photons, double accuracy, int rings) {
  Knobs k{};
  k[at(Knob::photons)] = photons, k[at(Knob::accuracy)] = accuracy;
  k[at(Knob::rays)] = static_cast<double>(cells_of(rings));
  k[at(Knob::read)] = records_read(accuracy);
  for (const Knob knob :
       {Knob::pixel_samples, Knob::edge_samples, Knob::light_rays, Knob::gloss_rays, Knob::sensor_rays})
    k[at(knob)] = 1;
  return k;
}

Knobs with(Knobs k, const Samples& s) {
  k[at(Knob::pixel_samples)] = s.pixel, k[at(Knob::edge_samples)] = s.edge;
  k[at(Knob::light_rays)] = s.light, k[at(Knob::gloss_rays)] = s.gloss;
  return k;
}

Observation observed(const Knobs& knobs, double value, double sigma) {
  return {knobs, value, std::hypot(sigma, calibration::kOwnDoubt * std::fabs(value)) + 1e-12};
}

void fit(PlanModel& model, const std::string& part, const std::vector<Observation>& rows,
         std::uint64_t seed) {
  model.find(part)->fit(rows, seed);
}

/// Makes the pair of references that the rest is judged by: a first cheap one tells how noisy a better one
/// has to be. Returns its doubts.
ReferenceDoubts choose_references(PilotRuns& runs, bool lux, double target, double seconds,
                                  ReferenceCost& cost) {
  double samples = lux ? kReferencePaths : kReferenceSamples;
  ReferenceRun run = runs.references(lux, samples);
  cost.variance = run.variance * samples;
  const double per_place = run.seconds / samples / run.places;  // of one of the pair; its start is in it
  cost.sample_s = per_place, cost.places = run.places;
  // How noisy they are is not known from few bright paths.
  const double wanted = std::max(cost.samples(target), run.doubts.too_few_bright() ? kMostSamples : 0.0),
               affordable = seconds / 2 / std::max(per_place * run.places, 1e-12);
  const double better = std::floor(std::min({wanted, affordable, kMostSamples}));
  if (better < 2 * samples) return run.doubts;
  run = runs.references(lux, better);
  const double first = per_place * samples * run.places;
  cost.sample_s = std::max(run.seconds - first, 0.1 * run.seconds) / (better - samples) / run.places;
  cost.fixed_s = std::max(0.0, first - cost.sample_s * samples * run.places);
  cost.variance = run.variance * better;
  return run.doubts;
}

double resolution_of(const std::vector<Observation>& bias_rows) {
  double least = HUGE_VAL;
  for (const Observation& o : bias_rows) least = std::min(least, o.sigma);
  return std::isfinite(least) ? std::sqrt(2 * least) : 0;
}

struct Rows {
  std::vector<Observation> direct_noise, gloss_noise, seen_bias, indirect_noise, indirect_bias;
};

/// `own_noise`: of the records, which all that is made with one pair of caches shares, this is the
/// measurement.
void add_rows(Rows& rows, const Knobs& k, const SeparatedLayers& s, bool with_direct, bool own_noise) {
  if (own_noise) rows.indirect_noise.push_back(observed(k, s.indirect.noise2, s.indirect.noise2_sigma));
  rows.indirect_bias.push_back(observed(k, s.indirect.bias2, s.indirect.bias2_sigma));
  if (!with_direct) return;
  rows.direct_noise.push_back(observed(k, s.direct.noise2, s.direct.noise2_sigma));
  rows.gloss_noise.push_back(observed(k, s.gloss.noise2, s.gloss.noise2_sigma));
  // What edges do to both kinds of light goes together: the whole less the indirect part.
  rows.seen_bias.push_back(
      observed(k, s.whole.bias2 - s.indirect.bias2, std::hypot(s.whole.bias2_sigma, s.indirect.bias2_sigma)));
}

void fit_errors(PlanModel& model, const Rows& rows, std::uint64_t seed, const char* seen) {
  model.find("direct light, noise")->fit_noise(rows.direct_noise, seed + 1);
  fit(model, text(seen, ", bias"), rows.seen_bias, seed + 2);
  model.find("indirect light, noise")->fit_noise(rows.indirect_noise, seed + 3);
  fit(model, "indirect light, bias", rows.indirect_bias, seed + 4);
  if (Posynomial* gloss = model.find("gloss, noise")) gloss->fit_noise(rows.gloss_noise, seed + 5);
}

}  // namespace

std::vector<Knobs> pilot_caches(bool image) {
  return {knobs_of(kPhotons[0], kAccuracy[0], kRings[0]), knobs_of(kPhotons[0], kAccuracy[0], kRings[1]),
          knobs_of(kPhotons[1], kAccuracy[0], kRings[1]),
          knobs_of(kPhotons[1], image ? kAccuracy[1] : kLuxAccuracy, kRings[2])};
}

std::vector<Knobs> pilot_pictures(bool gloss) {
  std::vector<Samples> samples(std::begin(kSamples), std::end(kSamples));
  if (gloss) samples.insert(samples.end(), std::begin(kInGloss), std::end(kInGloss));
  std::vector<Knobs> pictures;
  for (const Samples& s : samples) pictures.push_back(with(pilot_caches(true).back(), s));
  return pictures;
}

Pilot run_pilot(const PlanTask& task, const PilotOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  PilotRuns runs(task, options);
  Pilot pilot;
  pilot.time = time_model(task);
  const int kinds = (task.image ? 1 : 0) + (task.lux ? 1 : 0);
  for (const bool lux : {false, true}) {
    if (!(lux ? task.lux : task.image)) continue;
    JudgingPair& pair = options.references->of(lux);
    if (!pair.chosen)
      pair.doubts = choose_references(runs, lux, options.error / 2, kReferenceShare * options.seconds / kinds,
                                      pair.cost);
    pair.chosen = true;
    (lux ? pilot.lux_reference : pilot.image_reference) = pair.cost;
    for (const std::string& line : pair.doubts.lines()) pilot.doubts.push_back(line);
  }
  if (task.lux) pilot.sensors = runs.sensors();

  const std::vector<Knobs> caches = pilot_caches(task.image);
  Rows image, lux;
  for (std::size_t c = 0; c < caches.size(); ++c) {
    runs.make_caches(caches[c]);
    if (task.image) {
      const Knobs fine = runs.sized(with(caches[c], kFine));
      // The last have the least errors of their own: the picture's show best with them.
      if (c + 1 < caches.size()) {
        add_rows(image, fine, runs.pictures(fine, false), false, true);
      } else {
        for (const Knobs& picture : pilot_pictures(task.gloss)) {
          const Knobs k = runs.sized(picture);
          add_rows(image, k, runs.pictures(k, true), true, k == fine);
        }
      }
    }
    if (!task.lux) continue;
    for (const double rays : kSensorRays) {
      Knobs k = caches[c];
      k[at(Knob::sensor_rays)] = rays;
      const bool most = rays == kSensorRays[1];
      if (c == 0 || most) add_rows(lux, k, runs.lux_tables(k), true, most);
    }
  }
  const std::vector<PilotRuns::Counted> counts = runs.count_records(
      kPhotons[0], {kAccuracy[0], kAccuracy[1]}, static_cast<double>(cells_of(kCountRings)));
  double sampled_detail = 1;
  if (task.image) sampled_detail = runs.time_pictures(with(caches[0], kTimed[0]), with(caches[0], kTimed[1]));
  const double pixels = static_cast<double>(task.width * task.height);
  const double places =
      (task.image ? calibration::kPlacesOfAPixel * pixels : 0) + static_cast<double>(pilot.sensors);
  pilot.records = count_of(kAccuracy[0], counts[0].records, kAccuracy[1], counts[1].records, places);
  if (task.cached_gloss)
    pilot.gloss_records = count_of(kAccuracy[0], counts[0].gloss_records, kAccuracy[1],
                                   counts[1].gloss_records, calibration::kPlacesOfAPixel * pixels);
  for (auto& [name, p] : pilot.time.part)
    p.fit(runs.times(name.substr(0, name.find(','))), options.seed + 11);
  if (task.image) {
    pilot.image_error = image_error_model(task, runs.detail());
    fit_errors(*pilot.image_error, image, options.seed + 20, "direct light and gloss");
    add_missed_detail(*pilot.image_error, runs.detail(), sampled_detail, runs.growth());
    pilot.image_resolution = resolution_of(image.indirect_bias);
    pilot.image_reference.places = pixels;
  }
  if (task.lux) {
    pilot.lux_error = lux_error_model(task);
    fit_errors(*pilot.lux_error, lux, options.seed + 30, "direct light");
    pilot.lux_resolution = resolution_of(lux.indirect_bias);
    pilot.lux_reference.places = static_cast<double>(std::min(pilot.sensors, kPilotSensors));
  }
  pilot.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return pilot;
}

}  // namespace phos::inline plan
