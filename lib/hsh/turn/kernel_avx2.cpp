// Compiled for x86-64-v3 (CMakeLists.txt); called only where the machine has it.
#ifdef PHOS_HSH_AVX2
#define PHOS_HSH_KERNEL turn_avx2
#define PHOS_HSH_LANES 8
#include "hsh/turn/kernel.inc"
#endif
