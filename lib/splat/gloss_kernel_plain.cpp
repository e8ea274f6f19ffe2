#define PHOS_GLOSS_KERNEL gloss_kernel_plain
#include "splat/gloss_kernel.inc"
