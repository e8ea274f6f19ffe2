#define PHOS_GLOSS_KERNEL gloss_kernel_plain
#include "splat/cpu/gloss_kernel.inc"
