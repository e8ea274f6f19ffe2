// Compiled for x86-64-v3 (CMakeLists.txt); called only where the machine has it.
#ifdef PHOS_HSH_AVX2
#define PHOS_HSH_KERNEL evaluate_batch_avx2
#define PHOS_HSH_GRADIENT_KERNEL evaluate_gradients_avx2
#include "hsh/basis_kernel.inc"
#endif
