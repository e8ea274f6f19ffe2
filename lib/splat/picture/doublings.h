// How many more rays noisy pixels send.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace phos::inline splat {

/// Of each pixel, how often the numbers of its rays are doubled: of shadow rays
/// (RenderOptions::light_samples) and of gloss rays (gloss_samples). Row by row from the top; empty: nowhere.
struct Doublings {
  std::vector<std::uint8_t> direct, gloss;

  static int of(const std::vector<std::uint8_t>& all, std::size_t pixel) {
    return all.empty() ? 0 : all[pixel];
  }
};

}  // namespace phos::inline splat
