#define PHOS_SPLAT_KERNEL splat_tile_plain
#include "splat/cpu_splatter_kernel.inc"
