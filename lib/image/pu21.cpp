#include "image/pu21.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace phos::inline image {

namespace {

constexpr double kPeak = 256;
constexpr int kReach = 5;  // window of 11 pixels, as in the paper's code
constexpr std::size_t kRows = 16;

using Plane = std::vector<float>;

std::array<float, kReach + 1> window() {
  std::array<float, kReach + 1> w{};
  for (int i = 0; i <= kReach; ++i)
    w[static_cast<std::size_t>(i)] = std::exp(-static_cast<float>(i * i) / (2 * 1.5f * 1.5f));
  return w;
}

/// Gaussian mean along one axis; at an edge the window is cut and its weights are normalised.
Plane blur_axis(const Plane& in, int width, int height, bool along_x) {
  const auto weights = window();
  Plane out(in.size());
  parallel_chunks(static_cast<std::size_t>(height), kRows, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x) {
        const int at = along_x ? x : y, size = along_x ? width : height;
        float sum = 0, total = 0;
        for (int k = std::max(0, at - kReach); k <= std::min(size - 1, at + kReach); ++k) {
          const float w = weights[static_cast<std::size_t>(std::abs(k - at))];
          const std::size_t index = along_x ? static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                                  static_cast<std::size_t>(k)
                                            : static_cast<std::size_t>(k) * static_cast<std::size_t>(width) +
                                                  static_cast<std::size_t>(x);
          sum += w * in[index], total += w;
        }
        out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            sum / total;
      }
  });
  return out;
}

Plane blur(const Plane& in, int width, int height) {
  return blur_axis(blur_axis(in, width, height, true), width, height, false);
}

Plane product(const Plane& a, const Plane& b) {
  Plane out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] * b[i];
  return out;
}

double ssim(const Plane& a, const Plane& b, std::span<const char> counts, int width, int height) {
  constexpr double c1 = (0.01 * kPeak) * (0.01 * kPeak), c2 = (0.03 * kPeak) * (0.03 * kPeak);
  const Plane ma = blur(a, width, height), mb = blur(b, width, height);
  const Plane aa = blur(product(a, a), width, height), bb = blur(product(b, b), width, height),
              ab = blur(product(a, b), width, height);
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts[i]) continue;
    const double x = ma[i], y = mb[i];
    const double vx = aa[i] - x * x, vy = bb[i] - y * y, cov = ab[i] - x * y;
    sum += (2 * x * y + c1) * (2 * cov + c2) / ((x * x + y * y + c1) * (vx + vy + c2));
    ++n;
  }
  return n == 0 ? 1.0 : sum / static_cast<double>(n);
}

}  // namespace

double pu21_encode(double luminance_cd_m2) {
  constexpr double p[] = {0.353487901,   0.3734658629, 8.277049286e-05, 0.9062562627,
                          0.09150303166, 0.9099517204, 596.3148142};
  const double y = std::pow(std::clamp(luminance_cd_m2, 0.005, 10000.0), p[3]);
  return std::max(0.0, p[6] * (std::pow((p[0] + p[1] * y) / (1 + p[2] * y), p[4]) - p[5]));
}

Pu21 compare_pu21(std::span<const float> luminance, std::span<const float> reference,
                  std::span<const char> counts, int width, int height) {
  Plane a(luminance.size()), b(luminance.size());
  parallel_for(a.size(), 4096, [&](std::size_t i) {
    a[i] = static_cast<float>(pu21_encode(luminance[i])),
    b[i] = static_cast<float>(pu21_encode(reference[i]));
  });
  double squares = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts[i]) continue;
    squares += (double{a[i]} - b[i]) * (double{a[i]} - b[i]);
    ++n;
  }
  Pu21 result;
  result.psnr_db = squares > 0 ? 10 * std::log10(kPeak * kPeak * static_cast<double>(n) / squares)
                               : std::numeric_limits<double>::infinity();
  result.ssim = ssim(a, b, counts, width, height);
  return result;
}

}  // namespace phos::inline image
