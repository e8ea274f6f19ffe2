#include "core/text/quantity.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/json.h"

namespace phos {

std::string percent(double share) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, 100 * share < 9.95 ? "%.2g %%" : "%.0f %%", 100 * share);
  return buffer;
}

std::string percent_to_tenths(double share) {
  return text(shortest(static_cast<float>(std::round(1000 * share) / 10)), " %");
}

std::string duration(double seconds) {
  char buffer[48];
  if (seconds < 9.95)
    std::snprintf(buffer, sizeof buffer, "%.2g s", seconds);
  else if (seconds < 119.5)
    std::snprintf(buffer, sizeof buffer, "%.0f s", seconds);
  else
    std::snprintf(buffer, sizeof buffer, "%.0f min %02d s", std::floor(std::round(seconds) / 60),
                  static_cast<int>(std::fmod(std::round(seconds), 60)));
  return buffer;
}

}  // namespace phos
