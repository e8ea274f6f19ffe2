// Every estimator against every scene whose light is known in closed form at points (derivations:
// tests/support/scenes.h), as CSV: bias with its 95 % interval, root mean square error, and mean of the
// stated standard error. Errors are in percent of the truth; where it is dark, in percent of the brightest
// check of the scene. Each seed has photons, coarse cache and rays of its own; what is independent is the
// seed, so that its mean over the checks is one sample of the bias. '!' marks a bias beyond its interval (by
// chance: one row in twenty). Of a bias of kernels, "curvature" is known: the mean of the closed form over
// their zone is not what it is in the middle; '!' in "unexplained" marks what is left when that is
// subtracted. Hulls subtract it themselves. The last columns tell of the check of which most is left (by
// chance: one check in twenty is marked). All checks are well inside of surfaces and far from shadow edges:
// photon_border_table tells what happens there.
//   build/tests/stage_estimator_table [TIMES [PHOTONS]] > estimators.csv
// TIMES: so many times the seeds [1]; PHOTONS: that land in a closed room, and as many start in an open scene
// [1e5].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "estimate/density.h"
#include "stage/chosen_estimator.h"
#include "study/statistics.h"
#include "support/records.h"

namespace {

using namespace phos;

constexpr double kRounding = 1e-6;

struct Method {
  const char* name;
  Estimate estimate;
  Kernel kernel;
  int seeds;
};
constexpr Method kMethods[] = {
    {"hull", Estimate::hull, Kernel::disc, 60},
    {"kernel disc", Estimate::kernel, Kernel::disc, 60},
    {"kernel epanechnikov", Estimate::kernel, Kernel::epanechnikov, 60},
    {"gather", Estimate::gather, Kernel::disc, 40},
    {"raster stretch", Estimate::raster, Kernel::disc, 40},
};
constexpr int kMostSeeds = 60;

/// All of one estimator at one check, in parts of the truth, one per seed.
struct Errors {
  bool dark = false;
  std::vector<double> error, stated, curvature;
};

struct Mean {
  double value = 0, interval = 0;  ///< half width, 95 %
  double excess() const { return std::fabs(value) - interval; }
};

/// With Student's quantile; at least two samples.
Mean mean_of(const std::vector<double>& samples) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0, squares = 0;
  for (const double x : samples) sum += x;
  for (const double x : samples) squares += (x - sum / n) * (x - sum / n);
  return {sum / n, student_t(0.95, samples.size() - 1) * std::sqrt(squares / (n * (n - 1)))};
}

/// Adds `values` to sums of as many, divided by `count`.
void add(std::vector<double>& sums, const std::vector<double>& values, std::size_t count) {
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i] / static_cast<double>(count);
}

const char* mark(const Mean& bias) { return bias.excess() > kRounding ? "!" : ""; }

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

void print_row(const char* method, const std::string& scene, const std::vector<Errors>& all, bool dark) {
  const auto checks =
      static_cast<std::size_t>(std::ranges::count_if(all, [&](const Errors& e) { return e.dark == dark; }));
  if (checks == 0) return;
  std::vector<double> error, squares, stated, curvature;  // of each seed
  Mean worst;
  std::size_t worst_at = all.size();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Errors& e = all[c];
    if (e.dark != dark) continue;
    std::vector<double> square = e.error;
    for (double& x : square) x *= x;
    add(error, e.error, checks), add(squares, square, checks);
    add(stated, e.stated, checks), add(curvature, e.curvature, checks);
    const Mean left = mean_of(difference(e.error, e.curvature));
    if (worst_at == all.size() || left.excess() > worst.excess()) worst = left, worst_at = c;
  }
  const Mean bias = mean_of(error), left = mean_of(difference(error, curvature));
  std::printf("%s,%s,%s,%zu,%zu,%.4f,%.4f,%s,%.4f,%s,%.4f,%.4f,%zu,%.4f,%.4f,%s\n", method, scene.c_str(),
              dark ? "dark" : "lit", checks, error.size(), 100 * bias.value, 100 * bias.interval, mark(bias),
              100 * mean_of(curvature).value, mark(left), 100 * std::sqrt(mean_of(squares).value),
              100 * mean_of(stated).value, worst_at, 100 * worst.value, 100 * worst.interval, mark(worst));
  std::fflush(stdout);
}

/// Mean of the closed form over the disc that a kernel's record was made from, weighted by the kernel, less
/// its value at the check, lx. 0 for other records.
double curvature_lx(const test::AnalyticScene& s, const test::Check& check, const Estimator::Worker& worker,
                    Kernel kernel) {
  const auto* made = dynamic_cast<const DensityEstimator::Scratch*>(&worker);
  if (!made || made->zone.kind != ZoneKind::kernel) return 0;
  constexpr int kRings = 20, kSpokes = 16;  // of equal area
  const auto ring = [](int i) { return std::sqrt((i + 0.5) / kRings); };
  const double radius_m = std::sqrt(made->zone.area_m2 / std::numbers::pi);
  const Frame frame = make_frame(check.normal);
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSpokes; ++j) {
      const double phi = 2 * std::numbers::pi * j / kSpokes;
      const Vec3 offset(Vec2(radius_m * ring(i) * std::cos(phi), radius_m * ring(i) * std::sin(phi)), 0);
      sum += kernel_weight(kernel, ring(i)) *
             s.irradiance_lx(check.position + frame.to_world(offset), check.normal);
    }
  }
  return sum / (kRings * kSpokes) - check.irradiance_lx;
}

RecordOptions options_of(const Method& method, const test::AnalyticScene& s) {
  RecordOptions options;
  options.estimate = method.estimate, options.kernel = method.kernel;
  options.paths = Quantity::all;
  // In open scenes nothing that reflects sees anything lit.
  options.gather_bounces = s.mean_irradiance_lx > 0 ? -1 : 1;
  options.resolve(s.scene.bounds.diagonal_m() / 4);
  return options;
}

void measure(const test::AnalyticScene& s, int times, double landings) {
  const bool closed = s.mean_irradiance_lx > 0;
  const double albedo = static_cast<double>(s.scene.material[0].kd.x);
  double brightest = 0;
  for (const test::Check& check : s.checks) brightest = std::max(brightest, check.irradiance_lx);
  std::vector<std::vector<Errors>> errors(std::size(kMethods), std::vector<Errors>(s.checks.size()));
  for (int seed = 1; seed <= times * kMostSeeds; ++seed) {
    test::Lit lit = test::light_up(s.scene, std::lround(landings * (closed ? 1 - albedo : 1)),
                                   static_cast<std::uint64_t>(seed));
    stage::RecordInputs inputs;
    inputs.photons = std::move(lit.photons);
    for (std::size_t m = 0; m < std::size(kMethods); ++m) {
      if (seed > times * kMethods[m].seeds) continue;
      const RecordOptions options = options_of(kMethods[m], s);
      const stage::ChosenEstimator estimator(*lit.rays, inputs, options, static_cast<std::uint64_t>(seed));
      const auto worker = (*estimator).make_worker();
      for (std::size_t c = 0; c < s.checks.size(); ++c) {
        const test::Check& check = s.checks[c];
        const IrradianceRecord r = (*estimator).make({check.position, check.normal, c}, *worker).record;
        Errors& e = errors[m][c];
        e.dark = check.irradiance_lx <= 0;
        const double unit = e.dark ? brightest : check.irradiance_lx;
        e.error.push_back((static_cast<double>(r.irradiance.y) - check.irradiance_lx) / unit);
        e.stated.push_back(static_cast<double>(r.stderr_lx.y) / unit);
        e.curvature.push_back(curvature_lx(s, check, *worker, kMethods[m].kernel) / unit);
      }
    }
  }
  char name[64];
  std::snprintf(name, sizeof name, closed ? "%s %g" : "%s", s.name.c_str(), albedo);
  for (const bool dark : {false, true})
    for (std::size_t m = 0; m < std::size(kMethods); ++m) print_row(kMethods[m].name, name, errors[m], dark);
}

}  // namespace

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
  const double landings = argc > 2 ? std::max(1., std::atof(argv[2])) : 1e5;
  set_threads(1);
  std::printf(
      "estimator,scene,checks_are,checks,seeds,bias_percent,interval_95,beyond,curvature_percent,unexplained,"
      "rmse_percent,stated_percent,worst_check,it_leaves_percent,its_interval_95,its_unexplained\n");
  for (const test::AnalyticScene& s : test::all_point_scenes()) measure(s, times, landings);
}
