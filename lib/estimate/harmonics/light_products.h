// The inner loop of sums of harmonics: plain arrays only, because it is compiled twice (for x86-64-v3, and
// for any machine) and shares no inline function with the rest. Both give the same bits: no contraction, no
// reassociation.
#pragma once

#include <cstddef>

namespace phos::inline estimate {

/// Directions that are summed at once: the tables of order 10 fit the nearest caches.
inline constexpr std::size_t kLightBlock = 64;

/// sums[i][w] += sum over the directions k of harmonics[i][k] weights[k][w], for i < count and all weights of
/// a direction (8 or 16, as the name says): a few harmonics at a time keep their sums in registers.
/// harmonics [count][kLightBlock], weights [kLightBlock][8 or 16] aligned to 32 bytes.
using LightProducts = void(const float* harmonics, std::size_t count, const float* weights, double* sums);

struct LightKernel {
  LightProducts *of_8, *of_16;
};
extern const LightKernel light_kernel_plain;
#ifdef PHOS_ESTIMATE_AVX2
extern const LightKernel light_kernel_avx2;
#endif
/// The fastest one that this machine can run.
const LightKernel& best_light_kernel();

}  // namespace phos::inline estimate
