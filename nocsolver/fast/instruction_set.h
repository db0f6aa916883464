#pragma once

namespace ursula {

/// What the kernels of packs are computed with. Which of them the processor has is found when the program runs.
enum class InstructionSet { portable, sse2, avx2, avx512 };

bool isSupported(InstructionSet set);
/// The widest that is supported.
InstructionSet bestInstructionSet();
/// "AVX-512".
const char* nameOf(InstructionSet set);

}  // namespace ursula
