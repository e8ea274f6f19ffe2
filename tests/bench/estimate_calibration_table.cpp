// Are stated standard errors the true ones? For each scene of known light, Sponza among them where the scene
// collection lies beside the project, and each estimator, over many seeds: the share of estimates within two
// stated standard errors of the truth (95 % of normal ones), the true over the stated root mean square error,
// and the mean error in stated ones. CSV.
//   build/tests/estimate_calibration_table [SEEDS [SCENE [full|small|sensors [FIRST]]]] > calibration.csv
// small: with as few photons and records as the test has; sensors: so, and sensors alone. Seeds from FIRST
// (1) on.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "support/calibration.h"

int main(int argc, char** argv) {
  using namespace phos;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::string only = argc > 2 ? argv[2] : "";
  const std::string size = argc > 3 ? argv[3] : "full";
  const int first = argc > 4 ? std::atoi(argv[4]) : 1;
  if (size != "full" && size != "small" && size != "sensors") {
    std::fprintf(stderr, "estimate_calibration_table: \"%s\" is not one of: full, small, sensors\n",
                 size.c_str());
    return 2;
  }
  std::printf("scene,estimator,estimates,exact_percent,share_percent,true_over_stated,bias_in_errors\n");
  std::vector<test::KnownLight> scenes;
  for (const test::AnalyticScene& s : test::all_point_scenes()) scenes.push_back(test::known_light(s));
  if (std::optional<test::KnownLight> sponza = test::sponza()) scenes.push_back(std::move(*sponza));
  for (test::KnownLight& known : scenes) {
    if (known.name.find(only) == std::string::npos) continue;
    test::CalibrationOptions options;
    if (size != "full")
      options = known.name == "Sponza" ? test::CalibrationOptions::small_of_real_scene()
                                       : test::CalibrationOptions::small();
    if (size == "sensors") options.photons = options.gathering = options.radiance = false;
    const test::CalibratedScene scene(std::move(known), options);
    test::CalibrationTable table;
    for (int seed = first; seed < first + seeds; ++seed)
      scene.measure(static_cast<std::uint64_t>(seed), table);
    for (const auto& [estimator, c] : table)
      std::printf("%s,%s,%.0f,%.1f,%.1f,%.3f,%.3f\n", scene.name().c_str(), estimator.c_str(), c.n,
                  100 * c.exact_share(), 100 * c.share(), c.ratio(), c.bias());
    std::fflush(stdout);
  }
}
