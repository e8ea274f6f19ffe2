#include "plan/separate.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline plan {
namespace {

/// Mean, and its standard error from the spread of blocks.
class BlockMean {
 public:
  void add(double sum, double n) { sums_.push_back(sum), counts_.push_back(n), total_ += sum, n_ += n; }
  double mean() const { return n_ > 0 ? total_ / n_ : 0; }
  double sigma() const {
    if (sums_.size() < 2) return std::fabs(mean());
    double squares = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const double d = sums_[i] - mean() * counts_[i];
      squares += d * d;
    }
    const double blocks = static_cast<double>(sums_.size());
    return std::sqrt(squares * blocks / (blocks - 1)) / n_;
  }

 private:
  std::vector<double> sums_, counts_;
  double total_ = 0, n_ = 0;
};

}  // namespace

Separated Separated::over(double magnitude) const {
  PHOS_CHECK(magnitude > 0, "magnitude = ", magnitude);
  Separated s = *this;
  for (double* v : {&s.noise2, &s.bias2, &s.noise2_sigma, &s.bias2_sigma, &s.reference2})
    *v = *v / magnitude / magnitude;
  return s;
}

Separated separate(std::span<const double> a, std::span<const double> b, std::span<const double> p,
                   std::span<const double> q, std::size_t block) {
  PHOS_CHECK(a.size() == b.size() && a.size() == p.size() && a.size() == q.size() && block > 0, a.size(), " ",
             b.size(), " ", p.size(), " ", q.size());
  BlockMean noise, bias, reference;
  Separated out;
  for (std::size_t start = 0; start < a.size(); start += block) {
    double n = 0, noise_sum = 0, bias_sum = 0, reference_sum = 0;
    for (std::size_t i = start; i < std::min(start + block, a.size()); ++i) {
      const double d = a[i] - b[i], r = p[i] - q[i];
      const double cross = 0.5 * ((a[i] - p[i]) * (b[i] - q[i]) + (a[i] - q[i]) * (b[i] - p[i]));
      if (!std::isfinite(d) || !std::isfinite(r) || !std::isfinite(cross)) continue;
      noise_sum += 0.5 * d * d, bias_sum += cross, reference_sum += 0.5 * r * r, n += 1;
    }
    if (n == 0) continue;
    noise.add(noise_sum, n), bias.add(bias_sum, n), reference.add(reference_sum, n);
    out.values += static_cast<std::size_t>(n);
  }
  out.noise2 = noise.mean(), out.noise2_sigma = noise.sigma();
  out.bias2 = bias.mean(), out.bias2_sigma = bias.sigma();
  out.reference2 = reference.mean();
  return out;
}

double mean_magnitude(std::span<const double> a, std::span<const double> b) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double v = std::fabs(0.5 * (a[i] + b[i]));
    if (std::isfinite(v)) sum += v, n += 1;
  }
  return n > 0 ? sum / n : 0;
}

std::vector<double> tiled_values(const Image& image, const std::string& layer, const Image& reference) {
  constexpr int kTile = 8;
  std::vector<double> out;
  const bool lamps = reference.has_layer("emission");
  const std::vector<Rgb> values =
      layer.empty() || image.has_layer(layer) ? image.rgb(layer) : std::vector<Rgb>(image.pixels(), Rgb(0));
  const std::vector<Rgb> emission =
      lamps ? reference.rgb("emission") : std::vector<Rgb>(image.pixels(), Rgb(0));
  for (int y0 = 0; y0 < image.height(); y0 += kTile)
    for (int x0 = 0; x0 < image.width(); x0 += kTile)
      for (int y = y0; y < std::min(y0 + kTile, image.height()); ++y)
        for (int x = x0; x < std::min(x0 + kTile, image.width()); ++x) {
          const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                         static_cast<std::size_t>(x);
          if (emission[i] != Rgb(0)) continue;
          for (int c = 0; c < 3; ++c) out.push_back(static_cast<double>(values[i][c]));
        }
  return out;
}

}  // namespace phos::inline plan
