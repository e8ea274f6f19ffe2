// The product that rotation spends its time in, and the layout of matrices made for it.
#pragma once

#include <vector>

#include "hsh/turn.h"

namespace phos {

/// The blocks of a Turn in float: panels of kPanel rows (the last filled up with zeros), column after column.
struct PackedTurn {
  static constexpr int kPanel = 16;
  static constexpr int kMaxRows = 480;  ///< order 30: 465 cosines, in whole panels
  int cosines = 0, sines = 0;
  std::vector<float> cosine, sine;
};
PackedTurn pack(const Turn& turn);

/// y = (of_a A + of_b B) x, both n x n, packed; y has room for whole panels.
void turn_interpolated(const float* a, const float* b, int n, float of_a, float of_b, const float* x,
                       float* y);

}  // namespace phos
