#include "radiance/brdf/lobe_projection.h"

#include <algorithm>
#include <array>

namespace phos::inline radiance {

namespace {

/// Directions taken at once: their harmonics of order 10 stay in the first cache.
constexpr std::size_t kBlock = 64;

/// Integrals of the lobe times each harmonic, RGB side by side: products are summed in kLanes partial sums,
/// which vectorises and keeps the order of the sums.
std::vector<float> integrate(const LobePoints& points, const HarmonicBasis<float>& basis, BasisKind kind) {
  constexpr std::size_t kLanes = 8;
  const auto count = static_cast<std::size_t>(basis.count());
  std::vector<float> harmonics(count * kBlock), out(3 * count);
  std::vector<double> sums(3 * count);
  std::array<std::array<float, kBlock>, 6> block;  // x, y, z, RGB
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const std::size_t n = std::min(kBlock, points.size() - first);
    const std::array<const std::vector<float>*, 6> columns{
        &points.x, &points.y, &points.z, &points.value[0], &points.value[1], &points.value[2]};
    for (std::size_t c = 0; c < 6; ++c) {
      std::copy_n(columns[c]->begin() + static_cast<std::ptrdiff_t>(first), n, block[c].begin());
      // What fills a block up weighs nothing.
      std::fill(block[c].begin() + static_cast<std::ptrdiff_t>(n), block[c].end(), c == 2 ? 1.f : 0.f);
    }
    basis.evaluate_batch(kind, kBlock, block[0].data(), block[1].data(), block[2].data(), harmonics.data());
    for (std::size_t i = 0; i < count; ++i) {
      const float* h = &harmonics[i * kBlock];
      for (std::size_t c = 0; c < 3; ++c) {
        const float* value = block[3 + c].data();
        std::array<float, kLanes> lanes{};
        for (std::size_t k = 0; k < kBlock; k += kLanes)
          for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += h[k + lane] * value[k + lane];
        float sum = 0;
        for (const float v : lanes) sum += v;
        sums[3 * i + c] += static_cast<double>(sum);
      }
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(sums[i]);
  return out;
}

}  // namespace

LobeProjection project_lobe(const std::function<Rgb(const Vec3& wi)>& f, std::span<const Vec3> scouts,
                            const HarmonicBasis<float>& basis, BasisKind kind) {
  const LobePoints points = lobe_points(f, scouts, basis.order());
  return {integrate(points, basis, kind),
          points.magnitude,
          points.energy,
          points.albedo,
          points.resolved,
          points.rejected,
          points.evaluated};
}

int LobeProjection::lowest_order(double tolerance, float& error) const {
  error = 0;
  double left = energy;
  for (int n = 1; 3 * static_cast<std::size_t>(harmonic_count(n)) <= coefficients.size(); ++n) {
    for (std::size_t i = 3 * static_cast<std::size_t>(harmonic_count(n - 1));
         i < 3 * static_cast<std::size_t>(harmonic_count(n)); ++i) {
      const auto c = static_cast<double>(coefficients[i]);
      left -= c * c;
    }
    error = energy > 0 ? static_cast<float>(std::max(left, 0.0) / energy) : 0.f;
    if (!(left > tolerance * energy)) return n;
  }
  return 0;
}

}  // namespace phos::inline radiance
