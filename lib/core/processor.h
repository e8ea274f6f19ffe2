// Instruction sets of this machine's processor.
#pragma once

namespace phos {

/// Has it AVX2, FMA and BMI2? Loops that are compiled twice then run as x86-64-v3; their bits are the same.
bool has_avx2();

}  // namespace phos
