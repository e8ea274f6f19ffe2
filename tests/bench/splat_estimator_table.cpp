// Every estimator against every scene whose light is known in closed form at points (derivations:
// tests/support/scenes.h), as CSV: bias with its 95 % interval, root mean square error, and mean of the
// stated standard error. Errors are in percent of the truth; where it is dark, in percent of the brightest
// check of the scene. Each seed has photons, coarse cache and rays of its own; what is independent is the
// seed, so that its mean over the checks is one sample of the bias. '!' marks a bias beyond its interval
// (by chance: one row in twenty); the last columns tell of the check whose bias exceeds its own most. All
// checks are well inside of surfaces and far from shadow edges: photon_border_table tells what happens there.
//   build/tests/splat_estimator_table > estimators.csv
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "splat/make_estimator.h"
#include "support/records.h"

namespace {

using namespace phos;

constexpr double kLandings = 1e5;  // of photons in a closed room; as many start in an open scene
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
  std::vector<double> error, stated;
};

struct Mean {
  double value = 0, interval = 0;  ///< half width, 95 %
  double excess() const { return std::fabs(value) - interval; }
};

/// With Student's quantile, to first order in 1 / degrees of freedom.
Mean mean_of(const std::vector<double>& samples) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0, squares = 0;
  for (const double x : samples) sum += x;
  for (const double x : samples) squares += (x - sum / n) * (x - sum / n);
  constexpr double z = 1.96;
  const double t = z + (z * z * z + z) / (4 * (n - 1));
  return {sum / n, t * std::sqrt(squares / (n * (n - 1)))};
}

void print_row(const char* method, const std::string& scene, const std::vector<Errors>& checks, bool dark) {
  std::vector<double> of_seed;
  double squares = 0, stated = 0, count = 0;
  std::size_t kind = 0, worst_at = 0;
  Mean worst;
  for (std::size_t c = 0; c < checks.size(); ++c) {
    const Errors& e = checks[c];
    if (e.dark != dark) continue;
    const Mean own = mean_of(e.error);
    if (kind == 0 || own.excess() > worst.excess()) worst = own, worst_at = c;
    of_seed.resize(e.error.size());
    for (std::size_t s = 0; s < e.error.size(); ++s) {
      of_seed[s] += e.error[s];
      squares += e.error[s] * e.error[s], stated += e.stated[s], ++count;
    }
    ++kind;
  }
  if (kind == 0) return;
  for (double& x : of_seed) x /= static_cast<double>(kind);
  const Mean bias = mean_of(of_seed);
  std::printf("%s,%s,%s,%zu,%zu,%.4f,%.4f,%s,%.4f,%.4f,%zu,%.4f,%.4f,%s\n", method, scene.c_str(),
              dark ? "dark" : "lit", kind, of_seed.size(), 100 * bias.value, 100 * bias.interval,
              bias.excess() > kRounding ? "!" : "", 100 * std::sqrt(squares / count), 100 * stated / count,
              worst_at, 100 * worst.value, 100 * worst.interval, worst.excess() > kRounding ? "!" : "");
  std::fflush(stdout);
}

RecordOptions options_of(const Method& method, const test::AnalyticScene& s) {
  RecordOptions options;
  options.estimate = method.estimate, options.kernel = method.kernel;
  options.paths = Quantity::all;
  // In open scenes nothing that reflects sees anything lit.
  options.gather_bounces = s.mean_irradiance_lx > 0 ? -1 : 1;
  options.resolve(s.scene.bounds.diagonal_m());
  return options;
}

void measure(const test::AnalyticScene& s) {
  const bool closed = s.mean_irradiance_lx > 0;
  const double albedo = static_cast<double>(s.scene.material[0].kd.x);
  double brightest = 0;
  for (const test::Check& check : s.checks) brightest = std::max(brightest, check.irradiance_lx);
  std::vector<std::vector<Errors>> errors(std::size(kMethods), std::vector<Errors>(s.checks.size()));
  for (int seed = 1; seed <= kMostSeeds; ++seed) {
    test::Lit lit = test::light_up(s.scene, std::lround(kLandings * (closed ? 1 - albedo : 1)),
                                   static_cast<std::uint64_t>(seed));
    const EstimateInputs inputs{.photons = std::move(lit.photons), .source = {}};
    for (std::size_t m = 0; m < std::size(kMethods); ++m) {
      if (seed > kMethods[m].seeds) continue;
      const RecordOptions options = options_of(kMethods[m], s);
      const ChosenEstimator estimator(*lit.rays, inputs, options, static_cast<std::uint64_t>(seed));
      const auto worker = (*estimator).make_worker();
      for (std::size_t c = 0; c < s.checks.size(); ++c) {
        const test::Check& check = s.checks[c];
        const IrradianceRecord r = (*estimator).make({check.position, check.normal, c}, *worker).record;
        Errors& e = errors[m][c];
        e.dark = check.irradiance_lx <= 0;
        const double unit = e.dark ? brightest : check.irradiance_lx;
        e.error.push_back((static_cast<double>(r.irradiance.y) - check.irradiance_lx) / unit);
        e.stated.push_back(static_cast<double>(r.stderr_lx.y) / unit);
      }
    }
  }
  char name[64];
  std::snprintf(name, sizeof name, closed ? "%s %g" : "%s", s.name.c_str(), albedo);
  for (const bool dark : {false, true})
    for (std::size_t m = 0; m < std::size(kMethods); ++m) print_row(kMethods[m].name, name, errors[m], dark);
}

}  // namespace

int main() {
  set_threads(1);
  std::printf(
      "estimator,scene,checks_are,checks,seeds,bias_percent,interval_95,beyond,rmse_percent,stated_percent,"
      "worst_check,its_bias_percent,its_interval_95,its_beyond\n");
  for (const test::AnalyticScene& s : test::all_point_scenes()) measure(s);
}
