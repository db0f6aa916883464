#pragma once

namespace ursula {

/// Instruction sets of the kernels for packs. The program detects at run time which ones the processor has.
enum class InstructionSet { portable, sse2, avx2, avx512 };

bool isSupported(InstructionSet set);
/// Returns the widest supported set.
InstructionSet bestInstructionSet();
/// "AVX-512".
const char* nameOf(InstructionSet set);

}  // namespace ursula
