#pragma once

// What a batch asks of the source that is compiled for an instruction set. Internal: plain numbers and functions.

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/leg_kind.h"
#include "model/scalar.h"

namespace ursula::kernel {

/// What of a machine is no number.
struct MachineShape {
  int legs = 0;
  std::array<LegKind, leg_count> kinds{};
  std::array<std::array<int, 3>, leg_count> motors{};
  std::array<bool, leg_count> rubs{}, coulomb{};
};

/// Entries one after the other, as Motion<double> and Vector6d have them. `loads` may be null.
struct BatchSpans {
  std::size_t count;
  const double *motions, *efforts, *loads;
  double* out;
  std::uint8_t* faults;
};

struct BatchFunctions {
  void* (*make)(const double* numbers, const MachineShape& shape);
  void (*destroy)(void* machine);
  void (*inverse)(const void* machine, const BatchSpans& spans);
  void (*direct)(const void* machine, const BatchSpans& spans);
};

// Each in a source of its own.
BatchFunctions batchBySse2();
BatchFunctions batchByAvx2();
BatchFunctions batchByAvx512();

}  // namespace ursula::kernel
