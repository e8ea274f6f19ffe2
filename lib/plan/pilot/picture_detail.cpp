#include "plan/pilot/picture_detail.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "plan/calibration.h"

namespace phos::inline plan {
namespace {

struct Pair {
  std::vector<Rgb> a, b, lamp;
  int width = 0, height = 0;
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Mean over pixels of the product of their differences from the mean of their block.
double within_blocks(const Pair& pair, int side) {
  double sum = 0, pixels = 0;
  for (int y0 = 0; y0 + side <= pair.height; y0 += side)
    for (int x0 = 0; x0 + side <= pair.width; x0 += side) {
      DVec3 a(0), b(0), products(0);
      bool use = true;
      for (int y = y0; y < y0 + side; ++y)
        for (int x = x0; x < x0 + side; ++x) {
          const std::size_t i = pair.at(x, y);
          const DVec3 p(pair.a[i]), q(pair.b[i]);
          use = use && is_finite(pair.a[i]) && is_finite(pair.b[i]) && pair.lamp[i] == Rgb(0);
          a += p, b += q, products += p * q;
        }
      if (!use) continue;
      const double n = side * side;
      const DVec3 differ = products - a * b / n;
      sum += differ.x + differ.y + differ.z, pixels += n;
    }
  return pixels > 0 ? sum / pixels : 0;
}

}  // namespace

double detail_power(const Image& a, const Image& b) {
  PHOS_CHECK(a.width() == b.width() && a.height() == b.height(), a.width(), " ", b.width());
  const Pair pair{a.rgb(""), b.rgb(""),
                  a.has_layer("emission") ? a.rgb("emission") : std::vector<Rgb>(a.pixels(), Rgb(0)),
                  a.width(), a.height()};
  const double small = within_blocks(pair, 2), large = within_blocks(pair, 4);
  if (!(small > 0) || !(large > small)) return calibration::kLeastDetailPower;
  return std::clamp(0.5 * std::log2(large / small - 1), calibration::kLeastDetailPower, 1.0);
}

double differs_within_pixels(const Image& few, const Image& more, const std::string& layer) {
  PHOS_CHECK(few.width() == more.width() && few.height() == more.height(), few.width(), " ", more.width());
  const std::vector<Rgb> a = few.rgb(layer), b = more.rgb(layer);
  double differ2 = 0, mean = 0, n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!is_finite(a[i]) || !is_finite(b[i])) continue;
    const DVec3 differ = DVec3(a[i]) - DVec3(b[i]), light(b[i]);
    differ2 += glm::dot(differ, differ) / 3, mean += (light.x + light.y + light.z) / 3, n += 1;
  }
  return mean > 0 ? differ2 * n / (mean * mean) : 0;
}

}  // namespace phos::inline plan
