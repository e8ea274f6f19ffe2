#define PHOS_SPLAT_KERNEL splat_tile_plain
#include "splat/cpu_splatter_kernel.inc"
#define PHOS_FOOTPRINT_KERNEL splat_footprint_plain
#include "splat/footprint_kernel.inc"
