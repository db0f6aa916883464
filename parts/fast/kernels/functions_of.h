#pragma once

// Selects the code compiled for an instruction set. Internal.

#include <optional>

#include "parts/fast/instruction_set.h"
#include "parts/fast/kernels/batch_functions.h"

namespace ursula::kernel {

/// Returns nullopt for the portable set.
inline std::optional<BatchFunctions> functionsOf(InstructionSet set) {
#ifdef URSULA_X86
  switch (set) {
    case InstructionSet::sse2:
      return batchBySse2();
    case InstructionSet::avx2:
      return batchByAvx2();
    case InstructionSet::avx512:
      return batchByAvx512();
    case InstructionSet::portable:
      break;
  }
#endif
  return std::nullopt;
}

}  // namespace ursula::kernel
