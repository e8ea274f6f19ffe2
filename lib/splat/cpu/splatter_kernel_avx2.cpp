// Compiled for x86-64-v3 (CMakeLists.txt); called only where the machine has it.
#ifdef PHOS_SPLAT_AVX2
#define PHOS_SPLAT_KERNEL splat_tile_avx2
#include "splat/cpu/splatter_kernel.inc"
#define PHOS_FOOTPRINT_KERNEL splat_footprint_avx2
#include "splat/cpu/footprint_kernel.inc"
#endif
