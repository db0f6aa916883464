#include "parts/fast/instruction_set.h"

#include <array>
#include <cstddef>

namespace ursula {

bool isSupported(InstructionSet set) {
#ifdef URSULA_X86
  switch (set) {
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl");
    case InstructionSet::sse2:
    case InstructionSet::portable:
      break;
  }
  return true;
#else
  return set == InstructionSet::portable;
#endif
}

InstructionSet bestInstructionSet() {
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::sse2})
    if (isSupported(set)) return set;
  return InstructionSet::portable;
}

const char* nameOf(InstructionSet set) {
  constexpr std::array<const char*, 4> names = {"portable", "SSE2", "AVX2", "AVX-512"};
  return names[static_cast<std::size_t>(set)];
}

}  // namespace ursula
