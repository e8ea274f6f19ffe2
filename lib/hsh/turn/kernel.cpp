#include "hsh/turn/kernel.h"

#include "core/processor.h"
#include "hsh/turn/hsh_turn.h"

namespace phos::inline hsh {
namespace {

std::vector<PackedTurn::Column> pack_block(const std::vector<double>& block, std::size_t n) {
  constexpr std::size_t kPanel = PackedTurn::kPanel;
  std::vector<PackedTurn::Column> packed((n + kPanel - 1) / kPanel * n);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column)
      packed[row / kPanel * n + column].row[row % kPanel] = static_cast<float>(block[row * n + column]);
  return packed;
}

}  // namespace

PackedTurn pack(const Turn& turn) {
  PackedTurn p;
  p.cosines = static_cast<int>(turn.cosines()), p.sines = static_cast<int>(turn.sines());
  p.cosine = pack_block(turn.cosine, turn.cosines()), p.sine = pack_block(turn.sine, turn.sines());
  return p;
}

TurnKernel* best_turn_kernel() {
#ifdef PHOS_HSH_AVX2
  if (has_avx2()) return turn_avx2;
#endif
  return turn_plain;
}

}  // namespace phos::inline hsh
