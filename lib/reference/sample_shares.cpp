#include "reference/sample_shares.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline reference {
namespace {

constexpr double kEven = 1.0 / 3;
constexpr double kGroup = 4;  // samples are stratified in fours
constexpr double kMostOfPixel = 0x1p31;

/// Standard deviation of the pixels about each.
std::vector<double> deviation_about(std::span<const double> variance, std::size_t width) {
  const std::size_t height = variance.size() / width;
  std::vector<double> deviation;
  deviation.reserve(variance.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      double sum = 0, n = 0;
      for (std::size_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, height); ++v)
        for (std::size_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, width); ++u)
          if (u != x || v != y) sum += variance[v * width + u], n += 1;
      deviation.push_back(n > 0 ? std::sqrt(sum / n) : 0);
    }
  return deviation;
}

}  // namespace

std::vector<std::uint32_t> sample_shares(std::span<const double> variance, std::size_t width,
                                         std::int64_t mean) {
  PHOS_CHECK(width > 0 && variance.size() % width == 0 && mean >= 0, variance.size(), " pixels, ", width,
             " a row, mean ", mean);
  const std::vector<double> deviation = deviation_about(variance, width);
  double sum = 0;
  for (const double d : deviation) sum += d;
  const auto pixels = static_cast<double>(variance.size()), each = static_cast<double>(mean);
  const double even = sum > 0 ? kEven * each : each, rest = sum > 0 ? (1 - kEven) * each * pixels / sum : 0;
  // What rounding takes from one pixel goes to the next.
  std::vector<std::uint32_t> shares;
  double given = 0, wanted = 0;
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    wanted = i + 1 < deviation.size() ? wanted + std::min(even + rest * deviation[i], kMostOfPixel)
                                      : pixels * each;
    const double own = i + 1 < deviation.size() ? kGroup * std::floor((wanted - given) / kGroup)
                                                : std::max(0.0, std::round(wanted - given));
    shares.push_back(static_cast<std::uint32_t>(std::clamp(own, 0.0, kMostOfPixel)));
    given += own;
  }
  return shares;
}

}  // namespace phos::inline reference
