// Light that total reflection keeps in glass.
#pragma once

#include <algorithm>
#include <cstdint>

namespace phos::inline scene {

/// Total reflections that follow each other on a path. Glass that absorbs nothing keeps some light for ever:
/// a block all rays that meet each of its faces beyond the critical angle, a sphere those that pass its
/// centre far off. Such a path plays Russian roulette, so that it ends and the mean of all light stays right.
/// Its k-th total reflection after start() is survived with probability (k - 1)/k: weights grow with the
/// number of reflections alone, and the noise of light that leaves late stays bounded.
class TotalReflections {
 public:
  /// The path has met a surface. `index` is Bsdf::total_reflection() there. The probability with which it may
  /// go on; 1: roulette is not played.
  float survival(float index) {
    if (!(index > 0)) return reflections_ = 0, 1.f;
    ++reflections_;
    if (reflections_ <= start(index)) return 1;
    return reflections_ > kLast ? kLastSurvival : 1 - 1 / static_cast<float>(reflections_);
  }

  /// Roulette starts after so many total reflections. Of light that is spread evenly over all directions the
  /// share 1/index^2 meets a face within the critical angle, so that e^-16 of it comes so far.
  static std::uint32_t start(float index) {
    return static_cast<std::uint32_t>(std::clamp(16 * index * index, 64.f, static_cast<float>(kLast)));
  }

 private:
  static constexpr std::uint32_t kLast = 16384;  // from here on few are left, and all of them end
  static constexpr float kLastSurvival = 0.98f;

  std::uint32_t reflections_ = 0;
};

}  // namespace phos::inline scene
