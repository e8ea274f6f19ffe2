// Are the standard errors that pictures state the true ones? For each scene of known light, over many seeds:
// the share of pixels within two stated standard errors of the truth (95 % of normal ones), and true over
// stated root mean square error. CSV.
//   build/tests/splat_calibration_table [SEEDS [SCENE [FIRST]]] > calibration.csv
// Seeds from FIRST (1) on.
#include <cstdio>
#include <cstdlib>

#include "support/picture_calibration.h"

int main(int argc, char** argv) {
  using namespace phos::test;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::string only = argc > 2 ? argv[2] : "";
  const int first = argc > 3 ? std::atoi(argv[3]) : 1;
  std::printf("scene,picture,pixels,exact_percent,share_percent,true_over_stated,bias_in_errors\n");
  for (const AnalyticScene& scene : all_point_scenes()) {
    const CalibratedPicture picture(scene, CalibrationOptions::small());
    if (picture.name().find(only) == std::string::npos) continue;
    std::map<std::string, Calibration> table;
    for (int seed = first; seed < first + seeds; ++seed)
      picture.measure(static_cast<std::uint64_t>(seed), table);
    for (const auto& [what, c] : table)
      std::printf("%s,\"%s\",%.0f,%.1f,%.1f,%.3f,%.3f\n", picture.name().c_str(), what.c_str(), c.n,
                  100 * c.exact_share(), 100 * c.share(), c.ratio(), c.bias());
    std::fflush(stdout);
  }
}
