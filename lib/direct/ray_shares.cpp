#include "direct/ray_shares.h"

#include <algorithm>
#include <cmath>

namespace phos::inline direct {

int sobol_set(double n) {
  double whole = 1;
  while (4 * whole <= n) whole *= 4;
  const double fall = std::pow(n / whole, kNoiseFall);
  for (const double part : {1.0, 1.5, 2.0, 3.0})
    if (fall <= part && whole * part >= 2) return static_cast<int>(whole * part);
  return static_cast<int>(4 * whole);
}

std::vector<int> share_rays(std::span<const PilotNoise> lamps, double stderr_lx, int most) {
  const auto root = [](const PilotNoise& lamp) {
    const double alone = lamp.variance_lx2 * std::pow(lamp.rays, kNoiseFall);
    return std::pow(std::max(alone, 0.0), 1 / (1 + kNoiseFall));
  };
  double sum = 0;
  for (const PilotNoise& lamp : lamps) sum += root(lamp);
  const double scale = std::pow(sum / (stderr_lx * stderr_lx), 1 / kNoiseFall);
  std::vector<int> rays;
  for (const PilotNoise& lamp : lamps) {
    double n = lamp.variance_lx2 > 0 ? root(lamp) * scale : 0;
    if (!(n < most)) n = most;  // infinite too
    n = std::max(n, static_cast<double>(lamp.least));
    rays.push_back(std::min(lamp.sets ? sobol_set(n) : static_cast<int>(std::ceil(n)), most));
  }
  return rays;
}

}  // namespace phos::inline direct
