#define PHOS_LIGHT_KERNEL light_kernel_plain
#define PHOS_LIGHT_LANES 4
#include "estimate/harmonics/light_products.inc"

namespace phos::inline estimate {

const LightKernel& best_light_kernel() {
#ifdef PHOS_ESTIMATE_AVX2
  static const bool avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (avx2) return light_kernel_avx2;
#endif
  return light_kernel_plain;
}

}  // namespace phos::inline estimate
