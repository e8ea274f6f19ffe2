#include "temporal/change.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline temporal {

double change_rate(std::span<const float> now, std::span<const float> next, double floor) {
  PHOS_CHECK(now.size() == next.size() && floor > 0, now.size(), " and ", next.size(), " numbers, floor ",
             floor);
  double change2 = 0, norm2 = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double a = static_cast<double>(now[i]), b = static_cast<double>(next[i]);
    change2 += (b - a) * (b - a), norm2 += a * a;
  }
  return std::sqrt(change2) / std::max(std::sqrt(norm2), floor);
}

double change_rate(const Rgb& now, const Rgb& next, double floor) {
  return change_rate(std::span(&now.x, 3), std::span(&next.x, 3), floor);
}

std::int64_t life_of(double rate, double accuracy, std::int64_t max_life) {
  if (!(rate * static_cast<double>(max_life) > accuracy)) return max_life;
  return std::clamp(static_cast<std::int64_t>(std::floor(accuracy / rate)), std::int64_t{1}, max_life);
}

double time_weight(double rate, double age, double accuracy, std::int64_t max_life) {
  if (age >= static_cast<double>(max_life)) return 0;
  return std::max(0.0, 1 - rate * age / accuracy);
}

}  // namespace phos::inline temporal
