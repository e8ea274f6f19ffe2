// Compiled for x86-64-v3 (CMakeLists.txt); called only where the machine has it.
#ifdef PHOS_SPLAT_AVX2
#define PHOS_GLOSS_KERNEL gloss_kernel_avx2
#include "splat/cpu/gloss_kernel.inc"
#endif
