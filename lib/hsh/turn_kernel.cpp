#include "hsh/turn_kernel.h"

namespace phos {
namespace {

std::vector<float> pack_block(const std::vector<double>& block, std::size_t n) {
  constexpr std::size_t kPanel = PackedTurn::kPanel;
  const std::size_t panels = (n + kPanel - 1) / kPanel;
  std::vector<float> packed(panels * kPanel * n, 0.f);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column)
      packed[(row / kPanel * n + column) * kPanel + row % kPanel] =
          static_cast<float>(block[row * n + column]);
  return packed;
}

}  // namespace

PackedTurn pack(const Turn& turn) {
  PackedTurn p;
  p.cosines = static_cast<int>(turn.cosines()), p.sines = static_cast<int>(turn.sines());
  p.cosine = pack_block(turn.cosine, turn.cosines()), p.sine = pack_block(turn.sine, turn.sines());
  return p;
}

void turn_interpolated(const float* a, const float* b, int n, float of_a, float of_b, const float* x,
                       float* y) {
  constexpr int kPanel = PackedTurn::kPanel;
  for (int row = 0; row < n; row += kPanel, y += kPanel) {
    float sum[kPanel] = {};
    for (int column = 0; column < n; ++column, a += kPanel, b += kPanel)
      for (int r = 0; r < kPanel; ++r) sum[r] += (of_a * a[r] + of_b * b[r]) * x[column];
    for (int r = 0; r < kPanel; ++r) y[r] = sum[r];
  }
}

}  // namespace phos
