// Compiled for x86-64-v3 (CMakeLists.txt); called only where the machine has it.
#ifdef PHOS_ESTIMATE_AVX2
#define PHOS_LIGHT_KERNEL light_kernel_avx2
#define PHOS_LIGHT_LANES 8
#include "estimate/harmonics/light_products.inc"
#endif
