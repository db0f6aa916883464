#pragma once

// What a batch asks of the source that is compiled for an instruction set. Internal: plain numbers and functions.

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/scalar.h"
#include "model/leg_kind.h"

namespace ursula::kernel {

/// What of a machine is no number.
struct MachineShape {
  int legs = 0;
  std::array<LegKind, leg_count> kinds{};
  std::array<std::array<int, 3>, leg_count> motors{};
  std::array<bool, leg_count> rubs{}, rubs_dry{}, principal{}, has_rotor{}, off_line{};
};

/// Entries one after the other, as Motion<double> and Vector6d have them. `loads` may be null.
struct BatchSpans {
  std::size_t count;
  const double *motions, *efforts, *loads;
  double* out;
  std::uint8_t* faults;
};

/// What six legs, one to a lane, make of one pose. Rows of Bᵀ, moments over the length, a motor in each column; of the
/// direct dynamics the lower half of M_P. Columns from the seventh on mean nothing.
struct LegSums {
  double rows[6][8], wrench[6], Q[8], A[8];
};

struct BatchFunctions {
  void* (*make)(const double* numbers, const MachineShape& shape);
  void (*destroy)(void* machine);
  void (*inverse)(const void* machine, const BatchSpans& spans);
  void (*direct)(const void* machine, const BatchSpans& spans);
  // One pose, a leg in each lane (leg_lanes.h); false where a leg cannot take it.
  void* (*make_legs)(const double* numbers, const MachineShape& shape);
  void (*destroy_legs)(void* legs);
  bool (*inverse_legs)(const void* legs, const double* motion, LegSums& out);
  bool (*direct_legs)(const void* legs, const double* motion, const double* efforts, LegSums& out);
};

// Each in a source of its own.
BatchFunctions batchBySse2();
BatchFunctions batchByAvx2();
BatchFunctions batchByAvx512();

}  // namespace ursula::kernel
