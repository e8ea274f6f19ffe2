// The product that rotation spends its time in, and the layout of matrices made for it.
#pragma once

#include <vector>

#include "hsh/turn/hsh_turn.h"

namespace phos::inline hsh {

/// The blocks of a Turn in float: panels of kPanel rows (the last filled up with zeros), column after column.
struct PackedTurn {
  static constexpr int kPanel = 8;
  static constexpr int kMaxRows = 472;  ///< order 30: 465 cosines, in whole panels
  struct alignas(kPanel * sizeof(float)) Column {
    float row[kPanel] = {};
  };
  int cosines = 0, sines = 0;
  std::vector<Column> cosine, sine;
};
PackedTurn pack(const Turn& turn);

/// y = (of_a A + of_b B) x for A and B of n x n, packed, and for 1 or 3 vectors side by side: x and y are
/// vectors of kMaxRows numbers, y in whole panels.
using TurnKernel = void(const PackedTurn::Column* a, const PackedTurn::Column* b, int n, float of_a,
                        float of_b, int vectors, const float* x, float* y);
TurnKernel turn_plain;
#ifdef PHOS_HSH_AVX2
TurnKernel turn_avx2;
#endif
/// The fastest that this machine has; all give the same bits.
TurnKernel* best_turn_kernel();

}  // namespace phos::inline hsh
