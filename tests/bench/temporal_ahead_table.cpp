// How well the irradiance of the next frame is known when a record of 512 rays is made (docs/methods.md#f6;
// Gautron 2006, table 5.1), at places that the camera sees in frames spread over three animations. The truth
// of a change is that by 16384 other rays, the same in both frames. CSV, by scene and way of looking ahead:
//   mean, median, most, rms   error of the expected change, in parts of the next frame's irradiance, %
//   same                      root mean square difference to the next frame by the same 512 rays, %
//   rate, true rate           mean relative change over the frame as expected, and in truth, %
//   traced                    places that were traced since too much came to light, %
//   cost                      in parts of the time that records take, %
//   temporal_ahead_table [PLACES of each scene [SHARE [BOUNCES [HOLES]]]]
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>

#include "core/parallel.h"
#include "core/random.h"
#include "estimate/gather.h"
#include "photon/trace.h"
#include "place/two_level.h"
#include "scene/motion/film.h"
#include "temporal/ahead.h"
#include "temporal/change.h"

namespace phos {
namespace {

constexpr std::int64_t kRays = 512, kManyRays = 16384, kFrames = 40;
constexpr double kFloorLx = 1e-6;

/// Of this process, all in one thread: others may be at work.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Frame {
  Frame(const std::string& path, std::int64_t at, const RecordOptions* options)
      : scene(load_frame(path, {}, at)), rays(scene), lights(scene) {
    if (!options || options->gather_bounces == 1) return;
    Counters counters;
    PhotonTotals totals;
    PhotonOptions few;
    few.paths = 50000;
    Photons traced = trace_photons(rays, few, 1, totals, counters);
    photons.emplace(PhotonMap::build(std::move(traced), totals));
    coarse.emplace(rays, *photons, *options, 1);
  }
  Frame(const Frame&) = delete;
  Scene scene;
  RayScene rays;
  Luminaires lights;
  std::optional<PhotonMap> photons;
  std::optional<CoarseLevel> coarse;
  GatherSource source() const { return coarse ? coarse->source() : GatherSource(); }
};

std::vector<RecordSite> places(const Frame& frame, std::int64_t count, std::uint64_t seed) {
  const Camera& camera = find_camera(frame.scene, "");
  std::vector<RecordSite> sites;
  for (std::uint64_t i = 0; sites.size() < static_cast<std::size_t>(count) && i < 100000; ++i) {
    RandomStream random(seed, Stage::test, i);
    const Camera::Ray eye = camera.ray(random.uniform2(), camera.aspect);
    SurfacePoint p;
    if (!trace(frame.rays, {eye.origin, eye.direction}, p)) continue;
    if (max_component(frame.scene.material[p.material].kd) > 0)
      sites.push_back({p.position, p.smooth_normal, seed << 20 | i});
  }
  return sites;
}

struct Errors {
  std::vector<double> change, same, rate;
  double true_rate = 0, cost_s = 0;
  std::uint64_t traced = 0;
};

double root_mean_square(const std::vector<double>& x) {
  double sum = 0;
  for (const double e : x) sum += e * e / static_cast<double>(x.size());
  return std::sqrt(sum);
}
double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double e : x) sum += e / static_cast<double>(x.size());
  return sum;
}

void measure(const std::string& name, std::int64_t count, double share, std::int64_t bounces,
             double most_holes) {
  const std::string path = std::string(PHOS_SOURCE) + "/data/" + name + ".glb";
  std::map<LookAhead, Errors> errors;
  double record_s = 0;
  const std::int64_t frames = load_scene(path).frames;
  RecordOptions options;
  options.estimate = Estimate::gather, options.rays = kRays, options.gather_bounces = bounces;
  options.resolve(load_scene(path).bounds.diagonal_m() / 4);
  RecordOptions many = options;
  many.rays = kManyRays;
  for (std::int64_t k = 0; k < kFrames; ++k) {
    const std::int64_t at = (2 * k + 1) * (frames - 2) / (2 * kFrames);
    const Frame now(path, at, &options), next(path, at + 1, &options);
    const Changes change = changes(now.scene, next.scene);
    const GatherEstimator first(now.rays, now.lights, now.source(), options, 1),
        second(next.rays, next.lights, next.source(), options, 1),
        second_as_known(next.rays, next.lights, now.source(), options, 1),
        before(now.rays, now.lights, now.source(), many, 2),
        truth(next.rays, next.lights, next.source(), many, 2);
    const auto alone = first.make_worker(), same = second.make_worker(), exact = truth.make_worker(),
               first_exact = before.make_worker();
    const std::vector<RecordSite> sites = places(now, count / kFrames, static_cast<std::uint64_t>(k));
    std::vector<double> there, e0, e1;
    const AheadEstimator tracing({first, now.rays, now.lights}, {second, next.rays, next.lights}, change,
                                 options, 1, {.look = LookAhead::trace});
    const auto tracer = tracing.make_worker();
    for (const RecordSite& site : sites) {
      const Made made = tracing.make(site, *tracer);
      const IrradianceRecord& r = made.ahead ? made.ahead->record : made.record;
      there.push_back(static_cast<double>(luminance(r.irradiance)));
      const RecordSite moved{r.position, r.normal, site.item};
      e0.push_back(static_cast<double>(luminance(before.make(site, *first_exact).record.irradiance)));
      e1.push_back(static_cast<double>(luminance(truth.make(moved, *exact).record.irradiance)));
    }
    double start = seconds();
    for (const RecordSite& site : sites) first.make(site, *alone);
    const double plain_s = seconds() - start;
    record_s += plain_s;
    for (const LookAhead look : {LookAhead::none, LookAhead::reproject, LookAhead::trace}) {
      Errors& e = errors[look];
      const AheadEstimator ahead({first, now.rays, now.lights}, {second_as_known, next.rays, next.lights},
                                 change, options, 1,
                                 {.look = look, .share = share, .most_holes = most_holes, .whole = false});
      const auto worker = ahead.make_worker();
      std::vector<Made> all;
      start = seconds();
      for (const RecordSite& site : sites) all.push_back(ahead.make(site, *worker));
      e.cost_s += seconds() - start - plain_s;
      for (std::size_t i = 0; i < sites.size(); ++i) {
        if (!(e1[i] > kFloorLx) || !(there[i] > kFloorLx)) continue;
        const IrradianceRecord& r = all[i].ahead ? all[i].ahead->record : all[i].record;
        const auto lx = static_cast<double>(luminance(r.irradiance));
        const auto was = static_cast<double>(luminance(all[i].record.irradiance));
        e.change.push_back(std::fabs((lx - was) - (e1[i] - e0[i])) / e1[i]);
        e.same.push_back(lx / there[i] - 1);
        e.rate.push_back(std::fabs(lx - was) / std::max(was, kFloorLx));
        e.true_rate += std::fabs(e1[i] - e0[i]) / std::max(e0[i], kFloorLx);
      }
      e.traced += worker->counters["records traced one frame ahead"];
    }
  }
  for (auto& [look, e] : errors) {
    std::sort(e.change.begin(), e.change.end());
    const auto n = static_cast<double>(e.change.size());
    const char* how = look == LookAhead::none ? "none" : look == LookAhead::trace ? "trace" : "reproject";
    std::printf("%s,%s,%zu,%.2f,%.2f,%.1f,%.2f,%.2f,%.2f,%.2f,%.1f,%.0f\n", name.c_str(), how,
                e.change.size(), 100 * mean(e.change), 100 * e.change[e.change.size() / 2],
                100 * e.change.back(), 100 * root_mean_square(e.change), 100 * root_mean_square(e.same),
                100 * mean(e.rate), 100 * e.true_rate / n, 100 * static_cast<double>(e.traced) / n,
                100 * e.cost_s / record_s);
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) {
  const std::int64_t count = argc > 1 ? std::atoll(argv[1]) : 1340;
  const double share = argc > 2 ? std::atof(argv[2]) : phos::AheadOptions().share;
  const std::int64_t bounces = argc > 3 ? std::atoll(argv[3]) : 1;
  const double holes = argc > 4 ? std::atof(argv[4]) : phos::AheadOptions().most_holes;
  phos::set_threads(1);
  std::printf("scene,look,places,mean,median,most,rms,same,rate,true rate,traced,cost\n");
  for (const char* name : {"cube-in-a-box", "moving-light", "spheres"})
    phos::measure(name, count, share, bounces, holes);
}
