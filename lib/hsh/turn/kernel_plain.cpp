#define PHOS_HSH_KERNEL turn_plain
#define PHOS_HSH_LANES 4
#include "hsh/turn/kernel.inc"
