#define PHOS_SPLAT_KERNEL splat_tile_plain
#include "splat/cpu/splatter_kernel.inc"
#define PHOS_FOOTPRINT_KERNEL splat_footprint_plain
#include "splat/cpu/footprint_kernel.inc"
